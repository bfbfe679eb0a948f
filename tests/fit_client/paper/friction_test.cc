#include "fit_client/fit/paper/friction.h"

#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/paper_motion.h"
#include "tests/fit_client/collision/shapes.h"

namespace fitroom::paper {
namespace {

TEST(Friction, S23_ActsAlongXAndZOfTheFile) {
  const Eigen::Vector3d v(2.0, 3.0, 5.0);
  const PaperFrame file = PaperFrame::ZUp();
  const PaperFrame canonical = PaperFrame::YUp();
  // The file's x and z: across and up.
  EXPECT_EQ(FrictionForce(v, -0.01, file, FrictionAxes::kFrontalPlane), Eigen::Vector3d(-0.02, 0.0, -0.05));
  EXPECT_EQ(FrictionForce(v, -0.01, canonical, FrictionAxes::kFrontalPlane), Eigen::Vector3d(-0.02, -0.03, 0.0));
  // The other reading: x and z of a file that is y up, the ground.
  EXPECT_EQ(FrictionForce(v, -0.01, file, FrictionAxes::kGroundPlane), Eigen::Vector3d(-0.02, -0.03, 0.0));
  EXPECT_EQ(FrictionForce(v, -0.01, canonical, FrictionAxes::kGroundPlane), Eigen::Vector3d(-0.02, 0.0, -0.05));
  EXPECT_EQ(kPrintedFrictionFactor, -0.01);
}

// A single particle, gliding on the top of a box or flying over it, with friction alone.
PaperMotion Glide(const BodyCollider& box, double height, const Eigen::Vector3d& velocity, FrictionAxes axes) {
  PaperCloth particle;
  particle.positions = {{0.0, height, 0.0}};
  particle.velocities = {velocity};
  particle.masses = {1.0};
  particle.pinned = {0};
  particle.particle_of_vertex = {0};
  PaperMotionOptions options;
  options.friction_axes = axes;
  options.gravity = 0.0;
  return PaperMotion(particle, box, options, 1e-3);
}

TEST(Friction, S23_SlowsOnlyWhatCollidesAndLeavesTheThirdComponentToTheBit) {
  const TriangleMesh body =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.2, -0.1, -0.2), Eigen::Vector3d(0.2, 0.0, 0.2)), 40);
  const BodyCollider box = BodyCollider::Build(body, 0.05, {Registration::kOverlap, false, 0.0}).value();
  const Eigen::Vector3d start(0.1, 0.0, 1.0 / 3.0);
  // Just below the surface: collides; the surface is level, so that x and z are free to move.
  PaperMotion gliding = Glide(box, -1e-6, start, FrictionAxes::kFrontalPlane);
  PaperMotion flying = Glide(box, 0.04, start, FrictionAxes::kFrontalPlane);
  for (int step = 0; step < 100; ++step) {
    gliding.Step(PaperStage::kDraping);
    flying.Step(PaperStage::kDraping);
  }
  ASSERT_TRUE(gliding.IsColliding(0));
  ASSERT_FALSE(flying.IsColliding(0));
  // One step passes before the collision is known; then v' = v (1 + mu dt / m).
  EXPECT_NEAR(gliding.cloth().velocities[0].x(), 0.1 * std::pow(1.0 - 0.01 * 1e-3, 99.0), 1e-15);
  EXPECT_EQ(std::bit_cast<uint64_t>(gliding.cloth().velocities[0].z()), std::bit_cast<uint64_t>(start.z()));
  EXPECT_EQ(flying.cloth().velocities[0], start);
  PaperMotion other = Glide(box, -1e-6, start, FrictionAxes::kGroundPlane);
  for (int step = 0; step < 100; ++step) other.Step(PaperStage::kDraping);
  EXPECT_LT(other.cloth().velocities[0].z(), start.z());
}

// The printed friction is a drag: it never stops what Coulomb's would.
TEST(Friction, S23_CoulombTakesAtMostItsConeAndStops) {
  EXPECT_LT((CoulombSlowed({3.0, 0.0, 4.0}, 2.0, 0.5) - Eigen::Vector3d(2.4, 0.0, 3.2)).norm(), 1e-12);
  EXPECT_EQ(CoulombSlowed({0.3, 0.0, 0.4}, 2.0, 0.5), Eigen::Vector3d::Zero().eval());
  EXPECT_EQ(CoulombSlowed(Eigen::Vector3d::Zero(), 2.0, 0.5), Eigen::Vector3d::Zero().eval());
}

}  // namespace
}  // namespace fitroom::paper
