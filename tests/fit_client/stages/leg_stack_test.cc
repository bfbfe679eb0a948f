#include "fit_client/fit/stages/leg_stack.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

TEST(LegStack, ALegThatIsNotTooLongHangsStraight) {
  const LegStack stack = StackLeg(0.75, 0.65, 0.06);
  EXPECT_EQ(stack.share, 1.0);
  EXPECT_NEAR(HeightDownLeg(stack, 0.75, 0.65), 0.10, 1e-12);
  EXPECT_EQ(LegFold(stack, 0.1, {0.08, 0.0}).norm(), 0.0);
}

TEST(LegStack, ALegThatIsTooLongIsStraightAboveTheCalfAndEndsAboveTheFoot) {
  const double start = 0.70;
  const double length = 0.80;
  const LegStack stack = StackLeg(start, length, 0.06);
  EXPECT_LT(stack.share, 1.0);
  EXPECT_NEAR(HeightDownLeg(stack, start, length), 0.06, 1e-12);
  EXPECT_LT(stack.top, 0.40) << "folds stay below the knee";
  for (double way = 0.0; way < start - stack.top; way += 0.05) {
    EXPECT_NEAR(HeightDownLeg(stack, start, way), start - way, 1e-12);
  }
  // Cloth and height are the same leg, and what is folded is folded evenly.
  EXPECT_NEAR(start - stack.top + (stack.top - 0.06) / stack.share, length, 1e-12);
}

// The folds give the cloth its length back: measured along a wave where it is deepest, against 1 / share.
TEST(LegStack, AFoldIsAsLongAsTheClothThatIsInIt) {
  const LegStack stack = StackLeg(0.70, 0.74, 0.06);
  const double height = stack.top - 0.06;
  const int steps = 20000;
  double length = 0.0;
  double before = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const double offset = LegFold(stack, stack.top - height * k / steps, {0.0, 0.1}).y();
    length += std::hypot(height / steps, offset - before);
    before = offset;
  }
  EXPECT_NEAR(length / height, 1.0 / stack.share, 0.06 / stack.share);
}

TEST(LegStack, FoldsLeaveTheLegsGirthAsItIs) {
  const LegStack stack = StackLeg(0.70, 0.80, 0.06);
  double mean = 0.0;
  const int steps = 360;
  for (int k = 0; k < steps; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / steps;
    const Eigen::Vector2d outward(std::cos(turn), std::sin(turn));
    mean += LegFold(stack, stack.top - 0.014, 0.09 * outward).dot(outward) / steps;
  }
  EXPECT_NEAR(mean, 0.0, 1e-9);
  EXPECT_GT(LegFold(stack, stack.top - 0.014, {0.09, 0.0}).norm(), 0.005) << "and are there";
}

TEST(LegStack, AnAbsurdlyLongLegIsLeftAThirdOfItsLength) {
  const LegStack stack = StackLeg(0.70, 3.0, 0.06);
  EXPECT_NEAR(stack.share, 0.3, 1e-12);
  EXPECT_TRUE(std::isfinite(HeightDownLeg(stack, 0.70, 3.0)));
}

}  // namespace
}  // namespace fitroom
