#include <gtest/gtest.h>

#include "fit_client/fit/paper/paper_drape.h"
#include "tests/fit_client/paper/common_case.h"

namespace fitroom::paper {
namespace {

// A tenth of the method's rest speed: without friction a sheet creeps on while it counts as being at rest (unit: m/s).
constexpr double kStrictRest = 0.0018;

// What both profiles are asked for: no friction to speak of, no offset, no bending, the same fabric.
DrapeOptions StandardWithoutExtras() {
  DrapeOptions options;
  options.material.stretch_stiffness = 200.0;
  options.material.bending_stiffness = 1e-9;
  options.friction_coefficient = 0.0;
  options.stitching_friction_coefficient = 0.0;
  options.contact_offset = 0.0005;
  options.sample_clearance = 0.0;
  options.rest_speed = kStrictRest;
  options.rest_speed_of_99_percent = kStrictRest;
  return options;
}

PaperOptions PaperInCommon() {
  PaperOptions options = CorrectedPaperOptions();
  options.material.stretch_stiffness = 200.0;
  options.motion.friction = FrictionLaw::kPrinted;
  options.motion.stitching.law = StitchingLaw::kPrinted;
  options.collision.contact_offset = 0.0;
  options.rest.speed = kStrictRest;
  return options;
}

// The two profiles end in the same place: RMS distance of the particles within 5 mm.
TEST(CommonCase, BothProfilesEndWithinFiveMillimetres) {
  const TriangleMesh body = testing::CommonCone();
  const ClothMesh mesh = testing::CommonSkirt(/*refinement=*/1.5);
  ThreadPool pool(2);
  const Result<SignedDistanceField> field = SignedDistanceField::Build(body, {}, pool);
  ASSERT_TRUE(field.ok());
  const Result<DrapeResult> standard = Drape(mesh, mesh.rest_positions, *field, StandardWithoutExtras(), pool, {});
  const Result<PaperResult> printed = PaperDrape(mesh, mesh.rest_positions, body, PaperInCommon(), pool, {});
  ASSERT_TRUE(standard.ok() && printed.ok());
  EXPECT_EQ(standard->report.outcome, DrapeOutcome::kAtRest) << standard->report.finishing_reason;
  EXPECT_EQ(printed->report.outcome, DrapeOutcome::kAtRest) << printed->report.finishing_reason;
  EXPECT_TRUE(printed->paper.condition_met);
  EXPECT_LT(testing::RmsDistance(standard->positions, printed->positions), 0.005);
  // They did move: the panels started 17 cm in front of the axis and behind it.
  EXPECT_GT(testing::RmsDistance(mesh.rest_positions, printed->positions), 0.05);
}

// As printed but for the sign of the springs and a drag of the air: unit masses, one stiffness, registration by
// centroid.
TEST(CommonCase, NearlyAsPrintedEndsThereToo) {
  const TriangleMesh body = testing::CommonCone();
  const ClothMesh mesh = testing::CommonSkirt(/*refinement=*/1.5);
  ThreadPool pool(2);
  const SignedDistanceField field = SignedDistanceField::Build(body, {}, pool).value();
  const Result<DrapeResult> standard = Drape(mesh, mesh.rest_positions, field, StandardWithoutExtras(), pool, {});
  PaperOptions options = RunnablePaperOptions();
  options.material.stretch_stiffness = 200.0;
  options.rest.speed = kStrictRest;
  const Result<PaperResult> printed = PaperDrape(mesh, mesh.rest_positions, body, options, pool, {});
  ASSERT_TRUE(standard.ok() && printed.ok());
  EXPECT_EQ(printed->report.outcome, DrapeOutcome::kAtRest) << printed->report.finishing_reason;
  EXPECT_LT(testing::RmsDistance(standard->positions, printed->positions), 0.005);
}

}  // namespace
}  // namespace fitroom::paper
