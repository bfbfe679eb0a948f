// Legs and feet, arms and hands.
#include <cmath>
#include <vector>

#include "body_center/scan/figure.h"
#include "body_center/scan/figure_parts.h"

namespace fitroom::body_center {
namespace {

const std::vector<HorizontalRow> kLegRows = {
    {4.5, 16.3, 2.7, 0.4, 3.6, -2.7, 2.0, 2.0},    {8.0, 16.2, 2.45, 0.4, 3.1, -2.5, 2.0, 2.0},
    {11.0, 16.2, 2.3, 0.2, 2.9, -2.5, 2.0, 2.0},   {15.0, 16.1, 2.65, -0.1, 2.9, -3.1, 2.0, 2.0},
    {19.0, 16.0, 3.3, -0.5, 3.2, -4.1, 2.0, 2.0},  {24.0, 15.8, 4.3, -0.8, 3.8, -5.4, 2.0, 2.0},
    {29.0, 15.5, 5.0, -0.9, 4.2, -6.2, 2.1, 2.0},  {34.0, 15.2, 5.35, -0.8, 4.6, -6.4, 2.1, 2.0},
    {38.0, 14.9, 5.25, -0.5, 4.9, -5.9, 2.1, 2.1}, {42.0, 14.5, 5.15, 0.1, 5.5, -4.9, 2.1, 2.1},
    {46.0, 13.9, 5.25, 0.7, 6.2, -4.2, 2.1, 2.2},  {49.0, 13.4, 5.45, 1.0, 6.6, -4.1, 2.1, 2.2},
    {53.0, 12.7, 5.7, 1.1, 7.0, -4.4, 2.1, 2.1},   {58.0, 11.9, 6.3, 1.1, 7.6, -5.2, 2.1, 2.1},
    {64.0, 11.1, 7.0, 1.0, 8.4, -6.2, 2.1, 2.1},   {70.0, 10.3, 7.7, 0.7, 9.0, -7.1, 2.1, 2.1},
    {76.0, 9.6, 8.2, 0.4, 9.4, -7.9, 2.1, 2.1},    {80.0, 9.3, 8.4, 0.2, 9.4, -8.4, 2.1, 2.1},
    {84.0, 8.9, 8.1, 0.1, 8.8, -8.2, 2.1, 2.1},    {88.0, 8.4, 6.7, 0.0, 7.2, -6.8, 2.0, 2.0},
    {92.0, 8.0, 4.0, 0.0, 4.2, -4.0, 2.0, 2.0},    {94.0, 8.0, 1.5, 0.0, 1.5, -1.5, 2.0, 2.0},
};

// One row of a foot or hand: section across the axis (unit: centimetre).
struct AcrossRow {
  double position, centre_u, half_width, centre_v, top, bottom, exponent;
};

// Along the foot from the heel; v is up from the floor.
const std::vector<AcrossRow> kFootRows = {
    {-5.4, 0.0, 1.3, 2.3, 3.4, 1.2, 2.0},  {-5.0, 0.0, 2.0, 2.4, 4.6, 0.6, 2.0},  {-3.8, 0.0, 2.8, 2.5, 6.0, -0.1, 2.2},
    {-1.5, 0.1, 3.2, 2.7, 7.6, -0.2, 2.3}, {1.5, 0.2, 3.2, 2.7, 8.2, -0.2, 2.3},  {4.5, 0.3, 3.4, 2.4, 7.2, -0.1, 2.3},
    {8.0, 0.4, 3.9, 1.9, 5.2, -0.1, 2.3},  {11.0, 0.4, 4.4, 1.5, 3.8, -0.2, 2.4}, {13.5, 0.3, 4.5, 1.3, 3.0, -0.2, 2.4},
    {15.5, 0.2, 4.1, 1.2, 2.4, -0.1, 2.2}, {17.0, 0.0, 3.2, 1.1, 1.9, 0.3, 2.0},
};

struct Toe {
  double u, length, radius;  // (unit: centimetre)
};
// From the big toe on the inner side.
const std::vector<Toe> kToes = {
    {-2.9, 18.6, 1.15}, {-0.85, 18.3, 0.85}, {0.85, 17.7, 0.8}, {2.35, 16.9, 0.78}, {3.6, 15.9, 0.75}};

std::vector<SweptSection> SectionsFrom(const std::vector<AcrossRow>& rows, double factor, double side) {
  std::vector<SweptSection> sections;
  for (const AcrossRow& row : rows) {
    sections.push_back({kCm * row.position, kCm * Eigen::Vector2d(side * row.centre_u, row.centre_v),
                        kCm * row.half_width * factor, kCm * (row.top - row.centre_v) * factor,
                        kCm * (row.centre_v - row.bottom) * factor, row.exponent, row.exponent});
  }
  return sections;
}

// Returns the frame with the given axis whose v is as near to `front` as it can be.
Eigen::Isometry3d FrameAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& front) {
  const Eigen::Vector3d w = axis.normalized();
  const Eigen::Vector3d v = (front - front.dot(w) * w).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = v.cross(w);
  frame.linear().col(1) = v;
  frame.linear().col(2) = w;
  frame.translation() = origin;
  return frame;
}

void AddFoot(double side, Figure& figure) {
  const double toe_out = 0.12;  // (unit: radian)
  const Eigen::Vector3d axis(side * std::sin(toe_out), 0.0, std::cos(toe_out));
  Eigen::Isometry3d frame = FrameAlong(PointCm(side * 16.2, 0.0, 0.0), axis, Eigen::Vector3d::UnitY());
  // u of the frame points to the figure's left where it looks along +z with v up.
  const double outward = frame.linear().col(0).x() * side > 0.0 ? 1.0 : -1.0;
  figure.solid.Add(MakeSweep(frame, SectionsFrom(kFootRows, 1.0, outward)), 0.02);
  for (const Toe& toe : kToes) {
    const Eigen::Vector3d root = frame * PointCm(outward * toe.u * 0.95, 1.25, 13.8);
    const Eigen::Vector3d tip = frame * PointCm(outward * toe.u * 0.9, toe.radius + 0.1, toe.length - toe.radius);
    figure.solid.Add(MakeRoundCone(root, kCm * toe.radius * 1.15, tip, kCm * toe.radius), 0.005);
  }
  figure.solid.Add(MakeEllipsoid(PointCm(side * 18.5, 7.2, -0.1), PointCm(0.9, 1.3, 1.2)), 0.012);
  figure.solid.Add(MakeEllipsoid(PointCm(side * 13.9, 8.0, 0.6), PointCm(0.9, 1.3, 1.3)), 0.012);
}

struct LimbRow {
  double position, half_width, front, back;  // (unit: centimetre)
};

const std::vector<LimbRow> kUpperArmRows = {
    {-4.2, 0.8, 0.9, 0.9}, {-3.7, 2.0, 2.1, 2.1}, {-2.2, 3.6, 3.8, 3.8}, {0.5, 4.6, 4.9, 4.9},   {4.0, 4.8, 5.0, 4.9},
    {8.0, 4.5, 4.8, 4.7},  {12.0, 4.2, 4.6, 4.5}, {17.0, 3.9, 4.2, 4.2}, {22.0, 3.65, 3.9, 3.8}, {26.0, 3.5, 3.6, 3.6},
    {29.5, 3.0, 3.0, 3.2}, {32.0, 2.0, 2.0, 2.0}, {33.0, 0.8, 0.8, 0.8}};
const std::vector<LimbRow> kForearmRows = {{-5.0, 0.8, 0.8, 0.8},  {-4.0, 2.0, 2.0, 2.0}, {-1.5, 3.1, 3.1, 3.1},
                                           {2.0, 3.65, 3.8, 3.5},  {5.0, 3.75, 4.0, 3.7}, {9.0, 3.5, 3.9, 3.5},
                                           {14.0, 2.85, 3.3, 3.0}, {19.0, 2.2, 2.8, 2.7}, {23.0, 1.9, 2.65, 2.6},
                                           {25.5, 1.9, 2.7, 2.6}};
// The palm: half_width is its thickness, front the side of the thumb.
const std::vector<LimbRow> kPalmRows = {{-1.5, 1.8, 2.6, 2.5}, {1.0, 1.6, 2.8, 2.6},   {3.5, 1.5, 3.4, 3.2},
                                        {6.0, 1.4, 3.75, 3.6}, {8.5, 1.2, 3.75, 3.65}, {9.8, 0.9, 3.5, 3.4}};

std::vector<SweptSection> SectionsFrom(const std::vector<LimbRow>& rows, double factor, double exponent) {
  std::vector<SweptSection> sections;
  for (const LimbRow& row : rows) {
    sections.push_back({kCm * row.position, Eigen::Vector2d::Zero(), kCm * row.half_width * factor,
                        kCm * row.front * factor, kCm * row.back * factor, exponent, exponent});
  }
  return sections;
}

struct Finger {
  double v, length, radius, spread;  // Place across the palm, length (unit: centimetre), spread (unit: radian).
};
const std::vector<Finger> kFingers = {
    {2.85, 7.0, 0.83, 0.10}, {0.98, 7.8, 0.85, 0.02}, {-0.95, 7.2, 0.80, -0.06}, {-2.75, 5.6, 0.72, -0.15}};

// `palm` has its axis along the hand, v towards the thumb; `inward` is the sign of u towards the body.
void AddFingers(const Eigen::Isometry3d& palm, double inward, Figure& figure) {
  const auto at = [&](double u, double v, double w) -> Eigen::Vector3d { return palm * PointCm(inward * u, v, w); };
  for (const Finger& finger : kFingers) {
    Eigen::Vector3d joint = at(0.0, finger.v, 8.6);
    double curl = 0.10, radius = finger.radius;
    for (const double share : {0.46, 0.30, 0.24}) {
      const Eigen::Vector3d step(inward * std::sin(curl), std::cos(curl) * std::sin(finger.spread),
                                 std::cos(curl) * std::cos(finger.spread));
      const Eigen::Vector3d next = joint + kCm * (finger.length + 0.6) * share * (palm.linear() * step);
      figure.solid.Add(MakeRoundCone(joint, kCm * radius, next, kCm * radius * 0.92), 0.003);
      joint = next;
      radius *= 0.92;
      curl += 0.17;
    }
  }
  figure.solid.Add(MakeRoundCone(at(0.5, 2.0, 1.5), 0.014, at(1.3, 4.1, 5.2), 0.0115), 0.01);
  figure.solid.Add(MakeRoundCone(at(1.3, 4.1, 5.2), 0.0105, at(1.5, 5.0, 8.0), 0.0095), 0.005);
  figure.solid.Add(MakeRoundCone(at(1.5, 5.0, 8.0), 0.0095, at(1.5, 5.4, 10.0), 0.0078), 0.003);
}

void AddArm(const FigureShape& shape, double side, Figure& figure) {
  const double breadth = 1.0 + 0.45 * (shape.bust - 1.0);
  const Eigen::Vector3d shoulder = PointCm(side * 15.2 * breadth, 133.0, -0.9);
  const Eigen::Vector3d upper(side * std::sin(shape.arm_angle), -std::cos(shape.arm_angle), -0.03);
  const double bend = 0.26;  // Of the elbow, forwards (unit: radian).
  const Eigen::Vector3d fore = std::cos(bend) * upper + std::sin(bend) * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d elbow = shoulder + 0.28 * upper;
  const Eigen::Vector3d wrist = elbow + 0.245 * fore;
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();

  figure.solid.AddGroup(ImplicitSolid::Region::kArm, 0.024);
  const double factor = shape.limb;
  figure.solid.Add(MakeSweep(FrameAlong(shoulder, upper, forward), SectionsFrom(kUpperArmRows, factor, 2.0)), 0.0);
  figure.solid.Add(MakeSweep(FrameAlong(elbow, fore, forward), SectionsFrom(kForearmRows, factor, 2.0)), 0.02);
  const double hand = 0.5 + 0.5 * factor;
  const Eigen::Isometry3d palm = FrameAlong(wrist, fore, forward);
  figure.solid.Add(MakeSweep(palm, SectionsFrom(kPalmRows, hand, 2.5)), 0.012);
  AddFingers(palm, palm.linear().col(0).x() * side > 0.0 ? -1.0 : 1.0, figure);
  if (side > 0.0) {
    figure.shoulder = shoulder;
    figure.elbow = elbow;
    figure.wrist = wrist;
  }
}

}  // namespace

void AddLegs(const FigureShape& shape, Figure& figure) {
  const std::vector<Eigen::Vector2d> factors = {
      {8.0, 0.5 + 0.5 * shape.limb}, {30.0, shape.limb}, {46.0, 0.3 + 0.7 * shape.limb}, {78.0, shape.hip}};
  const std::vector<Eigen::Vector2d> spreads = {{8.0, 1.0}, {80.0, shape.hip}};
  figure.solid.AddGroup(ImplicitSolid::Region::kLeg, 0.03);
  for (const double side : {1.0, -1.0}) {
    std::vector<SweptSection> sections;
    for (const HorizontalRow& row : kLegRows) {
      sections.push_back(SectionFromRow(row, SmoothProfile(factors, row.y), SmoothProfile(spreads, row.y), side));
    }
    // A small blend: the thighs must not grow together.
    figure.solid.Add(MakeSweep(VerticalSweepFrame(), sections), 0.012);
    figure.solid.Add(MakeEllipsoid(PointCm(side * 13.9, 47.5, 4.6), PointCm(2.6, 3.2, 2.6)), 0.02);
    AddFoot(side, figure);
  }
  figure.hip = PointCm(9.4 * shape.hip, 88.0, -0.3);
  figure.knee = PointCm(13.6, 48.0, 1.0);
  figure.ankle = PointCm(16.2, 7.5, 0.4);
}

void AddArms(const FigureShape& shape, Figure& figure) {
  for (const double side : {1.0, -1.0}) AddArm(shape, side, figure);
}

}  // namespace fitroom::body_center
