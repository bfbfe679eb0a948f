#include "common/body/polygon.h"

#include <algorithm>
#include <cmath>

namespace fitroom {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool Before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

}  // namespace

std::vector<Eigen::Vector2d> ConvexHull(std::span<const Eigen::Vector2d> points) {
  // Andrew's monotone chain.
  std::vector<Eigen::Vector2d> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), Before);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  std::vector<Eigen::Vector2d> hull;
  hull.reserve(sorted.size());
  const auto extend = [&hull](const Eigen::Vector2d& p, size_t floor) {
    while (hull.size() >= floor + 2 && Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : sorted) extend(p, 0);
  const size_t floor = hull.size() - 1;
  for (size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i], floor);
  hull.pop_back();
  return hull;
}

double ClosedLength(std::span<const Eigen::Vector2d> points) {
  double length = 0.0;
  for (size_t i = 0; i < points.size(); ++i) length += (points[(i + 1) % points.size()] - points[i]).norm();
  return length;
}

double TapeLength(std::span<const Eigen::Vector2d> points) { return ClosedLength(ConvexHull(points)); }

PolygonMoments ComputeMoments(std::span<const Eigen::Vector2d> points) {
  PolygonMoments moments;
  if (points.empty()) return moments;
  // Relative to the first corner, so that a polygon far from the origin keeps its digits.
  const Eigen::Vector2d origin = points[0];
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
  double twice_area = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d a = points[i] - origin;
    const Eigen::Vector2d b = points[(i + 1) % points.size()] - origin;
    const double cross = Cross(a, b);
    twice_area += cross;
    weighted += cross * (a + b);
    mean += a;
  }
  mean /= static_cast<double>(points.size());
  moments.signed_area = 0.5 * twice_area;
  const bool flat = std::abs(twice_area) < 1e-18;
  moments.centroid = flat ? Eigen::Vector2d(origin + mean) : Eigen::Vector2d(origin + weighted / (3.0 * twice_area));
  return moments;
}

}  // namespace fitroom
