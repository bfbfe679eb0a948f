#include "fit_client/fit/stages/tape_curve.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> Ellipse(double a, double b, int count) {
  std::vector<Vector2d> points;
  for (int k = 0; k < count; ++k) {
    const double t = 2.0 * M_PI * k / count;
    points.emplace_back(a * std::cos(t), b * std::sin(t));
  }
  return points;
}

// Ramanujan's second approximation; exact to 1e-9 for this ratio.
double EllipsePerimeter(double a, double b) {
  const double h = std::pow((a - b) / (a + b), 2);
  return M_PI * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

TEST(TapeCurve, IsAsLongAsTheEllipseAndTwoPiTheOffsetMore) {
  const std::vector<Vector2d> points = Ellipse(0.16, 0.11, 720);
  EXPECT_NEAR(TapeCurve(points, 0.0).length(), EllipsePerimeter(0.16, 0.11), 1e-5);
  EXPECT_NEAR(TapeCurve(points, 0.02).length(), EllipsePerimeter(0.16, 0.11) + 2.0 * M_PI * 0.02, 1e-4);
}

TEST(TapeCurve, RunsFromTheFrontOverTheLeftToTheBack) {
  TapeCurve tape(Ellipse(0.16, 0.11, 720), 0.01);
  tape.StartTowards({0.0, 0.0}, {0.0, 1.0});
  const double whole = tape.length();
  EXPECT_LT((tape.At(0.0) - Vector2d(0.0, 0.12)).norm(), 1e-4);
  EXPECT_LT((tape.At(0.25 * whole) - Vector2d(0.17, 0.0)).norm(), 1e-4);
  EXPECT_LT((tape.At(0.5 * whole) - Vector2d(0.0, -0.12)).norm(), 1e-4);
  EXPECT_LT((tape.At(-0.25 * whole) - Vector2d(-0.17, 0.0)).norm(), 1e-4);
  EXPECT_LT((tape.At(1.25 * whole) - tape.At(0.25 * whole)).norm(), 1e-12);
}

TEST(TapeCurve, EqualWaysAreEqualLengths) {
  TapeCurve tape(Ellipse(0.16, 0.11, 720), 0.01);
  const double step = tape.length() / 200.0;
  for (int k = 0; k < 200; ++k) {
    EXPECT_NEAR((tape.At((k + 1) * step) - tape.At(k * step)).norm(), step, 0.01 * step) << k;
  }
}

TEST(TapeCurve, SpansHollowsLikeATapeAndIsEmptyWithoutAnArea) {
  std::vector<Vector2d> square = {{0.1, 0.1}, {0.0, 0.02}, {-0.1, 0.1}, {-0.1, -0.1}, {0.1, -0.1}};
  EXPECT_NEAR(TapeCurve(square, 0.0).length(), 0.8, 1e-12);
  EXPECT_TRUE(TapeCurve(std::vector<Vector2d>{{0.0, 0.0}, {1.0, 1.0}}, 0.01).is_empty());
}

}  // namespace
}  // namespace fitroom
