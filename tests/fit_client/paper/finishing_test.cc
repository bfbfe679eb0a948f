#include "fit_client/fit/paper/finishing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"

namespace fitroom::paper {
namespace {

TEST(TopIsDone, S27_ExactlyWhenEveryPointIsNearerThanEpsilon) {
  const double epsilon = 0.02;
  EXPECT_TRUE(TopIsDone(std::vector<double>{0.019, 0.0, 0.001}, epsilon));
  EXPECT_FALSE(TopIsDone(std::vector<double>{0.019, 0.02, 0.001}, epsilon));  // Less than, not at most.
  EXPECT_TRUE(TopIsDone(std::vector<double>{0.019, std::nextafter(0.02, 0.0)}, epsilon));
  EXPECT_FALSE(TopIsDone(std::vector<double>{-0.5, 0.021}, epsilon));  // One point is enough to go on.
  EXPECT_TRUE(TopIsDone(std::vector<double>{-0.5}, epsilon));          // Signed: inside is there.
  EXPECT_TRUE(TopIsDone({}, epsilon));
}

TEST(TopIsDone, S27_TheFootOfTheNormalIsTheNearestPlace) {
  const TriangleMesh box =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-1.0, -1.0, -1.0), Eigen::Vector3d(1.0, 1.0, 1.0)), 3);
  const struct {
    Eigen::Vector3d point, foot;
    double distance;
  } kTable[] = {
      {{0.2, 1.5, 0.1}, {0.2, 1.0, 0.1}, 0.5},             // Over a face.
      {{0.2, 0.9, 0.1}, {0.2, 1.0, 0.1}, -0.1},            // Under it.
      {{1.3, 1.4, 0.1}, {1.0, 1.0, 0.1}, 0.5},             // Beside an edge.
      {{2.0, 3.0, 3.0}, {1.0, 1.0, 1.0}, 3.0},             // Beyond a corner.
      {{0.2, 1.0 + 1e-12, 0.1}, {0.2, 1.0, 0.1}, 1e-12},   // On the face, from outside
      {{0.2, 1.0 - 1e-12, 0.1}, {0.2, 1.0, 0.1}, -1e-12},  // and inside.
  };
  for (const auto& row : kTable) {
    const FootOfNormal foot = FindFootOfNormal(box, row.point);
    EXPECT_LT((foot.foot - row.foot).norm(), 1e-9) << row.point.transpose();
    EXPECT_NEAR(foot.signed_distance, row.distance, 1e-15 + 1e-9 * std::abs(row.distance)) << row.point.transpose();
  }
}

// Taken to the letter (6) depends on where the floor is; read as the foot of the normal it does not.
TEST(TopIsDone, S27_ToTheLetterItDependsOnTheOrigin) {
  TriangleMesh sphere = testing::MakeSphere({0.0, 0.0, 0.0}, 0.1, 3);
  const Eigen::Vector3d on_top(0.0, 0.105, 0.0);
  const Eigen::Vector3d raised(0.0, 1.4, 0.0);
  const double distance = FindFootOfNormal(sphere, on_top).signed_distance;
  for (Eigen::Vector3d& vertex : sphere.vertices) vertex += raised;
  EXPECT_NEAR(FindFootOfNormal(sphere, on_top + raised).signed_distance, distance, 1e-12);
  EXPECT_NEAR(distance, 0.005, 1e-3);
  EXPECT_NEAR(DistanceToTheLetter(Eigen::Vector3d::UnitY(), on_top), 0.895, 1e-12);
  EXPECT_NEAR(DistanceToTheLetter(Eigen::Vector3d::UnitY(), on_top + raised), 0.505, 1e-12);
}

TEST(BottomIsDone, S32_ExactlyWhenTheOutseamsAreBackAtTheirLengths) {
  EXPECT_TRUE(BottomIsDone({1.0, 1.0}, {1.002, 0.998}, 0.005));
  EXPECT_FALSE(BottomIsDone({1.0, 1.0}, {1.003, 0.997}, 0.005));  // Longer and shorter do not cancel.
  EXPECT_FALSE(BottomIsDone({1.0, 1.0}, {1.25, 1.0}, 0.25));      // Less than, not at most.
  EXPECT_TRUE(BottomIsDone({1.0, 1.0}, {1.25, 1.0}, std::nextafter(0.25, 1.0)));
  EXPECT_TRUE(BottomIsDone({1.0, 0.9}, {1.0, 0.9}, 1e-12));
  EXPECT_FALSE(BottomIsDone({1.0, 0.9}, {0.9, 1.0}, 0.005));  // Each against its own.
  EXPECT_DOUBLE_EQ(ChainLength(std::vector<Eigen::Vector3d>{{0, 0, 0}, {3, 4, 0}, {3, 4, 2}}), 7.0);
}

// Under its own weight a hanging seam of n springs is longer by the sum of what each carries: (11) may never hold.
TEST(BottomIsDone, S32_NeedNotHoldUnderTheGarmentsOwnWeight) {
  const int n = 100;
  const double weight_a_particle = 0.001 * 9.81;
  const double stiffness = 60.0;
  double length = 0.0;
  for (int i = 0; i < n; ++i) length += 0.01 + (n - i) * weight_a_particle / stiffness;
  EXPECT_FALSE(BottomIsDone({1.0, 1.0}, {length, length}, 0.005));
}

TEST(Rest, S33_CountsWhoIsSlowerThanThirtyHundredthsOfAMillimetreASixtieth) {
  const RestOptions rest;
  EXPECT_DOUBLE_EQ(rest.speed, 0.0003 * 60.0);
  EXPECT_DOUBLE_EQ(rest.share, 0.985);
  std::vector<Eigen::Vector3d> before(200, Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3d> after = before;
  for (int moving = 0; moving < 4; ++moving) {
    const std::vector<double> speeds = MeanSpeeds(before, after, 1.0 / 60.0);
    EXPECT_DOUBLE_EQ(ShareAtRest(speeds, rest.speed), 1.0 - moving / 200.0);
    after[static_cast<size_t>(moving)].x() = 0.00031;
  }
  EXPECT_DOUBLE_EQ(ShareAtRest(MeanSpeeds(before, after, 1.0 / 60.0), rest.speed), 0.98);  // Four of 200: not at rest.
  EXPECT_NEAR(MeanSpeeds(before, after, 1.0 / 60.0)[0], 0.0186, 1e-12);
}

}  // namespace
}  // namespace fitroom::paper
