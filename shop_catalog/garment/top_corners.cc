#include "shop_catalog/garment/top_corners.h"

#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "shop_catalog/garment/kind_templates.h"

namespace fitroom::shop_catalog {
namespace {

// A sleeveless chain has eight corners: the shoulder tip stands for both corners of a sleeve's end.
constexpr std::array<size_t, kTopCornerCount> kSleeveless = {0, 1, 2, 2, 3, 4, 5, 5, 6, 7};

TopCorners FromMatch(const CornerMatch& match, const Polygon& outline) {
  FR_CHECK(match.pixel.size() == kTopCornerCount || match.pixel.size() == 8);
  TopCorners corners;
  for (size_t c = 0; c < kTopCornerCount; ++c) {
    const size_t from = match.pixel.size() == 8 ? kSleeveless[c] : c;
    corners.pixel[c] = match.pixel[from];
    corners.confidence[c] = match.confidence[from];
  }
  corners.cost = match.cost;
  const Eigen::Vector2d neck = 0.5 * (corners.pixel[kNeckLeft] + corners.pixel[kNeckRight]);
  const Eigen::Vector2d hem = 0.5 * (corners.pixel[kHemLeft] + corners.pixel[kHemRight]);
  corners.tilt = std::atan2(neck.x() - hem.x(), hem.y() - neck.y());
  corners.height = HeightAlong(outline, corners.tilt);
  return corners;
}

}  // namespace

std::optional<TopCorners> FindTopCorners(const Polygon& outline, GarmentKind kind) {
  std::optional<CornerMatch> best;
  for (const CornerTemplate& candidate : TemplatesOf(kind)) {
    std::optional<CornerMatch> match = MatchCorners(outline, candidate);
    if (match && (!best || match->cost < best->cost)) best = std::move(match);
  }
  if (!best) return std::nullopt;
  return FromMatch(*best, outline);
}

}  // namespace fitroom::shop_catalog
