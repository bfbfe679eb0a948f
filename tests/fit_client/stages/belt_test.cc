#include "fit_client/fit/stages/belt.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fit_client/stages/tube_skirt.h"

namespace fitroom {
namespace {

constexpr double kHalfWidth = 0.16;
constexpr double kHalfDepth = 0.11;
constexpr double kHeight = 1.02;

std::vector<Eigen::Vector2d> Section() {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 720; ++k) {
    const double t = M_PI * k / 360.0;
    points.emplace_back(kHalfWidth * std::cos(t), kHalfDepth * std::sin(t));
  }
  return points;
}

// Ramanujan's second approximation; exact to 1e-9 for this ratio.
double Perimeter() {
  const double h = std::pow((kHalfWidth - kHalfDepth) / (kHalfWidth + kHalfDepth), 2);
  return M_PI * (kHalfWidth + kHalfDepth) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

// The size answer is edge minus perimeter, whatever the belt does about it afterwards.
TEST(Belt, AWideEdgeIsTooWideByTheDifferenceAndANarrowOneTooShort) {
  for (const double ease : {0.06, 0.0, -0.031}) {
    const ClothMesh skirt = testing::MakeTubeSkirt(0.5 * (Perimeter() + ease), 0.6, 0.5, 36, 20);
    const BottomOutline outline = FindBottomOutline(skirt).value();
    const Result<Belt> belt = LayBelt(outline, Section(), kHeight, 0.0, 0.004);
    ASSERT_TRUE(belt.ok()) << belt.status().ToString();
    EXPECT_NEAR(belt->measure.ease(), ease, 1e-5);
    EXPECT_NEAR(belt->measure.body_girth, Perimeter(), 1e-5);
    EXPECT_EQ(belt->measure.height, kHeight);
  }
}

// Wide or narrow, the edge lies on the ellipse at the offset, evenly spread: equal stretches of edge take equal
// stretches of belt, the middle of the front at the front, e1 at the left.
TEST(Belt, HoldsTheEdgeByArcLengthFromTheCentreFront) {
  const double offset = 0.004;
  const ClothMesh skirt = testing::MakeTubeSkirt(0.5 * (Perimeter() + 0.06), 0.6, 0.5, 36, 20);
  const Belt belt = LayBelt(FindBottomOutline(skirt).value(), Section(), kHeight, 0.0, offset).value();
  const auto target = [&](int particle) {
    for (const Attachment& attachment : belt.attachments) {
      if (attachment.particle == particle) return attachment.target;
    }
    ADD_FAILURE() << "particle " << particle << " is not held";
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  EXPECT_LT((target(18) - Eigen::Vector3d(0.0, kHeight, kHalfDepth + offset)).norm(), 1e-4);
  EXPECT_LT((target(36) - Eigen::Vector3d(kHalfWidth + offset, kHeight, 0.0)).norm(), 1e-4);
  EXPECT_LT((target(0) - Eigen::Vector3d(-kHalfWidth - offset, kHeight, 0.0)).norm(), 1e-4);
  const double step = (Perimeter() + 2.0 * M_PI * offset) / 72.0;
  for (int column = 0; column < 36; ++column) {
    EXPECT_NEAR((target(column + 1) - target(column)).norm(), step, 0.005 * step) << column;
  }
  EXPECT_EQ(belt.attachments.size(), 2U * 37U);
}

TEST(Belt, RefusesToHoldWhereThereIsNoBody) {
  const ClothMesh skirt = testing::MakeTubeSkirt(0.36, 0.5, 0.6, 18, 30);
  EXPECT_EQ(LayBelt(FindBottomOutline(skirt).value(), {}, kHeight, 0.0, 0.004).status().reason(), "BELT_HAS_NO_BODY");
}

}  // namespace
}  // namespace fitroom
