#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/garment/garment.h"

namespace fitroom {

// A seam is sewn to the same section of the other panel; an opening (neck, sleeve end, hem) stays open.
enum class SectionKind { kSeam, kOpening };

// A named point of the outline (OutlinePointNames()) on a section.
struct SectionKnot {
  std::string name;
  int index = 0;  // Into OutlineSection::points.
};

// A piece of a panel's outline between two corners, as a fine polyline in the garment and in the photograph.
struct OutlineSection {
  // "neck", "shoulder_L", "sleeve_end_L", "underside_L", "side_L", "armhole_L", "hem"; "waist"; "outseam_L",
  // "leg_hem_L", "inseam_L" of trousers; _L, _R: the wearer's. Which a kind has, and in which order: OutlineLayout().
  std::string name;
  SectionKind kind = SectionKind::kSeam;
  std::vector<Eigen::Vector2d> points;  // In the pattern's frame (unit: metre).
  std::vector<Eigen::Vector2d> pixels;  // Where the photograph shows each point (unit: pixel, centres at +0.5).
  std::vector<SectionKnot> knots;       // In order along the section; the first and the last are its corners.
};

// One panel: its outline, counter-clockwise seen from the front (+z), each section beginning where the one before it
// ends. The pairs of points and pixels say how the photograph lies on the panel.
struct PanelPattern {
  GarmentSide side = GarmentSide::kFront;
  int image_width = 0;   // (unit: pixel)
  int image_height = 0;  // (unit: pixel)
  std::vector<OutlineSection> sections;
};

// The one garment that both photographs show. Front and back have the same sections in the same order, and equal
// points on every seam, so that seams have one length.
// Frame: metres, x towards the wearer's left, y up; origin of tops and one-pieces at Cp, the midpoint of P1 and P2, of
// bottoms in the middle between the waist's ends e1 and e3.
struct GarmentPattern {
  GarmentKind kind = GarmentKind::kTShirt;
  PanelPattern front;
  PanelPattern back;
  // False: left and right were averaged and mirror each other exactly. True: they differ in both photographs in the
  // same way and by more than laying out explains, and each was kept.
  bool asymmetric_by_design = false;
};

// The closed outline of a panel or of its photograph: all sections joined, corners once, first point not repeated.
std::vector<Eigen::Vector2d> JoinedPoints(const PanelPattern& panel);
std::vector<Eigen::Vector2d> JoinedPixels(const PanelPattern& panel);

// Returns the section of that name, or nullptr.
const OutlineSection* FindSection(const PanelPattern& panel, std::string_view name);

// Returns where the named point lies in the pattern, or nullptr.
const Eigen::Vector2d* FindPatternPoint(const PanelPattern& panel, std::string_view name);

}  // namespace fitroom
