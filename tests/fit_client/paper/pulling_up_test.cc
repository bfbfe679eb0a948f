#include "fit_client/fit/paper/pulling_up.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/paper_motion.h"
#include "fit_client/fit/paper/weight.h"
#include "tests/fit_client/collision/shapes.h"

namespace fitroom::paper {
namespace {

TEST(PullingUp, S28_ThePrintedTermIsAddedToTheVelocity) {
  const Eigen::Vector3d v(1.0, 0.0, 0.0);
  const Eigen::Vector3d friction = -0.01 * v;
  const Eigen::Vector3d force = Eigen::Vector3d(0.0, 2.0, 0.0) + friction;
  // By hand: v + (F + f) 0.1 / 0.5, and 0.01 less once more.
  EXPECT_LT(
      (PulledUpVelocity(v, force, friction, 0.5, 0.1, PullingUpLaw::kFrictionOnce) - Eigen::Vector3d(0.998, 0.4, 0.0))
          .norm(),
      1e-12);
  EXPECT_LT((PulledUpVelocity(v, force, friction, 0.5, 0.1, PullingUpLaw::kPrinted) - Eigen::Vector3d(0.988, 0.4, 0.0))
                .norm(),
            1e-12);
}

// The printed term brakes a step, not a second: twice as many steps brake twice as much.
TEST(PullingUp, S28_ThePrintedTermDependsOnTheStep) {
  const auto speed_after_a_second = [](int step_count, PullingUpLaw law) {
    Eigen::Vector3d v = Eigen::Vector3d::UnitX();
    for (int step = 0; step < step_count; ++step) {
      const Eigen::Vector3d friction = -0.01 * v;
      v = PulledUpVelocity(v, friction, friction, 1.0, 1.0 / step_count, law);
    }
    return v.x();
  };
  EXPECT_NEAR(speed_after_a_second(100, PullingUpLaw::kPrinted), std::exp(-1.01), 0.01);
  EXPECT_NEAR(speed_after_a_second(200, PullingUpLaw::kPrinted), std::exp(-2.01), 0.01);
  EXPECT_NEAR(speed_after_a_second(100, PullingUpLaw::kFrictionOnce), std::exp(-0.01), 1e-6);
  EXPECT_NEAR(speed_after_a_second(200, PullingUpLaw::kFrictionOnce), std::exp(-0.01), 1e-6);
}

TEST(PullingUp, S28_EndsExactlyWhenTheCrotchIsNearerThanEpsilon) {
  EXPECT_TRUE(CrotchReached({0.0, 0.795, 0.0}, {0.0, 0.8, 0.0}, 0.006));
  EXPECT_FALSE(CrotchReached({0.0, 0.795, 0.0}, {0.0, 0.8, 0.0}, 0.004));
  EXPECT_FALSE(CrotchReached({0.0, 0.0, 0.01}, {0.0, 0.0, 0.0}, 0.01));
}

TEST(Antigravity, S29_IsTheWeightUpwards) {
  const Eigen::Vector3d g(0.0, 0.0, -9.81);
  EXPECT_EQ(GravityForce(2.0, g), Eigen::Vector3d(0.0, 0.0, -19.62));
  EXPECT_EQ(AntigravityForce(2.0, g), Eigen::Vector3d(0.0, 0.0, 19.62));
}

TEST(Antigravity, S29_AFreeParticleRisesAsItWouldFall) {
  const BodyCollider far = BodyCollider::Build(testing::MakeSphere({0.0, -9.0, 0.0}, 0.05, 1), 0.05, {}).value();
  PaperCloth particle;
  particle.positions = {Eigen::Vector3d::Zero()};
  particle.velocities = {Eigen::Vector3d::Zero()};
  particle.masses = {1.0};
  particle.pinned = {0};
  particle.particle_of_vertex = {0};
  PaperMotion rising(particle, far, {}, 1e-3);
  PaperMotion falling(particle, far, {}, 1e-3);
  for (int step = 0; step < 100; ++step) {
    rising.Step(PaperStage::kPullingUp);
    falling.Step(PaperStage::kDraping);
  }
  EXPECT_NEAR(rising.cloth().velocities[0].y(), 0.981, 1e-12);
  EXPECT_EQ(rising.cloth().positions[0], Eigen::Vector3d(-falling.cloth().positions[0]));
}

}  // namespace
}  // namespace fitroom::paper
