#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// A one-piece has other points with sleeves than without, so that it counts as two kinds.
enum class GarmentKind { kTShirt, kLongSleeve, kOnePiece, kSkirt, kPants, kShorts, kSleevedOnePiece };
inline constexpr int kGarmentKindCount = 7;

// Tops and one-pieces are put on from the neck down, bottoms from below.
constexpr bool IsBottom(GarmentKind kind) {
  return kind == GarmentKind::kSkirt || kind == GarmentKind::kPants || kind == GarmentKind::kShorts;
}
constexpr bool HasLegs(GarmentKind kind) { return kind == GarmentKind::kPants || kind == GarmentKind::kShorts; }
constexpr bool HasSleeves(GarmentKind kind) {
  return kind == GarmentKind::kTShirt || kind == GarmentKind::kLongSleeve || kind == GarmentKind::kSleevedOnePiece;
}

// Returns the kind as users type it: "tshirt", "long_sleeve", "one_piece", "skirt", "pants", "shorts",
// "one_piece_sleeved".
std::string_view GarmentKindName(GarmentKind kind);
std::optional<GarmentKind> GarmentKindFromName(std::string_view name);

// Which photograph. kSideFolded: of a bottom with legs, one leg laid over the other, so that the crotch curve lies
// flat.
enum class GarmentSide { kFront, kBack, kSideFolded };
inline constexpr int kGarmentSideCount = 3;
// Returns "front", "back", "side_folded".
std::string_view GarmentSideName(GarmentSide side);

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
  std::vector<OutlinePoint> points;  // In the order of OutlinePointNames(), side-folded of SideFoldedPointNames().
};

// How a measure is known. A verdict is refused where a deciding one is unknown.
enum class Provenance {
  kMeasured,  // On the photographs.
  kStated,    // By the shop.
  kRuled,     // By a drafting rule: an estimate.
  kUnknown,   // Folding hides it and nothing was stated.
};
std::string_view ProvenanceName(Provenance provenance);  // "measured", "stated", "ruled", "unknown".
std::optional<Provenance> ProvenanceFromName(std::string_view name);

// A length measured on the flat garment, for people and size tables; the fit measures its panels itself. Widths are
// flat: half a girth.
struct GarmentMeasure {
  std::string name;    // See MeasureNames().
  double value = 0.0;  // (unit: metre); 0 where unknown.
  Provenance provenance = Provenance::kMeasured;

  friend bool operator==(const GarmentMeasure&, const GarmentMeasure&) = default;
};

// One size of a chart: flat measures of the garment, and the body girths that the shop cuts it for.
struct GarmentSize {
  std::string name;                      // For example "M" or "38"; 1 to 16 bytes.
  std::vector<GarmentMeasure> measures;  // Of the flat garment (unit: metre).
  std::vector<GarmentMeasure> body;      // "bust", "waist", "hip": girths, full circle (unit: metre). May be empty.

  friend bool operator==(const GarmentSize&, const GarmentSize&) = default;
};

// All sizes of a garment, the smallest first.
struct SizeChart {
  std::vector<GarmentSize> sizes;
  std::string photographed_size;  // Which of them the photographs show.

  friend bool operator==(const SizeChart&, const SizeChart&) = default;
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
  std::string fabric = "jersey";  // A preset of the fit: "jersey", "woven", "denim" or "stretch".
  SizeChart chart;                // Empty: only the photographed size exists.
  // Bottoms with legs: photographed with one leg laid over the other, so that the crotch curve, which folding hides in
  // the other photographs, lies flat. Its side is kSideFolded. Points: see SideFoldedPointNames().
  std::optional<GarmentView> side_folded;
};

// The chest of a top is measured so far below its underarms, flat or worn: an inch, as the trade does (unit: metre).
inline constexpr double kChestBelowUnderarm = 0.025;

// Returns the size of that name, or nullptr.
const GarmentSize* FindSize(const SizeChart& chart, std::string_view name);
// Returns the measure of that name, or nullptr.
const GarmentMeasure* FindMeasure(const std::vector<GarmentMeasure>& measures, std::string_view name);

// Returns the flat measures that a kind has, in the order of tables: tops "shoulder_width", "chest_width", …; bottoms
// "waist_width", "hip_width", …, "front_rise", "back_rise", "thigh_width".
const std::vector<std::string>& MeasureNames(GarmentKind kind);

// Returns the names of the 22 points of a kind, in the order used everywhere. Names end in _L or _R for the wearer's
// left and right.
const std::vector<std::string>& OutlinePointNames(GarmentKind kind);

// Returns the names of a kind's points in the order in which the outline of a view passes them, clockwise on the
// screen. A back view is passed the other way round, because it is seen from the other side.
std::vector<std::string> OutlineOrder(GarmentKind kind, GarmentSide side);

// Returns the names of the points of a side-folded photograph of a bottom with legs, in the order of its outline.
const std::vector<std::string>& SideFoldedPointNames();

// Returns the name of the same point on the wearer's other side: "hem_R" for "hem_L", "P2" for "P1", "e5" for "e1" of a
// top and "e3" for "e1" of a bottom; a point on the middle is its own twin.
std::string TwinPointName(GarmentKind kind, std::string_view name);
// Says whether the point belongs to the wearer's left half.
bool IsLeftPoint(GarmentKind kind, std::string_view name);

// Returns the view's point of that name, or nullptr.
const OutlinePoint* FindPoint(const GarmentView& view, std::string_view name);

}  // namespace fitroom
