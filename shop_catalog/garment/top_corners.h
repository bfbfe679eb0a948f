#pragma once

#include <array>
#include <optional>

#include "common/garment/garment.h"
#include "common/garment/polygon.h"

namespace fitroom::shop_catalog {

// The ten corners of a top's silhouette, clockwise on the screen from the hem corner on the image's left. Left and
// right here are the IMAGE's.
enum TopCorner {
  kHemLeft,
  kUnderarmLeft,
  kSleeveBottomLeft,
  kSleeveTopLeft,
  kNeckLeft,
  kNeckRight,
  kSleeveTopRight,
  kSleeveBottomRight,
  kUnderarmRight,
  kHemRight,
};
inline constexpr int kTopCornerCount = 10;

struct TopCorners {
  std::array<Eigen::Vector2d, kTopCornerCount> pixel;
  std::array<double, kTopCornerCount> confidence{};  // 0 to 1.
  double tilt = 0.0;    // Of the garment against upright, positive clockwise on the screen (unit: radian).
  double height = 0.0;  // Of the silhouette along the garment's own axis (unit: pixel).
  double cost = 0.0;    // Of the best chain, per corner: below about 1.5 for the right kind, above 3 for others.
};

// Finds the corners of a shirt or dress on its outline (clockwise, upright within 40 degrees): see MatchCorners(). On a
// sleeveless dress the sleeve's corners are the shoulder tip. Nothing if the outline is too short.
std::optional<TopCorners> FindTopCorners(const Polygon& outline, GarmentKind kind = GarmentKind::kTShirt);

}  // namespace fitroom::shop_catalog
