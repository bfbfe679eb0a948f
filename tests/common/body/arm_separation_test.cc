#include "common/body/arm_separation.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;

// The outline of an ellipse (half axes 15 and 11 cm, round the origin) and of a circle (radius 4.5 cm) beside it that
// overlap by `overlap`: what the section of a trunk with an arm against it looks like.
struct TrunkAndArm {
  SectionLoop loop;
  double trunk_tape = 0.0;
  double arm_area = 0.0;
};

TrunkAndArm MakeTrunkAndArm(double overlap, double sign) {
  const double a = 0.15;
  const double b = 0.11;
  const double radius = 0.045;
  const Eigen::Vector2d centre(a + radius - overlap, 0.0);
  std::vector<Eigen::Vector2d> ellipse;
  std::vector<Eigen::Vector2d> outline;
  const auto in_ellipse = [&](const Eigen::Vector2d& p) {
    return p.x() * p.x() / (a * a) + p.y() * p.y() / (b * b) < 1.0;
  };
  // Counter-clockwise from the point of the ellipse opposite the arm, round the arm, and back.
  std::vector<Eigen::Vector2d> before;
  std::vector<Eigen::Vector2d> after;
  for (int i = 0; i < 2000; ++i) {
    const double angle = -kPi + 2.0 * kPi * i / 2000.0;
    const Eigen::Vector2d p(a * std::cos(angle), b * std::sin(angle));
    ellipse.push_back(p);
    if ((p - centre).norm() < radius) continue;
    (angle < 0.0 ? before : after).push_back(p);
  }
  outline = before;
  for (int i = 0; i < 1000; ++i) {
    const double angle = -kPi + 2.0 * kPi * i / 1000.0;
    const Eigen::Vector2d p = centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (!in_ellipse(p)) outline.push_back(p);
  }
  outline.insert(outline.end(), after.begin(), after.end());
  for (Eigen::Vector2d& p : outline) p.x() *= sign;
  TrunkAndArm made;
  made.trunk_tape = TapeLength(ellipse);
  made.arm_area = kPi * radius * radius;
  const PolygonMoments moments = ComputeMoments(outline);
  made.loop.area = std::abs(moments.signed_area);
  made.loop.centroid = moments.centroid;
  for (const Eigen::Vector2d& p : outline) made.loop.bounds.extend(p);
  made.loop.points = std::move(outline);
  return made;
}

TEST(SeparateArm, LeavesTheTrunksGirthWhereAnArmTouches) {
  for (const double sign : {1.0, -1.0}) {
    for (const double overlap : {0.002, 0.006, 0.012}) {
      const TrunkAndArm made = MakeTrunkAndArm(overlap, sign);
      ArmSeparationOptions options;
      options.sign = sign;
      const auto parts = SeparateArm(made.loop, options);
      ASSERT_TRUE(parts) << overlap;
      EXPECT_NEAR(TapeLength(parts->trunk.points), made.trunk_tape, 0.005);
      EXPECT_NEAR(parts->arm.area, made.arm_area, 0.2 * made.arm_area);
      EXPECT_GT(sign * parts->arm.centroid.x(), 0.15);
      EXPECT_NEAR(parts->trunk.area + parts->arm.area, made.loop.area, 2e-4);
      EXPECT_GT(TapeLength(made.loop.points), made.trunk_tape + 0.05);  // What it would have been with the arm.
    }
  }
}

TEST(SeparateArm, NeckGrowsWithTheContact) {
  double before = 0.0;
  for (const double overlap : {0.002, 0.005, 0.010, 0.015}) {
    const auto parts = SeparateArm(MakeTrunkAndArm(overlap, 1.0).loop, {});
    ASSERT_TRUE(parts);
    EXPECT_GT(parts->neck_ratio, before);
    before = parts->neck_ratio;
  }
}

TEST(SeparateArm, FindsNoneOnTheOtherSideOrInATrunkAlone) {
  const TrunkAndArm made = MakeTrunkAndArm(0.005, 1.0);
  ArmSeparationOptions other_side;
  other_side.sign = -1.0;
  EXPECT_FALSE(SeparateArm(made.loop, other_side));
  SectionLoop ellipse;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * kPi * i / 1000.0;
    ellipse.points.emplace_back(0.15 * std::cos(angle), 0.11 * std::sin(angle));
  }
  EXPECT_FALSE(SeparateArm(ellipse, {}));
  EXPECT_FALSE(SeparateArm(SectionLoop(), {}));
}

}  // namespace
}  // namespace fitroom
