#include "shop_catalog/garment/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace fitroom::shop_catalog {
namespace {

// Coverage of a disc, computed from the distance of each pixel's centre to the circle.
cv::Mat Disc(double x, double y, double radius, cv::Size size) {
  cv::Mat coverage(size, CV_8U);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const double inside = radius - std::hypot(column + 0.5 - x, row + 0.5 - y) + 0.5;
      coverage.at<uint8_t>(row, column) = static_cast<uint8_t>(255.0 * std::clamp(inside, 0.0, 1.0));
    }
  }
  return coverage;
}

TEST(TraceOutline, FollowsACircleBetweenThePixels) {
  const Polygon outline = TraceOutline(Disc(100.3, 90.7, 60.25, {200, 200}), 2.0);
  ASSERT_GT(outline.size(), 100u);
  double mean_radius = 0.0;
  for (const Eigen::Vector2d& p : outline) {
    const double radius = (p - Eigen::Vector2d(100.3, 90.7)).norm();
    EXPECT_NEAR(radius, 60.25, 0.4);
    mean_radius += radius / static_cast<double>(outline.size());
  }
  EXPECT_NEAR(mean_radius, 60.25, 0.15);
  EXPECT_NEAR(SignedArea(outline), std::numbers::pi * 60.25 * 60.25, 0.005 * std::numbers::pi * 60.25 * 60.25);
}

TEST(TraceOutline, AnEmptyPictureHasNone) {
  EXPECT_TRUE(TraceOutline(cv::Mat(50, 50, CV_8U, cv::Scalar(0)), 2.0).empty());
}

TEST(Resample, PutsPointsAtEqualArcLengths) {
  const Polygon square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Polygon samples = Resample(square, 8);
  const Polygon expected = {{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {5, 10}, {0, 10}, {0, 5}};
  ASSERT_EQ(samples.size(), 8u);
  for (size_t i = 0; i < 8; ++i) EXPECT_LT((samples[i] - expected[i]).norm(), 1e-12);
}

TEST(SampledOutline, ConvexCornersTurnPositiveAndTheWholeWayRoundIsAFullTurn) {
  const Polygon shape = {{0, 0}, {100, 0}, {100, 100}, {50, 60}, {0, 100}};
  const SampledOutline outline(shape, 1.0);
  EXPECT_NEAR(outline.TurnAt(outline.IndexNear({100, 0}), 8), 0.5 * std::numbers::pi, 0.15);
  EXPECT_LT(outline.TurnAt(outline.IndexNear({50, 60}), 8), -1.0);
  double total = 0.0;
  for (int i = 0; i < outline.count(); ++i) total += outline.TurnAt(i, 1);
  EXPECT_NEAR(total, 2.0 * std::numbers::pi, 1e-9);
}

TEST(FillPolygon, CoversTheArea) {
  const Polygon shape = {{20.25, 20.5}, {120.25, 20.5}, {120.25, 90.5}, {20.25, 90.5}};
  EXPECT_NEAR(cv::countNonZero(FillPolygon(shape, {150, 150})), 7000, 180);
}

}  // namespace
}  // namespace fitroom::shop_catalog
