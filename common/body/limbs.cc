#include <algorithm>
#include <cmath>
#include <vector>

#include "common/body/landmark_search.h"
#include "common/body/outline_profile.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

// The middles of an arm's or leg's outlines, from its root to its end.
struct Centreline {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> lengths;  // Along the line from its first point.

  void Add(const Eigen::Vector3d& p) {
    lengths.push_back(points.empty() ? 0.0 : lengths.back() + (p - points.back()).norm());
    points.push_back(p);
  }
  double length() const { return lengths.empty() ? 0.0 : lengths.back(); }
  Eigen::Vector3d At(double along) const {
    const auto above = std::lower_bound(lengths.begin(), lengths.end(), along);
    if (above == lengths.begin()) return points.front();
    if (above == lengths.end()) return points.back();
    const auto i = static_cast<size_t>(above - lengths.begin());
    const double part = (along - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return points[i - 1] + part * (points[i] - points[i - 1]);
  }
};

// Parts of the way from the shoulder's joint to the fingertips at which people have elbow and wrist.
constexpr double kElbowPart = 0.385;
constexpr double kWristPart = 0.70;
// Parts of the way from the elbow to the fingertips between which the wrist is looked for.
constexpr double kWristLow = 0.42;
constexpr double kWristHigh = 0.62;
// Parts of the stature: an arm line shorter than the first is not a whole arm's; and the usual lengths of both pieces.
constexpr double kShortArm = 0.30;
constexpr double kUpperArm = 0.146;
constexpr double kForearm = 0.128;
// The ankle's joint above the floor, as a part of the stature.
constexpr double kAnklePart = 0.0427;

Centreline ArmLine(const BodySlices& body, Side side, const Eigen::Vector3d& root) {
  Centreline line;
  line.Add(root);
  for (size_t k = body.slices.size(); k-- > 0;) {
    const SectionLoop* loop = body.slices[k].ArmLoop(side);
    if (loop != nullptr) line.Add(Eigen::Vector3d(loop->centroid.x(), body.slices[k].height, loop->centroid.y()));
  }
  return line;
}

// Where two straight pieces fit the line best between `low` and `high` (parts of its length), and how much it bends
// there (unit: radian).
struct Bend {
  double along = 0.0;
  double angle = 0.0;
};

Bend FindBend(const Centreline& line, double end, double low, double high) {
  Bend best;
  double best_error = 1e300;
  const Eigen::Vector3d first = line.points.front();
  const Eigen::Vector3d last = line.At(end);
  for (double along = low; along <= high; along += 0.004) {
    const Eigen::Vector3d joint = line.At(along);
    double error = 0.0;
    for (double s = 0.0; s < end; s += 0.01) {
      const Eigen::Vector3d p = line.At(s);
      const Eigen::Vector3d& from = s < along ? first : joint;
      const Eigen::Vector3d direction = (s < along ? Eigen::Vector3d(joint - first) : Eigen::Vector3d(last - joint));
      const Eigen::Vector3d unit = direction.normalized();
      error += ((p - from) - unit.dot(p - from) * unit).squaredNorm();
    }
    if (error >= best_error) continue;
    best_error = error;
    best.along = along;
    best.angle = std::acos(std::clamp((joint - first).normalized().dot((last - joint).normalized()), -1.0, 1.0));
  }
  return best;
}

// Where a tape round the forearm is shortest: the girth of the section across the line, between `low` and `high`.
double FindThinnest(const BodyShape& shape, const Centreline& line, double low, double high) {
  const double top = std::max(line.At(low).y(), line.At(high).y()) + 0.06;
  const double bottom = std::min(line.At(low).y(), line.At(high).y()) - 0.06;
  const std::vector<int> triangles = shape.index.TrianglesBetween(bottom, top);
  double thinnest = 0.5 * (low + high);
  double shortest = 1e300;
  for (double along = low; along <= high; along += 0.006) {
    const Eigen::Vector3d direction = (line.At(along + 0.03) - line.At(along - 0.03)).normalized();
    SectionPlane plane;
    plane.origin = line.At(along);
    plane.u = direction.cross(Eigen::Vector3d::UnitZ()).normalized();
    plane.v = direction.cross(plane.u);
    SectionOptions options;
    options.min_area = 5e-4;
    options.max_bridge = 0.1;
    for (const SectionLoop& loop : CutByPlane(shape.index.mesh(), triangles, plane, options)) {
      if (loop.bounds.exteriorDistance(Eigen::Vector2d(0.0, 0.0)) > 0.0 || loop.centroid.norm() > 0.05) continue;
      const double tape = TapeLength(loop.points);
      if (tape < shortest) {
        shortest = tape;
        thinnest = along;
      }
      break;
    }
  }
  return thinnest;
}

LimbAxis FindArm(const BodyShape& shape, Side side, BodyLandmarks& landmarks) {
  const LandmarkEstimate& acromion = landmarks[OnSide(BodyLandmark::kAcromionLeft, side)];
  const LandmarkEstimate& armpit = landmarks[OnSide(BodyLandmark::kArmpitLeft, side)];
  LimbAxis axis;
  if (acromion.confidence == 0.0 || armpit.confidence == 0.0) return axis;
  // The joint lies between both, a little above and inside of the middle.
  const double stature = shape.slices.stature;
  axis.root = 0.5 * (acromion.position + armpit.position) +
              Eigen::Vector3d(-SignOf(side) * 0.004 * stature, 0.006 * stature, 0.0);
  const Centreline line = ArmLine(shape.slices, side, axis.root);
  if (line.points.size() < 5) return axis;
  const double length = line.length();
  if (length < kShortArm * stature) {
    // Lost where it lies against the body: straight on in its direction, as long as arms are.
    const Eigen::Vector3d direction = (line.points.back() - axis.root).normalized();
    axis.joint = axis.root + kUpperArm * stature * direction;
    axis.end = axis.joint + kForearm * stature * direction;
    landmarks[OnSide(BodyLandmark::kElbowLeft, side)] = {axis.joint, 0.1};
    landmarks[OnSide(BodyLandmark::kWristLeft, side)] = {axis.end, 0.1};
    return axis;
  }
  Bend bend = FindBend(line, kWristPart * length, 0.30 * length, 0.47 * length);
  const bool clear = bend.angle > 0.17;
  if (!clear) bend.along = kElbowPart * length;
  const double hand = length - bend.along;
  const double wrist = FindThinnest(shape, line, bend.along + kWristLow * hand, bend.along + kWristHigh * hand);
  axis.joint = line.At(bend.along);
  axis.end = line.At(wrist);
  // The landmarks lie on the skin: the elbow's point behind, the wrist's outside.
  const auto on_skin = [&](BodyLandmark landmark, const Eigen::Vector3d& inside, const Eigen::Vector2d& direction,
                           double confidence) {
    const SectionLoop* loop = shape.slices.At(inside.y()).ArmLoop(side);
    if (loop == nullptr) return;
    const Eigen::Vector2d p = FarthestAlong(*loop, direction);
    landmarks[OnSide(landmark, side)] = {Eigen::Vector3d(p.x(), inside.y(), p.y()), confidence};
  };
  const double trust = std::min(acromion.confidence, armpit.confidence);
  on_skin(BodyLandmark::kElbowLeft, axis.joint, Eigen::Vector2d(0.0, -1.0), std::min(trust, clear ? 0.8 : 0.5));
  on_skin(BodyLandmark::kWristLeft, axis.end, Eigen::Vector2d(SignOf(side), 0.0), std::min(trust, 0.7));
  return axis;
}

// The knee's height: between the hollow behind it, where the back of the leg lies farthest forward, and the lower edge
// of the kneecap, where the front of the leg steps forward most.
double FindKneeHeight(const BodySlices& body, Side side) {
  double hollow = 0.0;
  double hollow_depth = -1e300;
  double edge = 0.0;
  double edge_step = -1e300;
  for (double height = 0.22 * body.stature; height < 0.36 * body.stature; height += kSliceStep) {
    const SectionLoop* loop = body.At(height).LegLoop(side);
    const SectionLoop* above = body.At(height + 0.01).LegLoop(side);
    const SectionLoop* below = body.At(height - 0.01).LegLoop(side);
    if (loop == nullptr || above == nullptr || below == nullptr) continue;
    const double depth = above->bounds.min().y() + loop->bounds.min().y() + below->bounds.min().y();
    if (depth > hollow_depth) {
      hollow_depth = depth;
      hollow = height;
    }
    const double step = above->bounds.max().y() - below->bounds.max().y();
    if (step > edge_step) {
      edge_step = step;
      edge = height;
    }
  }
  return 0.5 * (hollow + edge) + 0.003 * body.stature;
}

LimbAxis FindLeg(const BodyShape& shape, Side side, BodyLandmarks& landmarks) {
  const BodySlices& body = shape.slices;
  const LandmarkEstimate& crotch = landmarks[BodyLandmark::kCrotch];
  const double hip_height = crotch.position.y() + 0.046 * body.stature;
  LimbAxis axis;
  const BodySlice& hip = body.At(hip_height);
  if (hip.trunk < 0) return axis;
  const Eigen::AlignedBox2d& bounds = hip.TrunkLoop()->bounds;
  const double middle = hip.TrunkLoop()->centroid.x();
  const double half_width = side == Side::kLeft ? bounds.max().x() - middle : middle - bounds.min().x();
  axis.root = Eigen::Vector3d(middle + SignOf(side) * 0.57 * half_width, hip_height, hip.TrunkLoop()->centroid.y());
  const auto centre = [&](double height) {
    const SectionLoop* loop = body.At(height).LegLoop(side);
    if (loop == nullptr) return axis.root;
    return Eigen::Vector3d(loop->centroid.x(), height, loop->centroid.y());
  };
  const double knee_height = FindKneeHeight(body, side);
  axis.joint = centre(knee_height);
  axis.end = centre(kAnklePart * body.stature);
  const auto on_skin = [&](BodyLandmark landmark, double height, const Eigen::Vector2d& direction, double confidence) {
    const SectionLoop* loop = body.At(height).LegLoop(side);
    if (loop == nullptr) return;
    const Eigen::Vector2d p = FarthestAlong(*loop, direction);
    landmarks[OnSide(landmark, side)] = {Eigen::Vector3d(p.x(), height, p.y()), confidence};
  };
  on_skin(BodyLandmark::kKneeLeft, knee_height, Eigen::Vector2d(0.0, 1.0), 0.7);
  on_skin(BodyLandmark::kAnkleLeft, kAnklePart * body.stature, Eigen::Vector2d(SignOf(side), 0.0), 0.5);
  return axis;
}

}  // namespace

LimbAxes FindLimbs(const BodyShape& shape, BodyLandmarks& landmarks) {
  LimbAxes axes;
  axes.arm_left = FindArm(shape, Side::kLeft, landmarks);
  axes.arm_right = FindArm(shape, Side::kRight, landmarks);
  axes.leg_left = FindLeg(shape, Side::kLeft, landmarks);
  axes.leg_right = FindLeg(shape, Side::kRight, landmarks);
  return axes;
}

}  // namespace fitroom
