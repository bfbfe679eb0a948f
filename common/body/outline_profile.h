#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/body/plane_section.h"

namespace fitroom {

// Where an outline in (x, z) coordinates meets the line x = const: the rearmost and foremost z.
struct DepthRange {
  double back = 0.0;
  double front = 0.0;
};
std::optional<DepthRange> DepthAt(const SectionLoop& loop, double x);

// The outline's point farthest along a direction in the plane.
Eigen::Vector2d FarthestAlong(const SectionLoop& loop, const Eigen::Vector2d& direction);

// A curve of the body's outline against a vertical plane, by falling height: (aside, height) with aside counted
// outwards. Its tangent's angle is 0 where the curve runs straight down, +90 degrees where it runs level outwards while
// going down, negative where it runs inwards.
class OutlineProfile {
 public:
  // `points` by falling height.
  explicit OutlineProfile(std::vector<Eigen::Vector2d> points) : points_(std::move(points)) {}

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  size_t size() const { return points_.size(); }

  // The tangent's angle at a point, from the chord between the curve's points `reach` before and after it along the
  // curve (or its ends).
  double AngleAt(size_t i, double reach) const;

  // The first point after `begin` at which the angle rises above (or falls below) `angle`; interpolated to a position
  // on the curve (index plus fraction).
  std::optional<double> FirstRiseAbove(double angle, size_t begin, double reach) const;
  std::optional<double> FirstFallBelow(double angle, size_t begin, double reach) const;

  // The point at a position returned above.
  Eigen::Vector2d PointAt(double position) const;

 private:
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace fitroom
