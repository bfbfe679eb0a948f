#include "fit_client/fit/stages/dressing_guides.h"

#include <cmath>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

TEST(Polyline, IsWalkedByArcLength) {
  const Polyline line({{0.0, 0.0}, {3.0, 4.0}, {3.0, 10.0}});
  EXPECT_DOUBLE_EQ(line.length(), 11.0);
  EXPECT_TRUE(line.At(2.5).isApprox(Eigen::Vector2d(1.5, 2.0)));
  EXPECT_TRUE(line.At(8.0).isApprox(Eigen::Vector2d(3.0, 7.0)));
}

TEST(Polyline, GoesOnStraightBeyondItsEnd) {
  const Polyline line({{0.0, 0.0}, {1.0, 0.0}, {1.0, -1.0}});
  EXPECT_TRUE(line.At(3.0).isApprox(Eigen::Vector2d(1.0, -2.0)));
}

TEST(Polyline, DistanceAtAbscissaInvertsAt) {
  const Polyline line({{0.0, 0.0}, {3.0, 4.0}, {6.0, 0.0}});
  for (const double s : {0.5, 2.0, 6.5, 9.0}) EXPECT_NEAR(line.DistanceAtAbscissa(line.At(s).x()), s, 1e-12);
}

// A doll of boxes: torso, and arms that hang straight down beside it with a gap.
void AddBox(TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                               (i & 4) != 0 ? high.z() : low.z());
  }
  for (const auto& face : {Eigen::Vector4i(4, 5, 7, 6), Eigen::Vector4i(1, 0, 2, 3), Eigen::Vector4i(5, 1, 3, 7),
                           Eigen::Vector4i(0, 4, 6, 2), Eigen::Vector4i(6, 7, 3, 2), Eigen::Vector4i(0, 1, 5, 4)}) {
    mesh.triangles.emplace_back(first + face[0], first + face[1], first + face[2]);
    mesh.triangles.emplace_back(first + face[0], first + face[2], first + face[3]);
  }
}

Body MakeDoll(double gap = 0.04) {
  Body body;
  AddBox(body.mesh, {-0.15, 0.0, -0.1}, {0.15, 1.40, 0.1});          // Torso, up to the shoulder.
  AddBox(body.mesh, {-0.05, 1.40, -0.05}, {0.05, 1.60, 0.05});       // Neck.
  AddBox(body.mesh, {-0.15, 1.30, -0.04}, {0.25, 1.40, 0.04});       // Left shoulder.
  AddBox(body.mesh, {0.15 + gap, 0.80, -0.04}, {0.27, 1.40, 0.04});  // Left arm.
  const auto set = [&body](BodyLandmark landmark, double x, double y) {
    body.landmarks[landmark] = {{x, y, 0.0}, 1.0};
  };
  set(BodyLandmark::kFrontNeck, 0.0, 1.40);
  set(BodyLandmark::kSideNeckLeft, 0.06, 1.40);
  set(BodyLandmark::kAcromionLeft, 0.23, 1.40);
  set(BodyLandmark::kArmpitLeft, 0.17, 1.30);
  body.arm_left = {{0.23, 1.36, 0.0}, {0.23, 1.10, 0.0}, {0.23, 0.85, 0.0}};
  return body;
}

TEST(DressingGuides, FindTheGapBetweenTorsoAndArm) {
  const Body doll = MakeDoll();
  const auto guides = FindDressingGuides(doll, FrontalMap(doll.mesh, 0.004), +1, 0.01);
  ASSERT_TRUE(guides.ok()) << guides.status().ToString();
  const DressingGuides::Level& level = guides->LevelAt(1.1);
  EXPECT_NEAR(level.torso_end, 0.15, 0.005);
  EXPECT_NEAR(level.arm_begin, 0.19, 0.005);
  EXPECT_NEAR(level.half_depth, 0.1, 0.005);
  EXPECT_TRUE(std::isinf(guides->LevelAt(0.5).arm_begin));
}

TEST(DressingGuides, TheShoulderLineRunsOverTheShoulderAndDownTheArmOneClearanceAway) {
  const Body doll = MakeDoll();
  const auto guides = FindDressingGuides(doll, FrontalMap(doll.mesh, 0.004), +1, 0.01);
  ASSERT_TRUE(guides.ok());
  EXPECT_NEAR(guides->shoulder_line.At(0.05).y(), 1.41, 0.006);
  EXPECT_NEAR(guides->shoulder_line.At(0.50).x(), 0.28, 0.006);
  EXPECT_LT(guides->shoulder_line.At(0.50).y(), 1.20);
}

TEST(DressingGuides, ArmsAlongTheBodyAreRefusedWithARemedy) {
  const Body doll = MakeDoll(-0.01);
  const Status status = FindDressingGuides(doll, FrontalMap(doll.mesh, 0.004), +1, 0.01).status();
  EXPECT_EQ(status.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(status.reason(), "ARMS_ALONG_BODY");
  EXPECT_NE(status.message().find("left arm"), std::string::npos);
  EXPECT_NE(status.message().find("scan again with both arms"), std::string::npos);
}

TEST(DressingGuides, AMissingLandmarkIsNamed) {
  Body doll = MakeDoll();
  doll.landmarks[BodyLandmark::kArmpitLeft].confidence = 0.0;
  const Status status = FindDressingGuides(doll, FrontalMap(doll.mesh, 0.004), +1, 0.01).status();
  EXPECT_EQ(status.reason(), "LANDMARK_MISSING");
  EXPECT_NE(status.message().find("armpit_L"), std::string::npos);
}

}  // namespace
}  // namespace fitroom
