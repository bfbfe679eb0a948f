#include "fit_client/fit/measure/taut_length.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fitroom
