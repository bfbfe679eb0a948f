#include "fit_client/fit/panels/photo_warp.h"

#include <cmath>

namespace fitroom {

PhotoWarp::PhotoWarp(const PanelPattern& panel) : points_(JoinedPoints(panel)), pixels_(JoinedPixels(panel)) {}

// The weight of corner i is (tan(a/2) + tan(b/2)) / r_i with the angles a and b under which the sides before and after
// it are seen from the point. tan of the half angle between two rays r, s is cross / (|r||s| + dot), or, where that
// would cancel, (|r||s| - dot) / cross.
Eigen::Vector2d PhotoWarp::PixelAt(const Eigen::Vector2d& point) const {
  constexpr double kOnOutline = 1e-9;  // (unit: metre)
  const size_t count = points_.size();
  Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
  double total = 0.0;
  Eigen::Vector2d ray = points_[count - 1] - point;
  double distance = ray.norm();
  for (size_t i = count - 1, next = 0; next < count; i = next++) {
    if (distance < kOnOutline) return pixels_[i];
    const Eigen::Vector2d next_ray = points_[next] - point;
    const double next_distance = next_ray.norm();
    const double cross = ray.x() * next_ray.y() - ray.y() * next_ray.x();
    const double dot = ray.dot(next_ray);
    const double product = distance * next_distance;
    if (dot < 0.0 && std::abs(cross) < kOnOutline * (distance + next_distance)) {
      const double t = distance / (distance + next_distance);
      return (1.0 - t) * pixels_[i] + t * pixels_[next];
    }
    const double tangent = dot > 0.0 ? cross / (product + dot) : (cross != 0.0 ? (product - dot) / cross : 0.0);
    weighted += tangent * (pixels_[i] / distance + pixels_[next] / next_distance);
    total += tangent * (1.0 / distance + 1.0 / next_distance);
    ray = next_ray;
    distance = next_distance;
  }
  return weighted / total;
}

}  // namespace fitroom
