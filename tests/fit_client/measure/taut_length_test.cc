#include "fit_client/fit/measure/taut_length.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/measure/way_round_body.h"
#include "tests/fit_client/measure/band_on_cylinder.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Eigen::Vector2d> Circle(const Eigen::Vector2d& centre, double radius) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 720; ++i) {
    const double angle = 2.0 * kPi * i / 720;
    points.emplace_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

// A string from (-d, 0) to (d, 0) over a circle of radius r: two tangents and the arc between them.
TEST(TautLength, IsTwoTangentsAndAnArcOverACircle) {
  for (const double offset : {0.0, 0.003, 0.02}) {
    const double r = 0.15 + offset;
    for (const double d : {0.18, 0.25, 0.6}) {
      const double expected = 2.0 * std::sqrt(d * d - r * r) + r * (kPi - 2.0 * std::acos(r / d));
      EXPECT_NEAR(TautLength(Circle({0.0, 0.0}, 0.15), {-d, 0.0}, {d, 0.0}, offset), expected, 2e-4)
          << "offset " << offset << ", half width " << d;
    }
  }
}

TEST(TautLength, IsHalfTheGirthBetweenOppositeSides) {
  EXPECT_NEAR(TautLength(Circle({0.0, 0.0}, 0.15), {-0.153, 0.0}, {0.153, 0.0}, 0.003), kPi * 0.153, 2e-4);
}

// Breasts, buttocks: the string goes straight from one to the other, whatever lies between them.
TEST(TautLength, BridgesHollows) {
  std::vector<Eigen::Vector2d> both = Circle({-0.1, 0.0}, 0.05);
  const std::vector<Eigen::Vector2d> other = Circle({0.1, 0.0}, 0.05);
  both.insert(both.end(), other.begin(), other.end());
  // Up beside the one, a quarter of it, straight on, and down again.
  EXPECT_NEAR(TautLength(both, {-0.15, 0.0}, {0.15, 0.0}, 0.0), 2.0 * 0.05 * kPi / 2.0 + 0.2, 2e-4);
}

TEST(TautLength, IsStraightWhereNothingLiesOnTheLeft) {
  EXPECT_DOUBLE_EQ(TautLength({}, {-0.2, 0.0}, {0.2, 0.1}, 0.003), std::hypot(0.4, 0.1));
  EXPECT_DOUBLE_EQ(TautLength(Circle({0.0, -0.2}, 0.1), {-0.2, 0.0}, {0.2, 0.0}, 0.003), 0.4);
  // The same circle seen the other way round is on the left.
  EXPECT_GT(TautLength(Circle({0.0, -0.2}, 0.1), {0.2, 0.0}, {-0.2, 0.0}, 0.003), 0.5);
}

// A line that rises from its seams over a cylinder lies in a slanting plane: half the perimeter of an ellipse, against
// the half circle of the level way.
TEST(WayRoundBody, FollowsALineThatRisesFromItsSeams) {
  constexpr double kR = 0.15;
  Body body;
  body.mesh = MakeCylinder(kR);
  const WayRoundBody way(body, {});
  for (const bool is_front : {true, false}) {
    const double side = is_front ? 1.0 : -1.0;
    for (const double slope : {0.0, 0.2, 0.4}) {
      LineHalf half;
      half.ends = {Eigen::Vector3d(-kR, 1.0, 0.0), Eigen::Vector3d(kR, 1.0, 0.0)};
      half.centre = {0.0, 1.0 + slope * 2.0 * kR / kPi, side * 2.0 * kR / kPi};
      const std::optional<SectionPlane> plane = PlaneOf(half, is_front);
      ASSERT_TRUE(plane);
      EXPECT_NEAR(plane->v.y() / (side * plane->v.z()), slope, 1e-9);
      double expected = 0.0;  // Of (R cos t, R sqrt(1 + slope^2) sin t), by the midpoint rule.
      constexpr int kSteps = 2000;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) * kPi / kSteps;
        expected += kPi / kSteps * kR * std::sqrt(1.0 + slope * slope * std::cos(t) * std::cos(t));
      }
      EXPECT_NEAR(way.TautLengthOf(half, is_front, 0.0), expected, 1e-3) << slope;
    }
  }
}

// Too flat or too steep to say which way it leans: level.
TEST(WayRoundBody, TakesAHalfThatDoesNotBulgeAsLevel) {
  LineHalf half;
  half.ends = {Eigen::Vector3d(-0.15, 1.0, 0.0), Eigen::Vector3d(0.15, 1.02, 0.0)};
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(0.0, 1.03, 0.001), Eigen::Vector3d(0.0, 1.3, 0.1)}) {
    half.centre = centre;
    const std::optional<SectionPlane> plane = PlaneOf(half, /*is_front=*/true);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->u.y(), 0.0, 1e-12);
    EXPECT_NEAR(plane->v.y(), 0.0, 1e-12);
    EXPECT_GT(plane->v.z(), 0.99);
    EXPECT_NEAR(plane->origin.y(), centre.y(), 1e-12);
  }
  half.ends[1] = half.ends[0] + Eigen::Vector3d(0.0, 0.1, 0.0);
  EXPECT_FALSE(PlaneOf(half, true));
}

}  // namespace
}  // namespace fitroom
