#include "common/body/outline_profile.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace fitroom {

std::optional<DepthRange> DepthAt(const SectionLoop& loop, double x) {
  std::optional<DepthRange> range;
  for (size_t i = 0; i < loop.points.size(); ++i) {
    const Eigen::Vector2d& a = loop.points[i];
    const Eigen::Vector2d& b = loop.points[(i + 1) % loop.points.size()];
    if ((a.x() < x) == (b.x() < x)) continue;
    const double z = a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    if (!range) range = DepthRange{z, z};
    range->back = std::min(range->back, z);
    range->front = std::max(range->front, z);
  }
  return range;
}

Eigen::Vector2d FarthestAlong(const SectionLoop& loop, const Eigen::Vector2d& direction) {
  FR_CHECK(!loop.points.empty());
  return *std::max_element(
      loop.points.begin(), loop.points.end(),
      [&direction](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.dot(direction) < b.dot(direction); });
}

double OutlineProfile::AngleAt(size_t i, double reach) const {
  // Walks along the curve in both directions until `reach` is used up, and stops between points if need be.
  const auto walk = [this, reach](size_t from, int step) {
    double left = reach;
    Eigen::Vector2d at = points_[from];
    for (size_t k = from; left > 0.0;) {
      if ((step < 0 && k == 0) || (step > 0 && k + 1 == points_.size())) break;
      k = step < 0 ? k - 1 : k + 1;
      const Eigen::Vector2d move = points_[k] - at;
      const double length = move.norm();
      at = length > left ? Eigen::Vector2d(at + move * (left / length)) : points_[k];
      left -= length;
    }
    return at;
  };
  const Eigen::Vector2d chord = walk(i, +1) - walk(i, -1);
  return std::atan2(chord.x(), -chord.y());
}

std::optional<double> OutlineProfile::FirstRiseAbove(double angle, size_t begin, double reach) const {
  double before = 0.0;
  for (size_t i = begin; i < points_.size(); ++i) {
    const double here = AngleAt(i, reach);
    if (here > angle) {
      if (i == begin || here == before) return static_cast<double>(i);
      return static_cast<double>(i) - (here - angle) / (here - before);
    }
    before = here;
  }
  return std::nullopt;
}

std::optional<double> OutlineProfile::FirstFallBelow(double angle, size_t begin, double reach) const {
  double before = 0.0;
  for (size_t i = begin; i < points_.size(); ++i) {
    const double here = AngleAt(i, reach);
    if (here < angle) {
      if (i == begin || here == before) return static_cast<double>(i);
      return static_cast<double>(i) - (here - angle) / (here - before);
    }
    before = here;
  }
  return std::nullopt;
}

Eigen::Vector2d OutlineProfile::PointAt(double position) const {
  FR_CHECK(!points_.empty());
  const auto last = static_cast<double>(points_.size() - 1);
  const double clamped = std::clamp(position, 0.0, last);
  const auto i = static_cast<size_t>(clamped);
  if (i + 1 >= points_.size()) return points_.back();
  return points_[i] + (clamped - static_cast<double>(i)) * (points_[i + 1] - points_[i]);
}

}  // namespace fitroom
