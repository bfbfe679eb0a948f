#pragma once

#include <array>
#include <optional>

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
  double cost = 0.0;    // Of the best chain, per corner: below about 1.5 for tops, above 3 for other kinds.
};

// Finds the corners of a top on its outline (clockwise, upright within 40 degrees). Which corner is which is decided
// for all ten together, by a chain of least cost over the outline: each corner has an expected turn and place, each
// piece between two corners an expected direction, length and straightness. Where each lies is then decided locally, at
// the sharpest turn. Nothing if the outline is too short.
std::optional<TopCorners> FindTopCorners(const Polygon& outline);

// Returns the cost of the best chain alone, from a coarser search: for choosing between outlines. Infinite if there is
// none.
double TopShapeCost(const Polygon& outline);

}  // namespace fitroom::shop_catalog
