#include "fit_client/fit/measure/taut_length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr int kCorners = 24;  // Of the circle by which corners of the outline are moved outwards.

double LeftOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point) {
  const Eigen::Vector2d way = to - from;
  const Eigen::Vector2d there = point - from;
  return way.x() * there.y() - way.y() * there.x();
}

size_t NearestCorner(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point) {
  size_t nearest = 0;
  for (size_t i = 1; i < hull.size(); ++i) {
    if ((hull[i] - point).squaredNorm() < (hull[nearest] - point).squaredNorm()) nearest = i;
  }
  return nearest;
}

}  // namespace

double TautLength(std::span<const Eigen::Vector2d> outline, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  double offset) {
  const double straight = (to - from).norm();
  std::vector<Eigen::Vector2d> left;
  for (const Eigen::Vector2d& point : outline) {
    if (LeftOf(from, to, point) > 0.0) left.push_back(point);
  }
  std::vector<Eigen::Vector2d> around = {from, to};
  for (const Eigen::Vector2d& corner : ConvexHull(left)) {
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kCorners;
      const Eigen::Vector2d moved = corner + offset * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (LeftOf(from, to, moved) > 0.0) around.push_back(moved);
    }
  }
  const std::vector<Eigen::Vector2d> hull = ConvexHull(around);
  if (hull.size() < 3 || !(straight > 0.0)) return straight;
  // The hull runs counter-clockwise: what is left of the way lies on it between `to` and `from`. Where the outline
  // bulges past an end the string first goes back to the hull's corner there.
  const size_t first = NearestCorner(hull, to);
  const size_t last = NearestCorner(hull, from);
  double length = (hull[first] - to).norm() + (hull[last] - from).norm();
  for (size_t i = first; i != last; i = (i + 1) % hull.size()) length += (hull[(i + 1) % hull.size()] - hull[i]).norm();
  return std::max(length, straight);
}

}  // namespace fitroom
