#include "common/body/arm_separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr double kSpacing = 0.010;       // Between the corners of the resampled outline (unit: metre).
constexpr size_t kMaxCornerCount = 700;  // 4.2 m of outline: more than a section of any body has.

// Corners at even distances along the outline, counter-clockwise.
std::vector<Eigen::Vector2d> Resample(const SectionLoop& loop) {
  const double length = ClosedLength(loop.points);
  const size_t count = std::min(kMaxCornerCount, static_cast<size_t>(length / kSpacing));
  std::vector<Eigen::Vector2d> corners;
  if (count < 16) return corners;
  const double spacing = length / static_cast<double>(count);
  double next = 0.0;
  double walked = 0.0;
  for (size_t i = 0; i < loop.points.size() && corners.size() < count; ++i) {
    const Eigen::Vector2d& a = loop.points[i];
    const Eigen::Vector2d& b = loop.points[(i + 1) % loop.points.size()];
    const double edge = (b - a).norm();
    while (next < walked + edge && corners.size() < count) {
      corners.push_back(a + (next - walked) / edge * (b - a));
      next += spacing;
    }
    walked += edge;
  }
  if (ComputeMoments(corners).signed_area < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

bool IsInside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

// The straight line between two corners runs inside the polygon, as far as three samples tell.
bool ChordIsInside(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  for (const double part : {0.15, 0.5, 0.85}) {
    if (!IsInside(polygon, a + part * (b - a))) return false;
  }
  return true;
}

SectionLoop LoopOf(std::vector<Eigen::Vector2d> points, double bridge_length) {
  SectionLoop loop;
  const PolygonMoments moments = ComputeMoments(points);
  loop.area = std::abs(moments.signed_area);
  loop.centroid = moments.centroid;
  for (const Eigen::Vector2d& p : points) loop.bounds.extend(p);
  loop.points = std::move(points);
  loop.bridge_length = bridge_length;
  return loop;
}

// The best cut between corners `from` and `to` (counter-clockwise: the arm is from … to).
struct Cut {
  size_t from = 0, to = 0;
  double neck_ratio = 1e300;
};

Cut FindCut(const std::vector<Eigen::Vector2d>& corners, double middle_x, const ArmSeparationOptions& options) {
  const size_t count = corners.size();
  // Sums of cross products from corner 0 on, twice round, so that any run's area is one difference away.
  std::vector<double> sum(2 * count + 1, 0.0);
  for (size_t i = 0; i < 2 * count; ++i) {
    const Eigen::Vector2d& a = corners[i % count];
    const Eigen::Vector2d& b = corners[(i + 1) % count];
    sum[i + 1] = sum[i] + a.x() * b.y() - a.y() * b.x();
  }
  const double whole = 0.5 * sum[count];
  Cut best;
  best.neck_ratio = options.max_neck_ratio;
  bool found = false;
  for (size_t from = 0; from < count; ++from) {
    const Eigen::Vector2d& p = corners[from];
    if (options.sign * (p.x() - middle_x) < 0.0) continue;
    for (size_t to = from + 5; to < from + count - 5; ++to) {
      const Eigen::Vector2d& q = corners[to % count];
      if (options.sign * (q.x() - middle_x) < 0.0) continue;
      const double area = 0.5 * (sum[to] - sum[from] + q.x() * p.y() - q.y() * p.x());
      if (area < options.min_arm_area || area > options.max_arm_area || area > 0.45 * whole) continue;
      const double squared_length = (q - p).squaredNorm();
      if (squared_length >= best.neck_ratio * best.neck_ratio * area) continue;
      // The farthest corner of an arm lies beyond the cut.
      const Eigen::Vector2d& tip = corners[((from + to) / 2) % count];
      if (options.sign * (tip.x() - 0.5 * (p.x() + q.x())) < 0.0) continue;
      if (!ChordIsInside(corners, p, q)) continue;
      best = {from, to, std::sqrt(squared_length / area)};
      found = true;
    }
  }
  if (!found) best.neck_ratio = 1e300;
  return best;
}

}  // namespace

std::optional<ArmSeparation> SeparateArm(const SectionLoop& joined, const ArmSeparationOptions& options) {
  const std::vector<Eigen::Vector2d> corners = Resample(joined);
  if (corners.empty()) return std::nullopt;
  const Cut cut = FindCut(corners, joined.centroid.x(), options);
  if (cut.neck_ratio > options.max_neck_ratio) return std::nullopt;
  std::vector<Eigen::Vector2d> arm;
  std::vector<Eigen::Vector2d> trunk;
  for (size_t i = cut.from; i <= cut.to; ++i) arm.push_back(corners[i % corners.size()]);
  for (size_t i = cut.to; i <= cut.from + corners.size(); ++i) trunk.push_back(corners[i % corners.size()]);
  ArmSeparation separation;
  separation.cut_middle = 0.5 * (arm.front() + arm.back());
  separation.neck_ratio = cut.neck_ratio;
  separation.arm = LoopOf(std::move(arm), joined.bridge_length);
  separation.trunk = LoopOf(std::move(trunk), joined.bridge_length);
  return separation;
}

}  // namespace fitroom
