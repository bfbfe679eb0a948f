#include "common/body/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

std::vector<Eigen::Vector2d> Circle(double radius, int corner_count, Eigen::Vector2d centre = {0.0, 0.0}) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < corner_count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corner_count;
    points.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

TEST(ConvexHull, DropsPointsInsideAndOnEdges) {
  const std::vector<Eigen::Vector2d> points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_DOUBLE_EQ(ClosedLength(hull), 8.0);
}

TEST(ConvexHull, HoldsEveryPointOnItsLeft) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(normal(random), 3.0 * normal(random));
  const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d offset = p - hull[i];
      EXPECT_GE(edge.x() * offset.y() - edge.y() * offset.x(), -1e-9);
    }
  }
}

TEST(ConvexHull, TakesDegenerateInput) {
  EXPECT_TRUE(ConvexHull({}).empty());
  const std::vector<Eigen::Vector2d> one(5, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(ConvexHull(one).size(), 1u);
  const std::vector<Eigen::Vector2d> line = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  EXPECT_NEAR(TapeLength(line), 2.0 * std::sqrt(18.0), 1e-12);
}

TEST(TapeLength, OfACircleIsItsCircumference) {
  EXPECT_NEAR(TapeLength(Circle(0.4, 4000)), 2.0 * std::numbers::pi * 0.4, 1e-6);
}

TEST(TapeLength, SpansHollows) {
  // An L-shape of unit squares: the tape cuts the inner corner along the diagonal of a unit square.
  const std::vector<Eigen::Vector2d> shape = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_NEAR(TapeLength(shape), 2.0 + 1.0 + std::sqrt(2.0) + 1.0 + 2.0, 1e-12);
}

TEST(ComputeMoments, OfARectangleFarFromTheOrigin) {
  const Eigen::Vector2d corner(1e4, -2e4);
  std::vector<Eigen::Vector2d> rectangle = {corner, corner + Eigen::Vector2d(0.3, 0.0),
                                            corner + Eigen::Vector2d(0.3, 0.2), corner + Eigen::Vector2d(0.0, 0.2)};
  PolygonMoments moments = ComputeMoments(rectangle);
  EXPECT_NEAR(moments.signed_area, 0.06, 1e-9);
  EXPECT_NEAR((moments.centroid - corner - Eigen::Vector2d(0.15, 0.1)).norm(), 0.0, 1e-9);
  std::reverse(rectangle.begin(), rectangle.end());
  EXPECT_NEAR(ComputeMoments(rectangle).signed_area, -0.06, 1e-9);
}

TEST(ComputeMoments, OfNoAreaIsTheMean) {
  const std::vector<Eigen::Vector2d> line = {{0, 0}, {1, 0}, {2, 0}};
  EXPECT_EQ(ComputeMoments(line).signed_area, 0.0);
  EXPECT_NEAR((ComputeMoments(line).centroid - Eigen::Vector2d(1, 0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(ComputeMoments({}).signed_area, 0.0);
}

}  // namespace
}  // namespace fitroom
