#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/body/landmark_search.h"
#include "common/body/outline_profile.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kFineStep = 0.0025;  // Between the sections of neck and shoulders (unit: metre).

// Tangent angles that mark a point on a profile, and the length over which the tangent is taken. They were read off
// the odd bodies of the external population and checked on the even ones (README.md has both).
constexpr double kFrontNeckAngle = 26.0 * kDegree;
constexpr double kBackNeckAngle = 22.0 * kDegree;
constexpr double kSideNeckAngle = 52.0 * kDegree;
constexpr double kAcromionAngle = 52.0 * kDegree;
constexpr double kNeckReach = 0.012;      // (unit: metre)
constexpr double kShoulderReach = 0.018;  // (unit: metre)

// The sections from the top of the neck to below the shoulders, by falling height.
struct NeckSections {
  std::vector<double> heights;
  std::vector<SectionLoop> loops;
  double middle_x = 0.0;  // Of the neck.
};

// The slice where a tape round the neck is shortest. (The area would not do: an open mouth is a hollow.)
const BodySlice* ThinnestNeck(const BodySlices& body) {
  const BodySlice* thinnest = nullptr;
  double shortest = 1e300;
  for (const BodySlice& slice : body.slices) {
    if (slice.height < 0.80 * body.stature || slice.height > 0.89 * body.stature) continue;
    if (slice.trunk < 0) continue;
    const double tape = TapeLength(slice.TrunkLoop()->points);
    if (tape >= shortest) continue;
    shortest = tape;
    thinnest = &slice;
  }
  return thinnest;
}

NeckSections CutNeck(const BodyShape& shape, const BodySlice& thinnest) {
  NeckSections neck;
  neck.middle_x = thinnest.TrunkLoop()->centroid.x();
  SectionOptions options;
  options.min_area = 1e-3;
  options.max_bridge = 0.2;
  const double stature = shape.slices.stature;
  const double top = thinnest.height + 0.015 * stature;
  for (double height = top; height > 0.74 * stature; height -= kFineStep) {
    std::vector<SectionLoop> loops = shape.index.CutAt(height, options);
    for (SectionLoop& loop : loops) {
      if (loop.bounds.min().x() > neck.middle_x || loop.bounds.max().x() < neck.middle_x) continue;
      neck.heights.push_back(height);
      neck.loops.push_back(std::move(loop));
      break;
    }
  }
  return neck;
}

double BridgedPart(const SectionLoop& loop) {
  double length = 0.0;
  for (size_t i = 1; i < loop.points.size(); ++i) length += (loop.points[i] - loop.points[i - 1]).norm();
  return length > 0.0 ? std::min(1.0, loop.bridge_length / length) : 1.0;
}

size_t NearestSection(const NeckSections& neck, double height) {
  const double number = (neck.heights.front() - height) / kFineStep + 0.5;
  return static_cast<size_t>(std::clamp(number, 0.0, static_cast<double>(neck.heights.size() - 1)));
}

void FindOnMidline(const NeckSections& neck, double stature, double neck_height, BodyLandmarks& landmarks) {
  std::vector<Eigen::Vector2d> front;
  std::vector<Eigen::Vector2d> back;
  for (size_t i = 0; i < neck.loops.size(); ++i) {
    const std::optional<DepthRange> range = DepthAt(neck.loops[i], neck.middle_x);
    if (!range) continue;
    front.emplace_back(range->front, neck.heights[i]);
    back.emplace_back(-range->back, neck.heights[i]);
  }
  const auto place = [&](BodyLandmark landmark, const OutlineProfile& profile, std::optional<double> position,
                         double sign) {
    if (profile.size() == 0) return;
    const bool found = position.has_value();
    const double fallback = (profile.points().front().y() - 0.825 * stature) / kFineStep;
    const Eigen::Vector2d point = profile.PointAt(found ? *position : fallback);
    LandmarkEstimate& estimate = landmarks[landmark];
    estimate.position = Eigen::Vector3d(neck.middle_x, point.y(), sign * point.x());
    const double bridged = BridgedPart(neck.loops[NearestSection(neck, point.y())]);
    estimate.confidence = std::max(0.1, (found ? 0.95 : 0.3) - bridged);
  };
  // From the deepest point of the throat down to where the profile has begun to lean out to the chest.
  const OutlineProfile front_profile(std::move(front));
  size_t deepest = 0;
  for (size_t i = 0; i < front_profile.size(); ++i) {
    const Eigen::Vector2d& p = front_profile.points()[i];
    if (p.y() < neck_height - 0.06 * stature) break;
    if (p.x() < front_profile.points()[deepest].x()) deepest = i;
  }
  place(BodyLandmark::kFrontNeck, front_profile, front_profile.FirstRiseAbove(kFrontNeckAngle, deepest, kNeckReach),
        +1.0);
  // The nape leans out, most at C7's upper edge, then runs straight down the back.
  const OutlineProfile back_profile(std::move(back));
  size_t steepest = 0;
  double steepest_angle = -1.0;
  for (size_t i = 0; i < back_profile.size(); ++i) {
    if (back_profile.points()[i].y() < neck_height - 0.05 * stature) break;
    const double angle = back_profile.AngleAt(i, kShoulderReach);
    if (angle > steepest_angle) {
      steepest_angle = angle;
      steepest = i;
    }
  }
  place(BodyLandmark::kBackNeckC7, back_profile,
        back_profile.FirstFallBelow(std::min(kBackNeckAngle, 0.8 * steepest_angle), steepest, kShoulderReach), -1.0);
}

void FindOnSide(const NeckSections& neck, size_t thinnest, Side side, BodyLandmarks& landmarks) {
  const double sign = SignOf(side);
  std::vector<Eigen::Vector2d> outline;
  std::vector<double> depth;
  for (size_t i = 0; i < neck.loops.size(); ++i) {
    const Eigen::Vector2d p = FarthestAlong(neck.loops[i], Eigen::Vector2d(sign, 0.0));
    outline.emplace_back(sign * p.x(), neck.heights[i]);
    depth.push_back(p.y());
  }
  const OutlineProfile profile(std::move(outline));
  const auto place = [&](BodyLandmark landmark, double position) {
    const Eigen::Vector2d point = profile.PointAt(position);
    const auto i = static_cast<size_t>(position);
    // The depth of a silhouette's point jumps along flat stretches: the mean over a few sections is steadier.
    double z = 0.0;
    const size_t begin = i >= 2 ? i - 2 : 0;
    const size_t end = std::min(depth.size(), i + 4);
    for (size_t k = begin; k < end; ++k) z += depth[k] / static_cast<double>(end - begin);
    LandmarkEstimate& estimate = landmarks[OnSide(landmark, side)];
    estimate.position = Eigen::Vector3d(sign * point.x(), point.y(), z);
    estimate.confidence = std::max(0.1, 0.95 - BridgedPart(neck.loops[NearestSection(neck, point.y())]));
  };
  const std::optional<double> side_neck = profile.FirstRiseAbove(kSideNeckAngle, thinnest, kShoulderReach);
  if (!side_neck) return;
  place(BodyLandmark::kSideNeckLeft, *side_neck);
  // The shoulder's slope is passed before its edge.
  const size_t after = static_cast<size_t>(*side_neck) + 4;
  const std::optional<double> acromion = profile.FirstFallBelow(kAcromionAngle, after, kShoulderReach);
  if (acromion) place(BodyLandmark::kAcromionLeft, *acromion);
}

}  // namespace

void FindNeckAndShoulders(const BodyShape& shape, BodyLandmarks& landmarks) {
  const BodySlice* thinnest = ThinnestNeck(shape.slices);
  if (thinnest == nullptr) return;
  const NeckSections neck = CutNeck(shape, *thinnest);
  if (neck.loops.size() < 3) return;
  FindOnMidline(neck, shape.slices.stature, thinnest->height, landmarks);
  for (const Side side : kSides) FindOnSide(neck, NearestSection(neck, thinnest->height), side, landmarks);
}

}  // namespace fitroom
