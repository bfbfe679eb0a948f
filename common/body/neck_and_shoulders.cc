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
constexpr double kSideNeckAngle = 52.0 * kDegree;
constexpr double kAcromionAngle = 52.0 * kDegree;
// The front neck lies below the side necks by 1.7 to 3.1 % of the stature, C7 above the middle of both by 0.8 %.
constexpr double kFrontNeckHighest = 0.0173;
constexpr double kFrontNeckLowest = 0.0313;
constexpr double kBackNeckRise = 0.0082;
constexpr double kSideNeckPart = 0.849;  // Of the stature, where no side neck is found.
// A raised arm goes on at the shoulder's own slope: no angle tells the edge, which then lies this far beyond the
// armpit.
constexpr double kRaisedArm = 40.0 * kDegree;
constexpr double kEdgeBeyondArmpit = 0.017;
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

// The neck's outline against the midline plane, in front (sign +1) or behind (-1), by falling height.
OutlineProfile MidlineProfile(const NeckSections& neck, double sign) {
  std::vector<Eigen::Vector2d> points;
  for (size_t i = 0; i < neck.loops.size(); ++i) {
    const std::optional<DepthRange> range = DepthAt(neck.loops[i], neck.middle_x);
    if (range) points.emplace_back(sign > 0.0 ? range->front : -range->back, neck.heights[i]);
  }
  return OutlineProfile(std::move(points));
}

// The first point of a profile at or below a height; the profile's end if there is none.
size_t FirstBelow(const OutlineProfile& profile, double height) {
  size_t i = 0;
  while (i + 1 < profile.size() && profile.points()[i].y() > height) ++i;
  return i;
}

// The front neck: from the deepest point of the throat down to where the profile has begun to lean out to the chest.
void FindFrontNeck(const NeckSections& neck, double base_height, double stature, BodyLandmarks& landmarks) {
  const OutlineProfile profile = MidlineProfile(neck, +1.0);
  if (profile.size() < 3) return;
  const size_t begin = FirstBelow(profile, base_height - kFrontNeckHighest * stature);
  const size_t end = FirstBelow(profile, base_height - kFrontNeckLowest * stature);
  size_t deepest = begin;
  for (size_t i = begin; i < end; ++i) {
    if (profile.points()[i].x() < profile.points()[deepest].x()) deepest = i;
  }
  const std::optional<double> lean = profile.FirstRiseAbove(kFrontNeckAngle, deepest, kNeckReach);
  const bool found = lean && *lean <= static_cast<double>(end);
  const Eigen::Vector2d point = profile.PointAt(found ? *lean : static_cast<double>(end));
  const double bridged = BridgedPart(neck.loops[NearestSection(neck, point.y())]);
  landmarks[BodyLandmark::kFrontNeck] = {Eigen::Vector3d(neck.middle_x, point.y(), point.x()),
                                         std::max(0.1, (found ? 0.95 : 0.7) - bridged)};
}

// C7 has no shape of its own on the skin of most people: it closes the neck's base, the plane through front neck and
// side necks, at the back.
void FindBackNeck(const NeckSections& neck, double base_height, double stature, BodyLandmarks& landmarks) {
  const OutlineProfile profile = MidlineProfile(neck, -1.0);
  if (profile.size() == 0) return;
  const double height =
      0.5 * (base_height + landmarks[BodyLandmark::kFrontNeck].position.y()) + kBackNeckRise * stature;
  const Eigen::Vector2d point = profile.points()[FirstBelow(profile, height)];
  const double bridged = BridgedPart(neck.loops[NearestSection(neck, point.y())]);
  landmarks[BodyLandmark::kBackNeckC7] = {Eigen::Vector3d(neck.middle_x, point.y(), -point.x()),
                                          std::max(0.1, 0.7 - bridged)};
}

// How the upper arm is held.
struct ArmPose {
  double angle = 0.0;         // From hanging straight down (unit: radian).
  double armpit_aside = 0.0;  // Of the armpit from the midline plane (unit: metre).
};

ArmPose PoseOf(const BodySlices& body, Side side) {
  ArmPose pose;
  const MergePoint& armpit = body.armpit[IndexOf(side)];
  if (!armpit.found) return pose;
  pose.armpit_aside = SignOf(side) * armpit.position.x();
  const SectionLoop* upper = body.At(armpit.position.y() - 0.01).ArmLoop(side);
  const SectionLoop* lower = body.At(armpit.position.y() - 0.08).ArmLoop(side);
  if (upper == nullptr || lower == nullptr) return pose;
  pose.angle = std::atan2(SignOf(side) * (lower->centroid.x() - upper->centroid.x()), 0.07);
  return pose;
}

// The first point of a profile that lies at least `aside` out; as a position on the profile.
std::optional<double> FirstBeyond(const OutlineProfile& profile, double aside, size_t begin) {
  for (size_t i = begin; i < profile.size(); ++i) {
    if (profile.points()[i].x() >= aside) return static_cast<double>(i);
  }
  return std::nullopt;
}

// The neck's and shoulder's outline from the front: where the neck has turned into the shoulder's slope, and where that
// slope turns down into the arm.
void FindOnSide(const NeckSections& neck, size_t thinnest, const ArmPose& arm, double stature, Side side,
                BodyLandmarks& landmarks) {
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
  const std::optional<double> edge = arm.angle > kRaisedArm
                                         ? FirstBeyond(profile, arm.armpit_aside + kEdgeBeyondArmpit * stature, after)
                                         : profile.FirstFallBelow(kAcromionAngle, after, kShoulderReach);
  if (!edge) return;
  place(BodyLandmark::kAcromionLeft, *edge);
  if (arm.angle > kRaisedArm) landmarks[OnSide(BodyLandmark::kAcromionLeft, side)].confidence *= 0.7;
}

}  // namespace

void FindNeckAndShoulders(const BodyShape& shape, BodyLandmarks& landmarks) {
  const BodySlice* thinnest = ThinnestNeck(shape.slices);
  if (thinnest == nullptr) return;
  const NeckSections neck = CutNeck(shape, *thinnest);
  if (neck.loops.size() < 3) return;
  double base_height = 0.0;
  int side_count = 0;
  for (const Side side : kSides) {
    FindOnSide(neck, NearestSection(neck, thinnest->height), PoseOf(shape.slices, side), shape.slices.stature, side,
               landmarks);
    const LandmarkEstimate& side_neck = landmarks[OnSide(BodyLandmark::kSideNeckLeft, side)];
    if (side_neck.confidence == 0.0) continue;
    base_height += side_neck.position.y();
    ++side_count;
  }
  base_height = side_count > 0 ? base_height / side_count : kSideNeckPart * shape.slices.stature;
  FindFrontNeck(neck, base_height, shape.slices.stature, landmarks);
  FindBackNeck(neck, base_height, shape.slices.stature, landmarks);
}

}  // namespace fitroom
