// The landmarks of a figure, from its construction: places are chosen by name, the surface there is found on the solid.
#include <algorithm>
#include <cmath>

#include "body_center/scan/figure_parts.h"
#include "body_center/scan/solved_figure.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;

// Returns the widest clearance between arm and torso at `height`, with the place of it on the frontal plane: the
// largest value over x of the smallest value over z. Positive: the arm hangs free there.
struct Clearance {
  double value = -1.0;
  Vector3d place = Vector3d::Zero();
};
Clearance FindClearance(const ImplicitSolid& solid, double height, double arm_x) {
  Clearance widest;
  for (double x = 0.06; x < arm_x; x += 0.002) {
    Clearance narrowest{1.0, Vector3d::Zero()};
    for (double z = -0.10; z <= 0.10; z += 0.004) {
      const Vector3d point(x, height, z);
      const double value = solid.Evaluate(point);
      if (value < narrowest.value) narrowest = {value, point};
    }
    if (narrowest.value > widest.value) widest = narrowest;
  }
  return widest;
}

// The apex of the hollow between the arm and the torso: the height above which no gap is left.
Vector3d FindArmpit(const Figure& figure) {
  const ImplicitSolid solid =
      figure.solid.RestrictedTo(Eigen::AlignedBox3d(Vector3d(0.05, 1.0, -0.12), Vector3d(0.4, 1.4, 0.12)));
  double free = 1.05, joined = 1.34;
  Vector3d apex = Vector3d::Zero();
  while (joined - free > 5e-4) {
    const double height = 0.5 * (free + joined);
    // The arm's axis at this height bounds the search on the outside.
    const double t = (figure.shoulder.y() - height) / (figure.shoulder.y() - figure.elbow.y());
    const double arm_x = figure.shoulder.x() + t * (figure.elbow.x() - figure.shoulder.x());
    const Clearance clearance = FindClearance(solid, height, arm_x);
    if (clearance.value > 0.0) {
      free = height;
      apex = clearance.place;
    } else {
      joined = height;
    }
  }
  return apex;
}

// The most prominent point of the left breast.
Vector3d FindBustPoint(const ImplicitSolid& solid) {
  Vector3d best = Vector3d::Zero();
  for (double y = 1.18; y < 1.27; y += 0.004) {
    for (double x = 0.04; x < 0.13; x += 0.004) {
      const Vector3d point = SurfacePoint(solid, Vector3d(x, y, 0.0), Vector3d::UnitZ());
      if (point.z() > best.z()) best = point;
    }
  }
  return best;
}

// The lowest point of the trunk between the legs.
Vector3d FindCrotch(const ImplicitSolid& solid) {
  Vector3d lowest(0.0, 1.0, 0.0);
  for (double z = -0.06; z <= 0.06; z += 0.002) {
    const Vector3d point = SurfacePoint(solid, Vector3d(0.0, 0.90, z), -Vector3d::UnitY());
    if (point.y() < lowest.y()) lowest = point;
  }
  return lowest;
}

}  // namespace

BodyLandmarks FindConstructedLandmarks(const Figure& figure, const FigureShape& shape,
                                       const BodyMeasurements& measurements) {
  const ImplicitSolid& solid = figure.solid;
  const ImplicitSolid trunk = solid.Without(ImplicitSolid::Region::kArm);
  const Vector3d front = Vector3d::UnitZ(), back = -front, left = Vector3d::UnitX(), up = Vector3d::UnitY();
  BodyLandmarks landmarks;
  const auto set = [&](BodyLandmark landmark, const Vector3d& position) { landmarks[landmark] = {position, 1.0}; };
  const auto set_pair = [&](BodyLandmark left_one, BodyLandmark right_one, const Vector3d& position) {
    set(left_one, position);
    set(right_one, OnSide(-1.0, position));
  };
  set(BodyLandmark::kCrown, SurfacePoint(solid, PointCm(0, 150, 2.2), up));
  set(BodyLandmark::kFrontNeck, SurfacePoint(solid, PointCm(0, 138.6, 0), front));
  set(BodyLandmark::kBackNeckC7, SurfacePoint(solid, PointCm(0, 141.8, 0), back));
  set(BodyLandmark::kNavel, SurfacePoint(solid, PointCm(0, 102.0, 0), front));
  set(BodyLandmark::kWaistFront, SurfacePoint(solid, Vector3d(0, measurements.waist.height, 0), front));
  set(BodyLandmark::kWaistBack, SurfacePoint(solid, Vector3d(0, measurements.waist.height, 0), back));
  set(BodyLandmark::kButtockMidBack, SurfacePoint(solid, Vector3d(0, measurements.hip.height, 0), back));
  set(BodyLandmark::kCrotch, FindCrotch(solid));

  const double breadth = 1.0 + 0.45 * (shape.bust - 1.0);
  set_pair(BodyLandmark::kSideNeckLeft, BodyLandmark::kSideNeckRight,
           SurfacePoint(trunk, PointCm(0, 142.4, -2.0), left));
  set_pair(BodyLandmark::kAcromionLeft, BodyLandmark::kAcromionRight,
           SurfacePoint(solid, PointCm(17.2 * breadth, 133.0, -0.9), up));
  set_pair(BodyLandmark::kArmpitLeft, BodyLandmark::kArmpitRight, FindArmpit(figure));
  set_pair(BodyLandmark::kBustPointLeft, BodyLandmark::kBustPointRight, FindBustPoint(trunk));
  set_pair(BodyLandmark::kHipSideLeft, BodyLandmark::kHipSideRight,
           SurfacePoint(trunk, Vector3d(0, measurements.hip.height, 0), left));
  return landmarks;
}

}  // namespace fitroom::body_center
