#include "common/body/tape_girths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr int kSlabCount = 256;
constexpr double kSmallestArea = 5e-4;  // Of an outline that is more than dirt (unit: square metre).
constexpr double kLargestBridge = 0.1;  // Over holes of the scan (unit: metre).
constexpr double kLargestGuess = 0.1;   // Part of an outline that may be bridges.
constexpr double kTrunkReach = 0.6;     // From a point of a trunk's section to the farthest other one (unit: metre).
constexpr double kBelowCrotch = 0.015;  // Where the thigh is measured; above, the legs' outlines touch (unit: metre).

SectionOptions Options() {
  SectionOptions options;
  options.min_area = kSmallestArea;
  options.max_bridge = kLargestBridge;
  return options;
}

bool IsKnown(const LandmarkEstimate& landmark) { return landmark.confidence > 0.0; }

}  // namespace

TapeGirths::TapeGirths(const Body& body) : body_(body), index_(body.mesh, kSlabCount) {}

std::vector<SectionLoop> TapeGirths::TrunkLoopsAt(double height, const HeightIndex& of) const {
  SectionPlane level;  // u is x and v is z, as of CutAt().
  level.origin.y() = height;
  return OfTrunk(of.CutAt(height, Options()), level);
}

std::vector<SectionLoop> TapeGirths::OfTrunk(std::vector<SectionLoop> loops, const SectionPlane& plane) const {
  if (loops.empty()) return loops;
  const BodyLandmarks& marks = body_.landmarks;
  const bool is_leg =
      IsKnown(marks[BodyLandmark::kCrotch]) && plane.origin.y() < marks[BodyLandmark::kCrotch].position.y();
  if (!is_leg) {
    loops.resize(1);
    return loops;
  }
  // An arm's outline has its middle beyond the hip joint's side; a leg's does not.
  const double hip_half = std::abs(body_.leg_left.root.x() - body_.leg_right.root.x());
  const double farthest = std::max(0.12, 0.9 * hip_half) + 0.1;
  // Hands hang beside the thighs: their outlines are small.
  const double smallest = 0.35 * loops.front().area;
  std::erase_if(loops, [&](const SectionLoop& loop) {
    return std::abs(plane.ToSpace(loop.centroid).x()) > farthest || loop.area < smallest;
  });
  return loops;
}

std::optional<double> TapeGirths::TrunkAt(double height) const {
  std::vector<Eigen::Vector2d> points;
  double bridges = 0.0;
  for (const SectionLoop& loop : TrunkLoopsAt(height, index_)) {
    points.insert(points.end(), loop.points.begin(), loop.points.end());
    bridges += loop.bridge_length;
  }
  if (points.empty()) return std::nullopt;
  const double tape = TapeLength(points);
  if (bridges > kLargestGuess * tape) return std::nullopt;
  return tape;
}

std::vector<Eigen::Vector2d> TapeGirths::TrunkOutlineAt(double height) const { return TrunkOutlineAt(height, index_); }

std::vector<Eigen::Vector2d> TapeGirths::TrunkOutlineAt(double height, const HeightIndex& of) const {
  std::vector<Eigen::Vector2d> points;
  for (const SectionLoop& loop : TrunkLoopsAt(height, of)) {
    points.insert(points.end(), loop.points.begin(), loop.points.end());
  }
  return points;
}

std::vector<Eigen::Vector2d> TapeGirths::TrunkOutlineIn(const SectionPlane& plane) const {
  return TrunkOutlineIn(plane, index_);
}

std::vector<Eigen::Vector2d> TapeGirths::TrunkOutlineIn(const SectionPlane& plane, const HeightIndex& of) const {
  const Eigen::Vector3d normal = plane.u.cross(plane.v);
  const double slope = std::hypot(normal.x(), normal.z()) / std::max(std::abs(normal.y()), 0.1);
  const double reach = kTrunkReach * slope + 1e-6;
  const std::vector<int> triangles = of.TrianglesBetween(plane.origin.y() - reach, plane.origin.y() + reach);
  std::vector<Eigen::Vector2d> points;
  for (const SectionLoop& loop : OfTrunk(CutByPlane(of.mesh(), triangles, plane, Options()), plane)) {
    points.insert(points.end(), loop.points.begin(), loop.points.end());
  }
  return points;
}

std::optional<double> TapeGirths::LimbGirth(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction,
                                            double reach) const {
  SectionPlane plane;
  plane.origin = centre;
  const Eigen::Vector3d unit = direction.normalized();
  plane.u = unit.cross(std::abs(unit.z()) < 0.8 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).normalized();
  plane.v = unit.cross(plane.u);
  const std::vector<int> triangles = index_.TrianglesBetween(centre.y() - reach, centre.y() + reach);
  std::optional<double> best;
  double nearest = 0.5 * reach;
  for (const SectionLoop& loop : CutByPlane(body_.mesh, triangles, plane, Options())) {
    const double away = loop.centroid.norm();
    if (away >= nearest || loop.bounds.exteriorDistance(Eigen::Vector2d(0.0, 0.0)) > 0.02) continue;
    const double tape = TapeLength(loop.points);
    if (loop.bridge_length > kLargestGuess * tape) continue;
    nearest = away;
    best = tape;
  }
  return best;
}

std::optional<double> TapeGirths::LegAt(double height) const {
  double sum = 0.0;
  int count = 0;
  for (const LimbAxis* leg : {&body_.leg_left, &body_.leg_right}) {
    const bool is_upper = height > leg->joint.y();
    const Eigen::Vector3d& from = is_upper ? leg->root : leg->joint;
    const Eigen::Vector3d& to = is_upper ? leg->joint : leg->end;
    if (std::abs(from.y() - to.y()) < 1e-3) continue;
    const double t = (height - from.y()) / (to.y() - from.y());
    const Eigen::Vector3d centre = from + t * (to - from);
    if (const auto girth = LimbGirth(centre, Eigen::Vector3d::UnitY(), 0.25)) {
      sum += *girth;
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::optional<GirthMeasurement> TapeGirths::Thigh() const {
  const LandmarkEstimate& crotch = body_.landmarks[BodyLandmark::kCrotch];
  if (!IsKnown(crotch)) return std::nullopt;
  // Thighs that touch share one outline: look lower until they part.
  for (const double below : {0.0, 0.015, 0.03, 0.05}) {
    const double height = crotch.position.y() - kBelowCrotch - below;
    const auto girth = LegAt(height);
    const auto both = TrunkAt(height);
    if (girth && both && *girth < 0.85 * *both) return GirthMeasurement{*girth, height};
  }
  return std::nullopt;
}

std::optional<GirthMeasurement> TapeGirths::Knee() const {
  const LandmarkEstimate& left = body_.landmarks[BodyLandmark::kKneeLeft];
  const LandmarkEstimate& right = body_.landmarks[BodyLandmark::kKneeRight];
  if (!IsKnown(left) || !IsKnown(right)) return std::nullopt;
  const double height = 0.5 * (left.position.y() + right.position.y());
  const auto girth = LegAt(height);
  if (!girth) return std::nullopt;
  return GirthMeasurement{*girth, height};
}

std::optional<GirthMeasurement> TapeGirths::UpperArm(double below_armpit) const {
  GirthMeasurement mean;
  int count = 0;
  for (const bool left : {true, false}) {
    const LimbAxis& arm = left ? body_.arm_left : body_.arm_right;
    const LandmarkEstimate& armpit = body_.landmarks[left ? BodyLandmark::kArmpitLeft : BodyLandmark::kArmpitRight];
    const Eigen::Vector3d along = arm.joint - arm.root;
    if (!IsKnown(armpit) || along.norm() < 0.05) continue;
    const Eigen::Vector3d unit = along.normalized();
    const double at = unit.dot(armpit.position - arm.root) + below_armpit;
    const Eigen::Vector3d centre = arm.root + std::clamp(at, 0.0, along.norm()) * unit;
    if (const auto girth = LimbGirth(centre, unit, 0.15)) {
      mean.girth += *girth;
      mean.height += centre.y();
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return GirthMeasurement{mean.girth / count, mean.height / count};
}

std::optional<double> TapeGirths::ShoulderBreadth() const {
  const LandmarkEstimate& left = body_.landmarks[BodyLandmark::kAcromionLeft];
  const LandmarkEstimate& right = body_.landmarks[BodyLandmark::kAcromionRight];
  if (!IsKnown(left) || !IsKnown(right)) return std::nullopt;
  return (left.position - right.position).norm();
}

}  // namespace fitroom
