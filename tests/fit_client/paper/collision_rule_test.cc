#include "fit_client/fit/paper/collision_rule.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/paper_motion.h"
#include "tests/fit_client/collision/shapes.h"

namespace fitroom::paper {
namespace {

TEST(CollisionRule, S26_WallAndSlopeTakeTheNormalPartOnly) {
  // A wall: what goes along stays.
  EXPECT_EQ(InelasticVelocity({-3.0, 2.0, 1.0}, Eigen::Vector3d::UnitX()), Eigen::Vector3d(0.0, 2.0, 1.0));
  // Leaving and gliding are not touched.
  EXPECT_EQ(InelasticVelocity({3.0, 2.0, 1.0}, Eigen::Vector3d::UnitX()), Eigen::Vector3d(3.0, 2.0, 1.0));
  EXPECT_EQ(InelasticVelocity({0.0, 2.0, 1.0}, Eigen::Vector3d::UnitX()), Eigen::Vector3d(0.0, 2.0, 1.0));
  // A slope of 3:4, falling towards +x: falling at 5 leaves 3 along it. World-horizontal would leave none.
  const Eigen::Vector3d normal(0.6, 0.8, 0.0);
  const Eigen::Vector3d kept = InelasticVelocity({0.0, -5.0, 0.0}, normal);
  EXPECT_LT((kept - 3.0 * Eigen::Vector3d(0.8, -0.6, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(kept.dot(normal), 0.0, 1e-12);
}

TriangleMesh Slope(double angle) {
  TriangleMesh plate =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, -0.06, -0.1), Eigen::Vector3d(0.9, 0.0, 0.1)), 40);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (Eigen::Vector3d& vertex : plate.vertices) vertex = tilt * vertex;
  return plate;
}

PaperMotion Single(const BodyCollider& body, const Eigen::Vector3d& place, const Eigen::Vector3d& velocity,
                   double gravity) {
  PaperCloth particle;
  particle.positions = {place};
  particle.velocities = {velocity};
  particle.masses = {1.0};
  particle.pinned = {0};
  particle.particle_of_vertex = {0};
  PaperMotionOptions options;
  options.gravity = gravity;
  options.friction_factor = 0.0;
  return PaperMotion(particle, body, options, 1e-3);
}

// Once it lies on the slope a particle gains g sin(angle) dt along it in each step, and nothing across.
TEST(CollisionRule, S26_AParticleSlidesDownASlopeAsGravityAlongItSays) {
  const double angle = 0.5;
  const BodyCollider slope = BodyCollider::Build(Slope(angle), 0.08, {Registration::kOverlap, false, 0.0}).value();
  const Eigen::Vector3d downhill(std::cos(angle), -std::sin(angle), 0.0);
  const Eigen::Vector3d normal(std::sin(angle), std::cos(angle), 0.0);
  PaperMotion motion = Single(slope, 0.002 * normal, Eigen::Vector3d::Zero(), 9.81);
  for (int step = 0; step < 60; ++step) motion.Step(PaperStage::kDraping);
  ASSERT_TRUE(motion.IsColliding(0));
  const Eigen::Vector3d before = motion.cloth().velocities[0];
  const double depth_before = motion.cloth().positions[0].dot(normal);
  for (int step = 0; step < 200; ++step) motion.Step(PaperStage::kDraping);
  const Eigen::Vector3d gained = motion.cloth().velocities[0] - before;
  EXPECT_NEAR(gained.dot(downhill), 0.2 * 9.81 * std::sin(angle), 1e-9);
  EXPECT_NEAR(gained.dot(normal), 0.0, 1e-9);
  // No offset: it stays where it touched, up to the way of one step.
  EXPECT_NEAR(motion.cloth().positions[0].dot(normal), depth_before, 1e-9);
  EXPECT_NEAR(depth_before, 0.0, 5e-4);
}

TEST(CollisionRule, S26_WithAnOffsetTheParticleIsPutThere) {
  const BodyCollider slope = BodyCollider::Build(Slope(0.5), 0.08, {Registration::kOverlap, true, 0.003}).value();
  const Eigen::Vector3d normal(std::sin(0.5), std::cos(0.5), 0.0);
  PaperMotion motion = Single(slope, 0.01 * normal, Eigen::Vector3d::Zero(), 9.81);
  for (int step = 0; step < 150; ++step) motion.Step(PaperStage::kDraping);
  ASSERT_TRUE(motion.IsColliding(0));
  EXPECT_NEAR(motion.cloth().positions[0].dot(normal), 0.003, 1e-6);
}

// A wall thinner than a step: printed, the particle is looked for where it arrives, behind the wall.
TEST(CollisionRule, S26_WithoutASweepAFastParticleTunnels) {
  const TriangleMesh wall =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.1, -0.1, -0.001), Eigen::Vector3d(0.1, 0.1, 0.001)), 20);
  for (const bool swept : {false, true}) {
    const BodyCollider collider = BodyCollider::Build(wall, 0.04, {Registration::kOverlap, swept, 0.0}).value();
    PaperMotion motion = Single(collider, {0.003, 0.002, 0.013}, {0.0, 0.0, -20.0}, 0.0);
    for (int step = 0; step < 20; ++step) motion.Step(PaperStage::kDraping);
    EXPECT_EQ(motion.cloth().positions[0].z() > 0.0, swept);
  }
}

// Above every region of a box the nearest polygon decides, also where edges and corners are shared.
TEST(CollisionRule, S26_OutsideABoxNothingTouches) {
  const TriangleMesh body =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.1, -0.1, -0.1), Eigen::Vector3d(0.1, 0.1, 0.1)), 10);
  const BodyCollider box = BodyCollider::Build(body, 0.06, {Registration::kOverlap, false, 0.0}).value();
  for (const double x : {-0.101, -0.1 + 1e-6, 0.0, 0.1 - 1e-6, 0.101}) {
    for (const double y : {-0.101, -0.1 + 1e-6, 0.0, 0.1 - 1e-6, 0.101}) {
      for (const double z : {-0.101, -0.1 + 1e-6, 0.03, 0.1 - 1e-6, 0.101}) {
        const Eigen::Vector3d place(x, y, z);
        const double depth = 0.1 - place.cwiseAbs().maxCoeff();
        if (depth > 0.01) continue;
        const std::optional<BodyContact> contact = box.FindContact(place, place);
        EXPECT_EQ(contact.has_value(), depth > 0.0) << place.transpose();
        if (contact.has_value()) {
          EXPECT_NEAR(contact->distance, -depth, 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace fitroom::paper
