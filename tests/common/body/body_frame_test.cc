#include "common/body/body_frame.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/body/analyse_scan.h"
#include "tests/common/body/population.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

// The 24 turns that map the axes onto each other, mirror images left out.
std::vector<Eigen::Matrix3d> AxisTurns() {
  std::vector<Eigen::Matrix3d> turns;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x / 2 == y / 2) continue;
      Eigen::Matrix3d turn;
      turn.col(0) = (x % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(x / 2);
      turn.col(1) = (y % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(y / 2);
      turn.col(2) = turn.col(0).cross(turn.col(1));
      turns.push_back(turn);
    }
  }
  return turns;
}

TriangleMesh Transformed(TriangleMesh mesh, const Similarity& transform) {
  for (Eigen::Vector3d& p : mesh.vertices) p = transform * p;
  return mesh;
}

std::string AxisOf(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return AxisName({static_cast<int>(axis), direction[axis] < 0.0 ? -1 : 1});
}

// Both results describe one body: landmarks within `tolerance` metres, girths within a tenth of it more than that.
void ExpectSameBody(const BodyAnalysis& a, const BodyAnalysis& b, double tolerance) {
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    EXPECT_LT((a.body.landmarks[landmark].position - b.body.landmarks[landmark].position).norm(), tolerance)
        << LandmarkName(landmark);
  }
  EXPECT_NEAR(a.body.measurements.bust.girth, b.body.measurements.bust.girth, tolerance);
  EXPECT_NEAR(a.body.measurements.waist.girth, b.body.measurements.waist.girth, tolerance);
  EXPECT_NEAR(a.body.measurements.hip.girth, b.body.measurements.hip.girth, tolerance);
}

TEST(Axis, IsReadAndWritten) {
  for (const char* name : {"+x", "-x", "+y", "-y", "+z", "-z"}) {
    const Result<SignedAxis> axis = ParseAxis(name);
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(AxisName(*axis), name);
  }
  EXPECT_EQ(AxisName(*ParseAxis("Z")), "+z");
  for (const char* name : {"", "+", "w", "xy", "--x", "x-"}) {
    EXPECT_EQ(ParseAxis(name).status().reason(), "BAD_AXIS") << name;
  }
}

TEST(Unit, IsRead) {
  EXPECT_EQ(ParseUnit("inch")->metres, 0.0254);
  EXPECT_EQ(ParseUnit("cm")->metres, 0.01);
  EXPECT_EQ(ParseUnit("furlong").status().reason(), "BAD_UNIT");
}

TEST(Similarity, IsUndoneByItsInverse) {
  Similarity transform;
  transform.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  transform.scale = 0.01;
  transform.translation = Eigen::Vector3d(4, -5, 6);
  const Eigen::Vector3d p(7, 8, -9);
  EXPECT_NEAR((transform.Inverse() * (transform * p) - p).norm(), 0.0, 1e-9);
  EXPECT_NEAR((transform * (transform.Inverse() * p) - p).norm(), 0.0, 1e-9);
}

TEST(Frame, IsFoundInAll24AxisOrientations) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p001.ply");
  const Result<BodyAnalysis> straight = AnalyseScan(body, {});
  ASSERT_TRUE(straight.ok()) << straight.status().ToString();
  EXPECT_EQ(straight->frame.up, "+y");
  EXPECT_EQ(straight->frame.facing, "+z");
  EXPECT_EQ(straight->frame.unit, "cm");
  const std::vector<Eigen::Matrix3d> turns = AxisTurns();
  ASSERT_EQ(turns.size(), 24u);
  for (const Eigen::Matrix3d& turn : turns) {
    Similarity transform;
    transform.rotation = turn;
    transform.translation = Eigen::Vector3d(300.0, -20.0, 77.0);
    const Result<BodyAnalysis> turned = AnalyseScan(Transformed(body, transform), {});
    ASSERT_TRUE(turned.ok()) << turned.status().ToString();
    EXPECT_EQ(turned->frame.up, AxisOf(turn * Eigen::Vector3d::UnitY()));
    EXPECT_EQ(turned->frame.facing, AxisOf(turn * Eigen::Vector3d::UnitZ()));
    EXPECT_EQ(turned->frame.unit, "cm");
    EXPECT_GE(turned->frame.reasons.size(), 3u);
    ExpectSameBody(*straight, *turned, 5e-4);
  }
}

TEST(Frame, UnitIsFoundFromTheStature) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p002.ply");
  const Result<BodyAnalysis> in_cm = AnalyseScan(body, {});
  ASSERT_TRUE(in_cm.ok()) << in_cm.status().ToString();
  struct Case {
    double per_cm;
    const char* unit;
  };
  for (const Case& c : {Case{0.01, "m"}, Case{10.0, "mm"}, Case{1.0 / 2.54, "in"}, Case{0.1, "dm"}}) {
    Similarity transform;
    transform.scale = c.per_cm;
    const Result<BodyAnalysis> scaled = AnalyseScan(Transformed(body, transform), {});
    ASSERT_TRUE(scaled.ok()) << scaled.status().ToString();
    EXPECT_EQ(scaled->frame.unit, c.unit);
    ExpectSameBody(*in_cm, *scaled, 5e-4);
  }
}

TEST(Frame, FileCoordinatesComeBackThroughTheInverse) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p001.ply");
  const Result<BodyAnalysis> analysis = AnalyseScan(body, {});
  ASSERT_TRUE(analysis.ok());
  const Eigen::AlignedBox3d bounds = ComputeBounds(analysis->body.mesh);
  EXPECT_NEAR(bounds.min().y(), 0.0, 1e-9);
  EXPECT_NEAR(bounds.max().y(), analysis->body.measurements.stature, 1e-9);
  const Similarity file_from_canonical = analysis->canonical_from_file.Inverse();
  // Every vertex of the closed body was kept, in order.
  ASSERT_EQ(analysis->body.mesh.vertices.size(), body.vertices.size());
  for (size_t i = 0; i < body.vertices.size(); i += 97) {
    EXPECT_LT((file_from_canonical * analysis->body.mesh.vertices[i] - body.vertices[i]).norm(), 1e-9);
  }
}

TEST(Frame, BodyTurnedOrTiltedFarFromTheAxesIsFoundToo) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p001.ply");
  const Result<BodyAnalysis> straight = AnalyseScan(body, {});
  ASSERT_TRUE(straight.ok());
  const double degree = std::numbers::pi / 180.0;
  Similarity turned;
  turned.rotation = Eigen::AngleAxisd(40.0 * degree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Result<BodyAnalysis> about_up = AnalyseScan(Transformed(body, turned), {});
  ASSERT_TRUE(about_up.ok()) << about_up.status().ToString();
  EXPECT_EQ(about_up->frame.up, "+y");
  EXPECT_NEAR(about_up->frame.yaw_deg, 40.0, 3.0);
  EXPECT_NEAR(about_up->body.measurements.waist.girth, straight->body.measurements.waist.girth, 1e-3);
  turned.rotation = Eigen::AngleAxisd(40.0 * degree, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Result<BodyAnalysis> oblique = AnalyseScan(Transformed(body, turned), {});
  ASSERT_TRUE(oblique.ok()) << oblique.status().ToString();
  EXPECT_NEAR(oblique->frame.tilt_deg, 40.0, 6.0);
  EXPECT_NEAR(oblique->body.measurements.waist.girth, straight->body.measurements.waist.girth, 0.02);
}

TEST(Frame, OverridesAreTakenAndTold) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p001.ply");
  FrameOverrides overrides;
  overrides.facing = *ParseAxis("-z");
  const Result<BodyAnalysis> turned = AnalyseScan(body, overrides);
  ASSERT_TRUE(turned.ok()) << turned.status().ToString();
  EXPECT_EQ(turned->frame.facing, "-z");
  EXPECT_THAT(turned->frame.reasons, ::testing::Contains(::testing::HasSubstr("given by the operator")));
  // What was the body's left is now called its right.
  EXPECT_LT(turned->canonical_from_file.rotation.row(0).dot(Eigen::Vector3d::UnitX()), -0.99);
}

TEST(Frame, OverridesThatCannotBeAreRefused) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh body = testing::ReadBody("population/p001.ply");
  FrameOverrides parallel;
  parallel.facing = *ParseAxis("-y");
  EXPECT_EQ(AnalyseScan(body, parallel).status().reason(), "AXES_NOT_PERPENDICULAR");
  FrameOverrides inches;
  inches.unit = *ParseUnit("in");
  EXPECT_EQ(AnalyseScan(body, inches).status().reason(), "STATURE_OUT_OF_RANGE");
  FrameOverrides upside_down;
  upside_down.up = *ParseAxis("-y");
  EXPECT_EQ(AnalyseScan(body, upside_down).status().reason(), "NOT_A_BODY");
}

}  // namespace
}  // namespace fitroom
