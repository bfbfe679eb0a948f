#include "shop_catalog/garment/kind_frame.h"

#include "common/base/check.h"

namespace fitroom::shop_catalog {
namespace {

constexpr KindEnds kNeckToHem = {"P2", "P1", "hem_L", "hem_R", "highest shoulder point", "hem"};
constexpr KindEnds kWaistToHem = {"e1", "e3", "e2", "e4", "upper edge of the waist", "hem"};

const Eigen::Vector2d& At(const std::vector<OutlinePoint>& points, std::string_view name) {
  for (const OutlinePoint& point : points) {
    if (point.name == name) return point.pixel;
  }
  FR_CHECK(false);
  return points.front().pixel;
}

}  // namespace

const KindEnds& EndsOf(GarmentKind kind) { return IsBottom(kind) ? kWaistToHem : kNeckToHem; }

LengthRange LengthRangeOf(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::kTShirt:
    case GarmentKind::kLongSleeve:
      return {0.30, 1.20};
    case GarmentKind::kOnePiece:
    case GarmentKind::kSleevedOnePiece:
      return {0.50, 1.70};
    case GarmentKind::kSkirt:
      return {0.22, 1.20};
    case GarmentKind::kPants:
      return {0.45, 1.35};
    case GarmentKind::kShorts:
      return {0.20, 0.80};
  }
  return {0.20, 2.00};
}

GarmentFrame FrameOf(GarmentKind kind, const std::vector<OutlinePoint>& points) {
  const KindEnds& ends = EndsOf(kind);
  GarmentFrame frame;
  frame.upper = 0.5 * (At(points, ends.upper_left) + At(points, ends.upper_right));
  frame.lower = 0.5 * (At(points, ends.lower_left) + At(points, ends.lower_right));
  frame.down = (frame.lower - frame.upper).normalized();
  frame.right = Eigen::Vector2d(frame.down.y(), -frame.down.x());
  return frame;
}

double LengthInPixels(GarmentKind kind, const std::vector<OutlinePoint>& points) {
  const KindEnds& ends = EndsOf(kind);
  const GarmentFrame frame = FrameOf(kind, points);
  const Eigen::Vector2d left = At(points, ends.lower_left) - At(points, ends.upper_left);
  const Eigen::Vector2d right = At(points, ends.lower_right) - At(points, ends.upper_right);
  return 0.5 * (left.dot(frame.down) + right.dot(frame.down));
}

}  // namespace fitroom::shop_catalog
