#include "body_center/scan/solved_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/body/polygon.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A stretch of heights in which the largest or smallest girth is looked for (unit: metre).
struct Stretch {
  double low, high, step;
  bool smallest;
};
constexpr Stretch kWaistStretch = {1.02, 1.14, 0.005, true};
constexpr Stretch kHipStretch = {0.83, 0.96, 0.005, false};
constexpr Stretch kNeckStretch = {1.42, 1.46, 0.01, true};

GirthMeasurement FindGirth(const ImplicitSolid& solid, const Stretch& stretch) {
  GirthMeasurement found{stretch.smallest ? 1e9 : 0.0, stretch.low};
  for (double height = stretch.low; height <= stretch.high + 1e-9; height += stretch.step) {
    const double girth = TorsoGirth(solid, height);
    if (stretch.smallest ? girth < found.girth : girth > found.girth) found = {girth, height};
  }
  return found;
}

BodyMeasurements Measure(const Figure& figure, const FigureShape& shape) {
  const ImplicitSolid trunk = figure.solid.Without(ImplicitSolid::Region::kArm);
  BodyMeasurements measured;
  measured.stature = kReferenceStature;
  measured.bust = {TorsoGirth(trunk, BustHeight(shape)), BustHeight(shape)};
  measured.waist = FindGirth(trunk, kWaistStretch);
  measured.hip = FindGirth(trunk, kHipStretch);
  measured.neck = FindGirth(trunk, kNeckStretch);
  return measured;
}

FigureShape FirstShape(const BodySpecification& specification, double scale) {
  FigureShape shape;
  shape.bust = specification.bust / 0.88 / scale;
  shape.waist = specification.waist / 0.70 / scale;
  shape.hip = specification.hip / 0.95 / scale;
  shape.neck = NeckGirth(specification) / 0.33 / scale;
  // Limbs follow the trunk at two thirds of its rate.
  shape.limb = 1.0 / 3.0 + (shape.bust + shape.hip) / 3.0;
  shape.arm_angle = specification.arm_angle;
  return shape;
}

void ScaleToBody(SolvedFigure& solved) {
  for (GirthMeasurement* girth :
       {&solved.measurements.bust, &solved.measurements.waist, &solved.measurements.hip, &solved.measurements.neck}) {
    girth->girth *= solved.scale;
    girth->height *= solved.scale;
  }
  solved.measurements.stature *= solved.scale;
  for (LandmarkEstimate& landmark : solved.landmarks.estimates) landmark.position *= solved.scale;
}

}  // namespace

double TorsoGirth(const ImplicitSolid& solid, double height) {
  constexpr int kRays = 96;  // Over the left half; the right mirrors it.
  const ImplicitSolid level =
      solid.RestrictedTo(Eigen::AlignedBox3d(Vector3d(-0.5, height, -0.3), Vector3d(0.5, height, 0.3)));
  std::vector<Vector2d> points;
  for (int i = 0; i <= kRays; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kRays - 0.5);
    const Vector3d point =
        SurfacePoint(level, Vector3d(0.0, height, 0.0), Vector3d(std::cos(angle), 0.0, std::sin(angle)));
    points.emplace_back(point.x(), point.z());
    points.emplace_back(-point.x(), point.z());
  }
  return TapeLength(points);
}

Vector3d SurfacePoint(const ImplicitSolid& solid, const Vector3d& inside, const Vector3d& direction) {
  constexpr double kStep = 0.008;
  constexpr double kLimit = 0.4;
  double low = 0.0, high = kStep;
  double low_value = solid.Evaluate(inside), high_value = solid.Evaluate(inside + high * direction);
  while (high_value < 0.0 && high < kLimit) {
    low = high;
    low_value = high_value;
    high += kStep;
    high_value = solid.Evaluate(inside + high * direction);
  }
  // Secant steps between the last point inside and the first outside.
  for (int i = 0; i < 6 && high - low > 1e-6; ++i) {
    const double share = std::clamp(low_value / (low_value - high_value), 0.05, 0.95);
    const double middle = low + share * (high - low);
    const double value = solid.Evaluate(inside + middle * direction);
    if (value < 0.0) {
      low = middle;
      low_value = value;
    } else {
      high = middle;
      high_value = value;
    }
  }
  return inside + (low + (high - low) * std::clamp(low_value / (low_value - high_value), 0.0, 1.0)) * direction;
}

Result<SolvedFigure> SolveFigure(const BodySpecification& specification) {
  FR_RETURN_IF_ERROR(ValidateBodySpecification(specification));
  constexpr double kTolerance = 0.0005;  // Of a girth (unit: metre).
  constexpr int kMaxRounds = 25;
  SolvedFigure solved;
  solved.scale = specification.stature / kReferenceStature;
  solved.shape = FirstShape(specification, solved.scale);
  for (int round = 0; round < kMaxRounds; ++round) {
    solved.figure = BuildFigure(solved.shape);
    solved.measurements = Measure(solved.figure, solved.shape);
    double worst = 0.0;
    const auto correct = [&](double& factor, double measured, double asked) {
      worst = std::max(worst, std::abs(measured * solved.scale - asked));
      factor *= asked / (measured * solved.scale);
    };
    FigureShape next = solved.shape;
    correct(next.bust, solved.measurements.bust.girth, specification.bust);
    correct(next.waist, solved.measurements.waist.girth, specification.waist);
    correct(next.hip, solved.measurements.hip.girth, specification.hip);
    correct(next.neck, solved.measurements.neck.girth, NeckGirth(specification));
    if (worst <= kTolerance) {
      solved.landmarks = FindConstructedLandmarks(solved.figure, solved.shape, solved.measurements);
      ScaleToBody(solved);
      return solved;
    }
    solved.shape = next;
  }
  return InvalidArgument(
      "MEASUREMENTS_DO_NOT_GO_TOGETHER",
      "no body with these girths was found: bring --bust-cm, --waist-cm and --hip-cm nearer together");
}

}  // namespace fitroom::body_center
