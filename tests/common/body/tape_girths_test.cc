#include "common/body/tape_girths.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/body/analyse_scan.h"
#include "tests/common/body/population.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSides = 120;

// Adds an upright tube without ends.
void AddTube(TriangleMesh& mesh, const Eigen::Vector2d& centre, double radius, double low, double high) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const double y : {low, high}) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * kPi * k / kSides;
      mesh.vertices.emplace_back(centre.x() + radius * std::sin(angle), y, centre.y() + radius * std::cos(angle));
    }
  }
  for (int k = 0; k < kSides; ++k) {
    const int next = (k + 1) % kSides;
    mesh.triangles.emplace_back(first + k, first + next, first + kSides + next);
    mesh.triangles.emplace_back(first + k, first + kSides + next, first + kSides + k);
  }
}

double TubeGirth(double radius) { return 2.0 * kSides * radius * std::sin(kPi / kSides); }

// Two legs, a trunk, and an arm that hangs beside it.
Body MakeTubeBody() {
  Body body;
  AddTube(body.mesh, {0.1, 0.0}, 0.08, 0.0, 0.8);
  AddTube(body.mesh, {-0.1, 0.0}, 0.08, 0.0, 0.8);
  AddTube(body.mesh, {0.0, 0.0}, 0.18, 0.8, 1.4);
  AddTube(body.mesh, {0.3, 0.0}, 0.045, 0.6, 1.35);
  const auto place = [&body](BodyLandmark landmark, const Eigen::Vector3d& position) {
    body.landmarks[landmark] = {position, 1.0};
  };
  place(BodyLandmark::kCrotch, {0.0, 0.8, 0.0});
  place(BodyLandmark::kKneeLeft, {0.1, 0.45, 0.08});
  place(BodyLandmark::kKneeRight, {-0.1, 0.45, 0.08});
  place(BodyLandmark::kArmpitLeft, {0.2, 1.25, 0.0});
  place(BodyLandmark::kAcromionLeft, {0.18, 1.38, 0.0});
  place(BodyLandmark::kAcromionRight, {-0.18, 1.38, 0.0});
  body.leg_left = {{0.1, 0.85, 0.0}, {0.1, 0.45, 0.0}, {0.1, 0.08, 0.0}};
  body.leg_right = {{-0.1, 0.85, 0.0}, {-0.1, 0.45, 0.0}, {-0.1, 0.08, 0.0}};
  body.arm_left = {{0.3, 1.33, 0.0}, {0.3, 1.0, 0.0}, {0.3, 0.75, 0.0}};
  return body;
}

TEST(TapeGirths, OfTubesAreTheirCircumferences) {
  const Body body = MakeTubeBody();
  const TapeGirths tape(body);
  ASSERT_TRUE(tape.Thigh());
  EXPECT_NEAR(tape.Thigh()->girth, TubeGirth(0.08), 1e-6);
  EXPECT_LT(tape.Thigh()->height, 0.8);
  ASSERT_TRUE(tape.Knee());
  EXPECT_NEAR(tape.Knee()->girth, TubeGirth(0.08), 1e-6);
  EXPECT_NEAR(tape.Knee()->height, 0.45, 1e-12);
  ASSERT_TRUE(tape.TrunkAt(1.1));
  EXPECT_NEAR(*tape.TrunkAt(1.1), TubeGirth(0.18), 1e-6);  // The arm is left out.
  // Round both legs together: two half circles and two straight lines.
  ASSERT_TRUE(tape.TrunkAt(0.5));
  EXPECT_NEAR(*tape.TrunkAt(0.5), TubeGirth(0.08) + 0.4, 1e-3);
  ASSERT_TRUE(tape.UpperArm(0.05));
  EXPECT_NEAR(tape.UpperArm(0.05)->girth, TubeGirth(0.045), 1e-6);
  EXPECT_NEAR(tape.UpperArm(0.05)->height, 1.20, 1e-9);
  EXPECT_NEAR(*tape.ShoulderBreadth(), 0.36, 1e-12);
}

TEST(TapeGirths, AreAbsentWhereTheScanLacksWhatTheyNeed) {
  const Body nothing;
  const TapeGirths tape(nothing);
  EXPECT_FALSE(tape.Thigh());
  EXPECT_FALSE(tape.Knee());
  EXPECT_FALSE(tape.UpperArm(0.05));
  EXPECT_FALSE(tape.ShoulderBreadth());
  EXPECT_FALSE(tape.TrunkAt(1.0));
  EXPECT_FALSE(tape.LegAt(0.5));
}

// Small girths: 4 mm (ISO 20685-1). The truth's thigh lies just below the crotch, where a centimetre of height is worth
// three millimetres of girth.
TEST(TapeGirths, OfTheTestBodiesAreTheirTruth) {
  FR_REQUIRE_TEST_DATA();
  const auto truth = testing::ReadPopulationTruth();
  for (const std::string id : {"p001", "p002", "p040"}) {
    const auto analysis = AnalyseScan(testing::ReadBody("population/" + id + ".ply"), {});
    ASSERT_TRUE(analysis.ok()) << analysis.status().ToString();
    const TapeGirths tape(analysis->body);
    ASSERT_TRUE(tape.Thigh()) << id;
    EXPECT_NEAR(tape.Thigh()->girth, 0.01 * truth.at(id).measurements.at("thigh_L_tape_cm"), 0.010) << id;
    const GirthMeasurement& hip = analysis->body.measurements.hip;
    ASSERT_TRUE(tape.TrunkAt(hip.height)) << id;
    EXPECT_NEAR(*tape.TrunkAt(hip.height), hip.girth, 0.004) << id;
  }
}

}  // namespace
}  // namespace fitroom
