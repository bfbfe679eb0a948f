#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

enum class GarmentKind { kTShirt, kLongSleeve, kOnePiece, kSkirt, kPants, kShorts };

// Returns the kind as users type it: "tshirt", "long_sleeve", "one_piece", "skirt", "pants", "shorts".
std::string_view GarmentKindName(GarmentKind kind);
std::optional<GarmentKind> GarmentKindFromName(std::string_view name);

enum class GarmentSide { kFront, kBack };

// One of the 22 points on the outline. Pixels: origin top left of the image, pixel centre at +0.5.
struct OutlinePoint {
  std::string name;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // (unit: pixel)
  double confidence = 0.0;                          // 0 to 1; 1 when given by hand.
};

// What one photograph says about the garment. Left and right in point names are the WEARER's: on a front photograph the
// wearer's left is on the image's right, on a back photograph on the image's left.
//
// Pixels are those of the working image: the photograph upright and, where it is very large, scaled down. Mask and
// texture have its size.
struct GarmentView {
  GarmentSide side = GarmentSide::kFront;
  std::string photo_file;    // The shop's photograph, as received; a plain name in the garment's folder.
  std::string mask_file;     // 8-bit PNG, 255 = garment.
  std::string texture_file;  // PNG: the photograph with the garment's colours carried on beyond its outline.
  int image_width = 0;       // (unit: pixel)
  int image_height = 0;      // (unit: pixel)
  double metre_per_pixel = 0.0;
  // Closed simple polygon, clockwise on the screen, first point not repeated (unit: pixel). On a front view it runs
  // along the front neckline: the inside of the back neck that shows above it is not part of the front.
  std::vector<Eigen::Vector2d> outline;
  std::vector<OutlinePoint> points;  // The 22 of the kind, in the order of OutlinePointNames().
};

// A length measured on the flat garment, for people and size tables; the fit measures its panels itself.
struct GarmentMeasure {
  std::string name;    // For example "chest_width".
  double value = 0.0;  // (unit: metre)
};

// A garment as published: what the fit needs to know and no more.
struct Garment {
  std::string id;     // [a-z0-9-]{1,63}
  std::string title;  // For people.
  GarmentKind kind = GarmentKind::kTShirt;
  double length = 0.0;  // From the highest shoulder point (top) or waist (bottom) to the hem, flat (unit: metre).
  GarmentView front;
  std::optional<GarmentView> back;  // Absent: the front's outline serves for both.
  std::vector<GarmentMeasure> measures;
};

// Returns the names of the 22 points of a kind, in the order used everywhere. Names end in _L or _R for the wearer's
// left and right.
const std::vector<std::string>& OutlinePointNames(GarmentKind kind);

// Returns the names of a kind's points in the order in which the outline of a view passes them, clockwise on the
// screen. A back view is passed the other way round, because it is seen from the other side.
std::vector<std::string> OutlineOrder(GarmentKind kind, GarmentSide side);

// Returns the name of the same point on the wearer's other side: "hem_R" for "hem_L", "e5" for "e1", "P2" for "P1"; a
// point on the middle is its own twin.
std::string TwinPointName(std::string_view name);

// Returns the view's point of that name, or nullptr.
const OutlinePoint* FindPoint(const GarmentView& view, std::string_view name);

}  // namespace fitroom
