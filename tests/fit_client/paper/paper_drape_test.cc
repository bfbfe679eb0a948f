#include "fit_client/fit/paper/paper_drape.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/paper/common_case.h"

namespace fitroom::paper {
namespace {

// A small skirt on an elliptic cone, standing in for a top: 2 x 8 x 5 squares.
struct SmallTop {
  TriangleMesh body = testing::MakeEllipticCone(0.05, 0.17, 0.8, -0.2, 0.2, 72, 30);
  ClothMesh mesh = testing::MakeConeSkirt(0.05, 0.17, 0.8, -0.2, 0.2, -0.05, 0.1, 1.02, 0.14, 8, 5);
  PaperOptions options;
  SerialExecutor serial;

  SmallTop() {
    options.material.stretch_stiffness = 200.0;
    options.motion.spring = SpringLaw::kSigned;
    options.motion.air_drag = 12.0;
    options.shoulder_vertices = {45, 49, 53};  // Of the front's top edge.
  }
};

// A ring below a body that widens upwards: pulled up, its top edge meets the body.
struct SmallBottom {
  TriangleMesh body = testing::MakeEllipticCone(0.12, 0.04, 0.8, -0.4, 0.3, 72, 60);
  ClothMesh mesh = testing::MakeConeSkirt(0.0917, 0.0917, 0.8, -1.0, 1.0, -0.35, -0.2, 1.0, 0.12, 8, 5);
  PaperOptions options;
  SerialExecutor serial;

  SmallBottom() {
    options.material.stretch_stiffness = 200.0;
    options.motion.spring = SpringLaw::kSigned;
    options.motion.air_drag = 12.0;
    options.motion.stitching.law = StitchingLaw::kSeamsOnly;  // All pairs would draw it flat onto the thin end.
    options.collision.registration = Registration::kOverlap;
    options.collision.swept = true;
    PaperBottom bottom;
    bottom.crotch = {49};  // Middle of the front's top edge.
    bottom.groin = {0.0, 5.0, 0.0};
    // From the centre front over the left (+x), round the back (54 vertices on), and over the right.
    bottom.top_edge = {49, 50, 51, 52, 53, 107, 106, 105, 104, 103, 102, 101, 100, 99, 45, 46, 47, 48};
    bottom.outseams = {std::vector<int>{53, 44, 35, 26, 17, 8}, std::vector<int>{45, 36, 27, 18, 9, 0}};
    options.bottom = bottom;
  }
};

std::set<PaperForce> Acting(const ForceAudit& audit, PaperStage stage) {
  std::set<PaperForce> forces;
  for (int force = 0; force < kPaperForceCount; ++force) {
    if (audit.At(stage, static_cast<PaperForce>(force)) > 0) forces.insert(static_cast<PaperForce>(force));
  }
  return forces;
}

const std::set<PaperForce> kBeforeStitching = {PaperForce::kSpring, PaperForce::kStitching, PaperForce::kFriction};
const std::set<PaperForce> kUpwards = {PaperForce::kSpring, PaperForce::kFriction, PaperForce::kAntigravity};
const std::set<PaperForce> kDownwards = {PaperForce::kSpring, PaperForce::kFriction, PaperForce::kGravity};

// The audit of (3), (5), (9) and (10): every force is there to act (a stretched spring, an open stitch, a particle that
// glides on the body), and only those of the stage do.
TEST(StageForces, S24_S31_ExactlyTheForcesOfTheEquationAct) {
  const TriangleMesh body =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.2, -0.1, -0.2), Eigen::Vector3d(0.2, 0.0, 0.2)), 40);
  const BodyCollider box = BodyCollider::Build(body, 0.05, {Registration::kOverlap, false, 0.0}).value();
  const std::vector<std::pair<PaperStage, std::set<PaperForce>>> table = {
      {PaperStage::kStart, {}},   {PaperStage::kMerging, kBeforeStitching}, {PaperStage::kStitched, {}},
      {PaperStage::kBelted, {}},  {PaperStage::kPullingUp, kUpwards},       {PaperStage::kDraping, kDownwards},
      {PaperStage::kFinished, {}}};
  for (const auto& [stage, expected] : table) {
    PaperCloth pair;
    pair.positions = {{0.0, -1e-5, 0.0}, {0.02, -1e-5, 0.0}};
    pair.velocities = {{0.1, 0.1, 0.1}, {0.2, 0.1, 0.1}};
    pair.masses = {1.0, 1.0};
    pair.pinned = {0, 0};
    pair.particle_of_vertex = {0, 1};
    pair.springs = {{0, 1, 0.015, {10.0, 0.1}}};
    PaperMotion motion(pair, box, {}, 1e-5);
    motion.SetStitches({{0, 1}});
    motion.Step(stage);  // Finds the collision,
    motion.Step(stage);  // brakes what collides.
    EXPECT_EQ(Acting(motion.audit(), stage), expected) << PaperStageName(stage);
    for (int other = 0; other < kPaperStageCount; ++other) {
      if (static_cast<PaperStage>(other) != stage) {
        EXPECT_TRUE(Acting(motion.audit(), static_cast<PaperStage>(other)).empty());
      }
    }
  }
}

// Equation (5) with unit masses: a weight hangs from a pinned particle by m g / k.
TEST(PaperMotion, S24_AWeightHangsByItsWeightOverStiffness) {
  const BodyCollider far = BodyCollider::Build(testing::MakeSphere({0.0, -9.0, 0.0}, 0.05, 1), 0.05, {}).value();
  PaperCloth pair;
  pair.positions = {Eigen::Vector3d::Zero(), {0.0, -0.1, 0.0}};
  pair.velocities.assign(2, Eigen::Vector3d::Zero());
  pair.masses = {1.0, 1.0};
  pair.pinned = {1, 0};
  pair.particle_of_vertex = {0, 1};
  pair.springs = {{0, 1, 0.1, {500.0, 0.0}}};
  const double frequency = HighestFrequency(pair);
  SetDamping(pair, 1.0 / frequency);
  PaperMotion motion(pair, far, {}, 1.0 / frequency);
  for (int step = 0; step < 2000; ++step) motion.Step(PaperStage::kDraping);
  EXPECT_NEAR(motion.cloth().positions[1].y(), -0.1 - 9.81 / 500.0, 1e-9);
  EXPECT_EQ(motion.cloth().positions[0], Eigen::Vector3d::Zero().eval());
}

// With unit masses stiffness is scaled alike: weight over stiffness is that of the fabric.
TEST(PaperCloth, S24_UnitMassesKeepTheWeightOverTheStiffness) {
  const SmallTop top;
  const ClothMaterial material;
  const PaperCloth unit =
      MakePaperCloth(top.mesh, top.mesh.rest_positions, material, MassLaw::kUnit, StiffnessLaw::kPerEdge).value();
  const PaperCloth lumped =
      MakePaperCloth(top.mesh, top.mesh.rest_positions, material, MassLaw::kLumped, StiffnessLaw::kPerEdge).value();
  double lumped_mass = 0.0;
  for (size_t i = 0; i < unit.masses.size(); ++i) {
    EXPECT_EQ(unit.masses[i], 1.0);
    lumped_mass += lumped.masses[i];
  }
  const double mean = lumped_mass / static_cast<double>(unit.masses.size());
  for (size_t i = 0; i < unit.springs.size(); ++i) {
    EXPECT_NEAR(unit.springs[i].constants.stiffness * mean, lumped.springs[i].constants.stiffness, 1e-9);
  }
}

TEST(PaperDrape, S33_ATopGoesThroughItsStagesToRest) {
  SmallTop top;
  std::vector<PaperStage> stages;
  const Result<PaperResult> result =
      PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, [&](const PaperSnapshot& s) {
        EXPECT_EQ(s.positions.size(), top.mesh.rest_positions.size());
        if (stages.empty() || stages.back() != s.stage) stages.push_back(s.stage);
      });
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kAtRest) << result->report.finishing_reason;
  EXPECT_TRUE(result->paper.condition_met);
  EXPECT_LT(result->paper.condition_value, 0.02);
  EXPECT_EQ(stages, (std::vector<PaperStage>{PaperStage::kStart, PaperStage::kMerging, PaperStage::kStitched,
                                             PaperStage::kDraping, PaperStage::kFinished}));
  EXPECT_EQ(Acting(result->paper.audit, PaperStage::kMerging), kBeforeStitching);
  EXPECT_EQ(Acting(result->paper.audit, PaperStage::kDraping), kDownwards);
  EXPECT_TRUE(Acting(result->paper.audit, PaperStage::kPullingUp).empty());
  EXPECT_LE(result->paper.time_step * result->paper.highest_frequency, 1.0 + 1e-12);
  for (const SeamPair& pair : top.mesh.seams) {
    EXPECT_EQ(result->positions[static_cast<size_t>(pair.a)], result->positions[static_cast<size_t>(pair.b)]);
  }
  // The same input gives the same bytes.
  const Result<PaperResult> again =
      PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, {});
  EXPECT_EQ(again->positions, result->positions);
}

TEST(PaperDrape, S27_StopsAtOnceWhenTold) {
  SmallTop top;
  top.options.waits_for_rest = false;
  const Result<PaperResult> result =
      PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, {});
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result->paper.condition_met);
  EXPECT_LT(result->report.simulated_seconds, 0.05);
  EXPECT_NE(result->report.finishing_reason.find("stopped at once"), std::string::npos);
}

// With the bars of (1) a cloth collapses: every shortened spring pulls. Without them it does not.
TEST(PaperDrape, S20_ThePrintedBarsCollapseTheCloth) {
  for (const SpringLaw law : {SpringLaw::kPrinted, SpringLaw::kSigned}) {
    SmallTop top;
    top.options.motion.spring = law;
    top.options.draping_step_limit = 800;
    const Result<PaperResult> result =
        PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, {});
    ASSERT_TRUE(result.ok()) << result.status().ToString();
    EXPECT_EQ(result->report.strain_p50 < -0.3, law == SpringLaw::kPrinted) << result->report.strain_p50;
  }
}

TEST(PaperDrape, S31_ABottomIsPulledUpBeltedAndHangs) {
  SmallBottom bottom;
  std::vector<PaperStage> stages;
  const Result<PaperResult> result = PaperDrape(bottom.mesh, bottom.mesh.rest_positions, bottom.body, bottom.options,
                                                bottom.serial, [&](const PaperSnapshot& s) {
                                                  if (stages.empty() || stages.back() != s.stage)
                                                    stages.push_back(s.stage);
                                                });
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(stages, (std::vector<PaperStage>{PaperStage::kStart, PaperStage::kMerging, PaperStage::kStitched,
                                             PaperStage::kPullingUp, PaperStage::kBelted, PaperStage::kDraping,
                                             PaperStage::kFinished}));
  EXPECT_TRUE(result->paper.crotch_arrived);
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kAtRest) << result->report.finishing_reason;
  EXPECT_TRUE(result->paper.condition_met);
  // Risen from -0.2 m to where the body is about as wide as the garment: its half width is 0.04 + 0.08 (y + 0.4) / 0.7.
  EXPECT_GT(result->paper.belt_height, -0.05);
  const double a = 0.04 + 0.08 * (result->paper.belt_height + 0.4) / 0.7;
  EXPECT_NEAR(result->paper.belt_body_girth, testing::EllipsePerimeter(a, 0.8 * a), 2e-3);
  EXPECT_NEAR(result->paper.belt_garment_girth, testing::EllipsePerimeter(0.0917, 0.8 * 0.0917), 1e-6);
  for (const int vertex : bottom.options.bottom->top_edge) {
    EXPECT_NEAR(result->positions[static_cast<size_t>(vertex)].y(), result->paper.belt_height, 1e-12);
  }
  const std::set<PaperForce> up = Acting(result->paper.audit, PaperStage::kPullingUp);
  EXPECT_TRUE(up.contains(PaperForce::kSpring) && up.contains(PaperForce::kAntigravity));
  EXPECT_FALSE(up.contains(PaperForce::kGravity) || up.contains(PaperForce::kStitching));
  const std::set<PaperForce> down = Acting(result->paper.audit, PaperStage::kDraping);
  EXPECT_TRUE(down.contains(PaperForce::kSpring) && down.contains(PaperForce::kGravity));
  EXPECT_FALSE(down.contains(PaperForce::kAntigravity) || down.contains(PaperForce::kStitching));
}

TEST(PaperDrape, AGarmentThatDoesNotCloseSaysSoAndIsNotDraped) {
  SmallTop top;
  top.options.merging_step_limit = 50;
  const Result<PaperResult> result =
      PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, {});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kSeamsOpen);
  EXPECT_EQ(result->report.merging_substeps, 50);
  EXPECT_EQ(result->report.draping_substeps, 0);
  EXPECT_NE(result->report.finishing_reason.find("does not close"), std::string::npos);
}

TEST(PaperDrape, EveryStageEndsAtItsLimit) {
  SmallTop top;
  top.options.motion.air_drag = 0.0;
  top.options.draping_step_limit = 300;
  const Result<PaperResult> result =
      PaperDrape(top.mesh, top.mesh.rest_positions, top.body, top.options, top.serial, {});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kNotAtRest);
  EXPECT_NE(result->report.finishing_reason.find("not at rest"), std::string::npos);
  SmallBottom bottom;
  bottom.options.pulling_up_step_limit = 10;
  bottom.options.draping_step_limit = 10;
  const Result<PaperResult> low =
      PaperDrape(bottom.mesh, bottom.mesh.rest_positions, bottom.body, bottom.options, bottom.serial, {});
  ASSERT_TRUE(low.ok());
  EXPECT_FALSE(low->paper.crotch_arrived);
  EXPECT_EQ(low->paper.pulling_up_steps, 10);
}

TEST(PaperDrape, RefusesWhatItCannotRun) {
  SmallTop top;
  const auto reason = [&](const PaperOptions& options, const std::vector<Eigen::Vector3d>& start) {
    return PaperDrape(top.mesh, start, top.body, options, top.serial, {}).status().reason();
  };
  const std::vector<Eigen::Vector3d> start = top.mesh.rest_positions;
  EXPECT_EQ(reason(top.options, {start.begin(), start.end() - 1}), "START_SIZE_MISMATCH");
  std::vector<Eigen::Vector3d> broken = start;
  broken[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason(top.options, broken), "START_NOT_FINITE");
  PaperOptions options = top.options;
  options.shoulder_vertices = {100000};
  EXPECT_EQ(reason(options, start), "VERTEX_OUT_OF_RANGE");
  options = top.options;
  options.frequency_times_step = 0.0;
  EXPECT_EQ(reason(options, start), "OPTION_OUT_OF_RANGE");
  options = top.options;
  options.bottom = PaperBottom();
  EXPECT_EQ(reason(options, start), "BOTTOM_INCOMPLETE");
  options = top.options;
  options.frequency_times_step = 40.0;  // Far beyond 2: the state explodes, and the run says so.
  options.merging_step_limit = 2000;
  EXPECT_EQ(reason(options, start), "CLOTH_STATE_NOT_FINITE");
}

}  // namespace
}  // namespace fitroom::paper
