#include "fit_client/fit/stages/tape_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

using Eigen::Vector2d;

constexpr double kArcStep = 5.0 * std::numbers::pi / 180.0;  // Between points where the tape turns about a corner.

}  // namespace

TapeCurve::TapeCurve(std::span<const Vector2d> points, double offset) {
  const std::vector<Vector2d> hull = ConvexHull(points);  // Counter-clockwise in (x, z): from +x over +z.
  if (hull.size() < 3) return;
  const size_t count = hull.size();
  // Walked backwards, so that the way leads from the front over the left.
  for (size_t k = count; k-- > 0;) {
    const Vector2d& corner = hull[k];
    const Vector2d in = (corner - hull[(k + 1) % count]).normalized();
    const Vector2d out = (hull[(k + count - 1) % count] - corner).normalized();
    const auto outward = [](const Vector2d& along) { return Vector2d(-along.y(), along.x()); };
    const double turn = std::acos(std::clamp(in.dot(out), -1.0, 1.0));
    const int steps = offset > 0.0 ? std::max(1, static_cast<int>(std::ceil(turn / kArcStep))) : 0;
    for (int step = 0; step <= steps; ++step) {
      const double angle = steps == 0 ? 0.0 : -turn * step / steps;
      points_.push_back(corner + offset * (Eigen::Rotation2Dd(angle) * outward(in)));
    }
  }
  Eigen::AlignedBox2d bounds;
  for (size_t k = 0; k <= points_.size(); ++k) {
    const Vector2d& point = points_[k % points_.size()];
    bounds.extend(point);
    distances_.push_back(k == 0 ? 0.0 : distances_.back() + (point - points_[k - 1]).norm());
  }
  middle_ = bounds.center();
}

TapeCurve TapeCurve::AsWideAs(double girth, std::span<const Vector2d> points, double clearance) {
  const double offset = std::max(clearance, (girth - TapeLength(points)) / (2.0 * std::numbers::pi));
  return TapeCurve(points, offset);
}

Vector2d TapeCurve::At(double distance) const {
  const double whole = length();
  double place = std::fmod(start_ + distance, whole);
  if (place < 0.0) place += whole;
  const auto after = std::upper_bound(distances_.begin(), distances_.end(), place);
  const size_t next = std::clamp<size_t>(static_cast<size_t>(after - distances_.begin()), 1, points_.size());
  const double span = std::max(distances_[next] - distances_[next - 1], 1e-12);
  const double part = std::clamp((place - distances_[next - 1]) / span, 0.0, 1.0);
  return (1.0 - part) * points_[next - 1] + part * points_[next % points_.size()];
}

void TapeCurve::StartTowards(const Vector2d& centre, const Vector2d& direction) {
  const Vector2d across(-direction.y(), direction.x());
  double farthest = -std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < points_.size(); ++k) {
    const Vector2d from = points_[k] - centre;
    const Vector2d to = points_[(k + 1) % points_.size()] - centre;
    const double a = from.dot(across);
    const double b = to.dot(across);
    if ((a > 0.0) == (b > 0.0)) continue;
    const double part = a / (a - b);
    const double reach = (from + part * (to - from)).dot(direction);
    if (reach <= farthest) continue;
    farthest = reach;
    start_ = distances_[k] + part * (distances_[k + 1] - distances_[k]);
  }
}

}  // namespace fitroom
