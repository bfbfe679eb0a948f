#pragma once

#include <string_view>
#include <vector>

#include "common/garment/garment.h"

namespace fitroom::shop_catalog {

// Tops and one-pieces have a neckline, which on a front view is not the silhouette.
constexpr bool HasNeck(GarmentKind kind) { return !IsBottom(kind); }
constexpr bool IsDress(GarmentKind kind) {
  return kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece;
}

// Where a kind begins and ends: the names of its upper and lower corners.
struct KindEnds {
  std::string_view upper_left, upper_right, lower_left, lower_right;
  std::string_view upper, lower;  // For people: "highest shoulder point", "hem".
};
const KindEnds& EndsOf(GarmentKind kind);

// The stated lengths that a kind can have (unit: metre).
struct LengthRange {
  double least, most;
};
LengthRange LengthRangeOf(GarmentKind kind);

// A garment's own axes in a photograph.
struct GarmentFrame {
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();   // Between the upper corners (unit: pixel).
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();   // Between the lower corners (unit: pixel).
  Eigen::Vector2d down = Eigen::Vector2d::UnitY();   // Of length 1.
  Eigen::Vector2d right = Eigen::Vector2d::UnitX();  // Of length 1, to the image's right of an upright garment.
};
// The points are complete.
GarmentFrame FrameOf(GarmentKind kind, const std::vector<OutlinePoint>& points);

// Returns the garment's length: from the upper corners down its own axis to the lower ones, mean of both sides
// (unit: pixel).
double LengthInPixels(GarmentKind kind, const std::vector<OutlinePoint>& points);

}  // namespace fitroom::shop_catalog
