#include "fit_client/fit/paper/stitching.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/paper_motion.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/paper/common_case.h"

namespace fitroom::paper {
namespace {

BodyCollider FarBody() { return BodyCollider::Build(testing::MakeSphere({0.0, -9.0, 0.0}, 0.05, 1), 0.05, {}).value(); }

ClothMesh SmallTube() { return testing::MakeConeSkirt(0.05, 0.05, 1.0, -0.2, 0.2, -0.1, 0.1, 1.0, 0.1, 6, 4); }

TEST(Stitching, S22_ThePrintedPullIsConstantAndPointsAtThePartner) {
  const StitchingOptions printed;
  for (const double distance : {0.3, 0.01, 1e-6}) {
    for (const double speed : {0.0, 5.0}) {
      const Eigen::Vector3d force = StitchingForce({0.0, 0.0, distance}, {0.0, 0.0, -speed}, 15.0, printed);
      EXPECT_EQ(force, Eigen::Vector3d(0.0, 0.0, -15.0));
    }
  }
  EXPECT_EQ(StitchingForce(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 15.0, printed),
            Eigen::Vector3d::Zero().eval());
}

TEST(Stitching, S22_TheCorrectedPullStopsAtTheClosingSpeed) {
  StitchingOptions options;
  options.law = StitchingLaw::kSeamsOnly;
  options.closing_speed = 1.0;
  EXPECT_EQ(StitchingForce({0.0, 0.0, 0.1}, {0.0, 0.0, -0.9}, 15.0, options).z(), -15.0);
  EXPECT_EQ(StitchingForce({0.0, 0.0, 0.1}, {0.0, 0.0, -1.1}, 15.0, options).z(), 0.0);
}

TEST(Stitching, S22_EveryFrontParticleHasThePartnerAcrossTheGarment) {
  const ClothMesh tube = SmallTube();
  const Result<std::vector<SeamPair>> partners = FindPartners(tube);
  ASSERT_TRUE(partners.ok());
  EXPECT_EQ(partners->size() * 2, tube.rest_positions.size());
  for (const SeamPair& pair : *partners) {
    const Eigen::Vector3d way =
        tube.rest_positions[static_cast<size_t>(pair.a)] - tube.rest_positions[static_cast<size_t>(pair.b)];
    EXPECT_NEAR(way.head<2>().norm(), 0.0, 1e-12);
    EXPECT_GT(way.z(), 0.1);
  }
  ClothMesh unknown = tube;
  unknown.panel_of_particle.clear();
  EXPECT_EQ(FindPartners(unknown).status().reason(), "PANELS_UNKNOWN");
}

// Stitching and spring forces are equal and opposite, so that nothing is moved as a whole.
TEST(Stitching, S22_ForcesBeforeStitchingSumToZero) {
  const ClothMesh tube = SmallTube();
  for (const StitchingLaw law : {StitchingLaw::kPrinted, StitchingLaw::kSeamsOnly}) {
    std::vector<Eigen::Vector3d> start = tube.rest_positions;
    for (size_t i = 0; i < start.size(); ++i) {
      const double phase = static_cast<double>(i);
      start[i] += 0.01 * Eigen::Vector3d(std::sin(3.0 * phase), std::cos(phase), 0.3);
    }
    PaperCloth cloth = MakePaperCloth(tube, start, {}, MassLaw::kUnit, StiffnessLaw::kOneForAll).value();
    for (size_t i = 0; i < start.size(); ++i) {
      const double phase = static_cast<double>(i);
      cloth.velocities[i] = Eigen::Vector3d(std::cos(phase), 0.2, std::sin(phase));
    }
    SetDamping(cloth, 1e-4);
    const double stiffness = cloth.springs.front().constants.stiffness;
    const BodyCollider far = FarBody();
    PaperMotionOptions options;
    options.stitching.law = law;
    PaperMotion motion(cloth, far, options, 1e-5);
    motion.SetStitches(law == StitchingLaw::kPrinted ? FindPartners(tube).value() : tube.seams);
    const ParticleForces forces = motion.ComputeForces(PaperStage::kMerging);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double largest = 0.0;
    for (const Eigen::Vector3d& force : forces.total) {
      sum += force;
      largest = std::max(largest, force.norm());
    }
    EXPECT_GT(largest, 10.0);
    EXPECT_LT(sum.norm(), 1e-12 * stiffness);
    EXPECT_GT(motion.audit().At(PaperStage::kMerging, PaperForce::kStitching), 0);
  }
}

// Two free unit masses pulled with F meet after sqrt(d / F): both are accelerated by F and go half the way.
TEST(Stitching, S22_TwoParticlesMeetWhenConstantAccelerationSays) {
  PaperCloth pair;
  pair.positions = {{0.0, 0.0, 0.1}, {0.0, 0.0, -0.1}};
  pair.velocities.assign(2, Eigen::Vector3d::Zero());
  pair.masses = {1.0, 1.0};
  pair.pinned = {0, 0};
  pair.particle_of_vertex = {0, 1};
  const BodyCollider far = FarBody();
  PaperMotionOptions options;
  options.stitching.pull = 5.0;
  PaperMotion motion(pair, far, options, 1e-4);
  motion.SetStitches({{0, 1}});
  int steps = 0;
  for (bool met = false; !met && steps < 10000; ++steps) {
    const Eigen::Vector3d before = motion.cloth().positions[0] - motion.cloth().positions[1];
    motion.Step(PaperStage::kMerging);
    met = Met(before, motion.cloth().positions[0] - motion.cloth().positions[1], 1e-6);
  }
  EXPECT_NEAR(steps * 1e-4, std::sqrt(0.2 / 5.0), 2e-4);
  EXPECT_NEAR(motion.cloth().velocities[1].z(), std::sqrt(0.2 * 5.0), 2e-3);
}

TEST(Stitching, S22_MeetingIsSeenBetweenSteps) {
  EXPECT_TRUE(Met({0.0, 0.0, 0.1}, {0.0, 0.0, -0.1}, 1e-3));     // Passes through.
  EXPECT_FALSE(Met({0.01, 0.0, 0.1}, {0.01, 0.0, -0.1}, 1e-3));  // Passes by.
  EXPECT_TRUE(Met({0.0, 0.0, 0.1}, {0.0, 0.0, 0.0005}, 1e-3));   // Arrives.
  EXPECT_FALSE(Met({0.0, 0.0, 0.1}, {0.0, 0.0, 0.002}, 1e-3));   // Not yet.
  EXPECT_FALSE(Met({0.0, 0.0, 0.1}, {0.0, 0.0, 0.1}, 1e-3));     // Stays.
}

TEST(Stitching, S22_SewingKeepsMassAndMomentumAndDropsTheSpringBetween) {
  const ClothMesh tube = SmallTube();
  PaperCloth cloth = MakePaperCloth(tube, tube.rest_positions, {}, MassLaw::kUnit, StiffnessLaw::kOneForAll).value();
  const SeamPair seam = tube.seams.front();
  const size_t a = static_cast<size_t>(seam.a);
  const size_t b = static_cast<size_t>(seam.b);
  cloth.velocities[a] = {1.0, 0.0, 0.0};
  cloth.velocities[b] = {0.0, 3.0, 0.0};
  cloth.masses[b] = 2.0;
  cloth.springs.push_back({seam.a, seam.b, 0.1, {1.0, 0.0}});
  const size_t spring_count = cloth.springs.size();
  Weld(cloth, seam.a, seam.b);
  EXPECT_DOUBLE_EQ(cloth.masses[a], 3.0);
  EXPECT_FALSE(cloth.IsAlive(b));
  EXPECT_LT((cloth.masses[a] * cloth.velocities[a] - Eigen::Vector3d(1.0, 6.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(cloth.springs.size(), spring_count - 1);
  EXPECT_EQ(VertexPositions(cloth)[a], VertexPositions(cloth)[b]);
  EXPECT_EQ(AlivePositions(cloth).size(), tube.rest_positions.size() - 1);
  for (const PaperSpring& spring : cloth.springs) EXPECT_TRUE(spring.a != seam.b && spring.b != seam.b);
}

}  // namespace
}  // namespace fitroom::paper
