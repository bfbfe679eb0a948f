#include "fit_client/fit/stages/dressing_guides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace fitroom {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Keeps of a chain that runs outwards and down what a string pulled taut over it would touch.
std::vector<Vector2d> TautOver(const std::vector<Vector2d>& points) {
  std::vector<Vector2d> hull;
  for (const Vector2d& point : points) {
    while (hull.size() >= 2 && Cross(hull.back() - hull[hull.size() - 2], point - hull.back()) >= 0.0) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

// The arm in the frontal plane of one side: axis points every centimetre from root to end with the outward direction.
struct ArmSample {
  Vector2d centre;
  Vector2d outward;  // Unit, across the axis, away from the torso and upwards.
};

std::vector<ArmSample> SampleArm(const LimbAxis& arm, int side) {
  const auto project = [side](const Eigen::Vector3d& p) { return Vector2d(side * p.x(), p.y()); };
  const std::vector<Vector2d> joints = {project(arm.root), project(arm.joint), project(arm.end)};
  std::vector<ArmSample> samples;
  for (size_t bone = 0; bone + 1 < joints.size(); ++bone) {
    const Vector2d along = joints[bone + 1] - joints[bone];
    const double length = along.norm();
    if (length < 0.02) continue;
    const Vector2d direction = along / length;
    const Vector2d outward(-direction.y(), direction.x());
    for (double s = 0.0; s < length; s += 0.01) samples.push_back({joints[bone] + s * direction, outward});
  }
  return samples;
}

// Walks from `start` along `direction` until the body ends; at most `limit` metres.
double DistanceToOutline(const FrontalMap& map, int side, const Vector2d& start, const Vector2d& direction,
                         double limit) {
  double distance = 0.0;
  for (double s = 0.0; s <= limit; s += 0.5 * map.pitch()) {
    const Vector2d p = start + s * direction;
    if (map.FrontDepth(side * p.x(), p.y(), 0.0))
      distance = s;
    else if (s > distance + 2.0 * map.pitch())
      break;
  }
  return distance;
}

Status RequireLandmark(const Body& body, BodyLandmark landmark) {
  if (body.landmarks[landmark].confidence > 0.0) return Status();
  return FailedPrecondition("LANDMARK_MISSING", "the scan shows no " + std::string(LandmarkName(landmark)) +
                                                    "; a top cannot be placed without it; scan again with the feet "
                                                    "apart and the arms away from the body");
}

// The torso's stretch in a row, and the next one on the same side: the arm.
DressingGuides::Level FindLevel(const FrontalMap& map, int side, double middle, double y, double fallback_end) {
  DressingGuides::Level level;
  level.torso_end = fallback_end;
  level.arm_begin = std::numeric_limits<double>::infinity();
  std::optional<double> torso_end;
  for (const FrontalMap::Run& run : map.RowRuns(y)) {
    const double near = side > 0 ? run.begin : -run.end;
    const double far = side > 0 ? run.end : -run.begin;
    if (near <= side * middle + 0.03 && far >= side * middle) torso_end = std::max(torso_end.value_or(far), far);
  }
  if (torso_end) level.torso_end = *torso_end;
  for (const FrontalMap::Run& run : map.RowRuns(y)) {
    const double near = side > 0 ? run.begin : -run.end;
    if (near > level.torso_end) level.arm_begin = std::min(level.arm_begin, near);
  }
  double front = -std::numeric_limits<double>::infinity();
  double back = std::numeric_limits<double>::infinity();
  for (double u = 0.0; u < level.torso_end - 0.01; u += 0.01) {
    front = std::max(front, map.FrontDepth(side * u, y, 0.0).value_or(front));
    back = std::min(back, map.BackDepth(side * u, y, 0.0).value_or(back));
  }
  if (front > back) {
    level.half_depth = 0.5 * (front - back);
    level.middle_depth = 0.5 * (front + back);
  }
  return level;
}

// Refuses a body on which nothing can be put between arm and trunk: seen from the front, most of the way from below the
// armpit to the wrist shows no gap.
Status RequireGapBesideArm(const DressingGuides& guides, const LimbAxis& arm, bool left) {
  constexpr double kBelowArmpit = 0.06;  // So far down scans may be webbed (unit: metre).
  constexpr double kMostClosed = 0.5;
  int closed = 0;
  int count = 0;
  for (size_t k = 0; k < guides.levels.size(); ++k) {
    const double y = guides.levels_begin - guides.level_step * static_cast<double>(k);
    if (y > guides.levels_begin - kBelowArmpit || y < arm.end.y()) continue;
    ++count;
    closed += std::isinf(guides.levels[k].arm_begin);
  }
  if (closed <= kMostClosed * count) return Status();
  return FailedPrecondition("ARMS_ALONG_BODY", std::string("the ") + (left ? "left" : "right") +
                                                   " arm lies along the body or before it, so that a top cannot be "
                                                   "put on between them; scan again with both arms a hand's breadth "
                                                   "or more away from the hips");
}

}  // namespace

Polyline::Polyline(std::vector<Vector2d> points) : points_(std::move(points)) {
  distances_.reserve(points_.size());
  for (size_t i = 0; i < points_.size(); ++i) {
    distances_.push_back(i == 0 ? 0.0 : distances_.back() + (points_[i] - points_[i - 1]).norm());
  }
}

Vector2d Polyline::At(double distance) const {
  FR_CHECK(points_.size() >= 2);
  size_t i = 1;
  while (i + 1 < points_.size() && distances_[i] < distance) ++i;
  const double span = std::max(distances_[i] - distances_[i - 1], 1e-9);
  return points_[i - 1] + (distance - distances_[i - 1]) / span * (points_[i] - points_[i - 1]);
}

double Polyline::DistanceAtAbscissa(double u) const {
  FR_CHECK(points_.size() >= 2);
  if (u <= points_.front().x()) return 0.0;
  for (size_t i = 1; i < points_.size(); ++i) {
    if (points_[i].x() < u) continue;
    const double span = std::max(points_[i].x() - points_[i - 1].x(), 1e-9);
    return distances_[i - 1] + (u - points_[i - 1].x()) / span * (distances_[i] - distances_[i - 1]);
  }
  return distances_.back();
}

const DressingGuides::Level& DressingGuides::LevelAt(double y) const {
  const double index = std::clamp((levels_begin - y) / level_step, 0.0, static_cast<double>(levels.size() - 1));
  return levels[static_cast<size_t>(std::lround(index))];
}

Result<DressingGuides> FindDressingGuides(const Body& body, const FrontalMap& map, int side, double clearance) {
  const bool left = side > 0;
  const BodyLandmark side_neck = left ? BodyLandmark::kSideNeckLeft : BodyLandmark::kSideNeckRight;
  const BodyLandmark acromion = left ? BodyLandmark::kAcromionLeft : BodyLandmark::kAcromionRight;
  const BodyLandmark armpit = left ? BodyLandmark::kArmpitLeft : BodyLandmark::kArmpitRight;
  for (const BodyLandmark landmark : {BodyLandmark::kFrontNeck, side_neck, acromion, armpit}) {
    FR_RETURN_IF_ERROR(RequireLandmark(body, landmark));
  }
  const std::vector<ArmSample> arm = SampleArm(left ? body.arm_left : body.arm_right, side);
  if (arm.size() < 10) {
    return FailedPrecondition("ARM_MISSING", std::string("the scan shows no ") + (left ? "left" : "right") +
                                                 " arm; scan again with both arms in view");
  }

  DressingGuides guides;
  std::vector<Vector2d> over;
  const double neck_u = side * body.landmarks[side_neck].position.x();
  const double acromion_u = side * body.landmarks[acromion].position.x();
  const double highest = body.landmarks[side_neck].position.y() + 0.005;
  for (double u = neck_u; u <= acromion_u; u += map.pitch()) {
    if (const std::optional<double> top = map.ColumnTop(side * u, highest)) over.emplace_back(u, *top + clearance);
  }
  for (const ArmSample& sample : arm) {
    const double outer = DistanceToOutline(map, side, sample.centre, sample.outward, 0.10);
    const Vector2d point = sample.centre + (outer + clearance) * sample.outward;
    if (over.empty() || point.x() > over.back().x() + 0.001 || point.y() < over.back().y() - 0.005) {
      if (point.x() > acromion_u - 0.01) over.push_back(point);
    }
    const double inner = DistanceToOutline(map, side, sample.centre, -sample.outward, 0.06);
    guides.arm_inside.emplace_back(sample.centre - (inner + clearance) * sample.outward);
  }
  guides.shoulder_line = Polyline(TautOver(over));
  if (guides.shoulder_line.points().size() < 2) {
    return FailedPrecondition("SHOULDER_MISSING",
                              "the scan shows no shoulder line; scan again with uncovered shoulders");
  }

  const Eigen::Vector3d armpit_place = body.landmarks[armpit].position;
  const double middle = body.landmarks[BodyLandmark::kFrontNeck].position.x();
  guides.levels_begin = armpit_place.y() - 0.01;
  double fallback_end = side * armpit_place.x();
  for (double y = guides.levels_begin; y > map.min_y() + 0.05; y -= guides.level_step) {
    guides.levels.push_back(FindLevel(map, side, middle, y, fallback_end));
    // Where arm and torso still touch, the stretch would run out to the elbow.
    DressingGuides::Level& level = guides.levels.back();
    level.torso_end = std::min(level.torso_end, fallback_end + 0.03);
    fallback_end = level.torso_end;
  }
  if (guides.levels.empty()) {
    return FailedPrecondition("TORSO_MISSING", "the scan ends at the armpits; scan the whole body");
  }
  FR_RETURN_IF_ERROR(RequireGapBesideArm(guides, left ? body.arm_left : body.arm_right, left));
  return guides;
}

}  // namespace fitroom
