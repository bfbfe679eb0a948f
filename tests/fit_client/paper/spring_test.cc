#include "fit_client/fit/paper/spring.h"

#include <gtest/gtest.h>

namespace fitroom::paper {
namespace {

// dp = (3, 4, 0): length 5, direction (0.6, 0.8, 0). dv . u = 0.6. k = 10, k_d = 2. Worked out by hand.
struct TwoParticles {
  double rest_length;
  SpringLaw law;
  Eigen::Vector3d dv;
  Eigen::Vector3d force;
};

TEST(Spring, S20_TwoParticleTable) {
  const Eigen::Vector3d dp(3.0, 4.0, 0.0);
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  const TwoParticles kTable[] = {
      {4.0, SpringLaw::kPrinted, still, {-6.0, -8.0, 0.0}},              // Longer by 1: pulls with 10.
      {4.0, SpringLaw::kSigned, still, {-6.0, -8.0, 0.0}},               //
      {5.0, SpringLaw::kPrinted, still, {0.0, 0.0, 0.0}},                // At rest.
      {5.0, SpringLaw::kSigned, still, {0.0, 0.0, 0.0}},                 //
      {6.0, SpringLaw::kPrinted, still, {-6.0, -8.0, 0.0}},              // Shorter by 1: the bars make it pull,
      {6.0, SpringLaw::kSigned, still, {6.0, 8.0, 0.0}},                 // without them it pushes.
      {5.0, SpringLaw::kPrinted, {1.0, 0.0, 0.0}, {-0.72, -0.96, 0.0}},  // Damper alone: 2 * 0.6 against dv . u.
      {5.0, SpringLaw::kPrinted, {-0.8, 0.6, 9.0}, {0.0, 0.0, 0.0}},     // Across the spring nothing is damped.
      {6.0, SpringLaw::kPrinted, {1.0, 0.0, 0.0}, {-6.72, -8.96, 0.0}},  // Both.
      {6.0, SpringLaw::kSigned, {1.0, 0.0, 0.0}, {5.28, 7.04, 0.0}},     //
  };
  for (const TwoParticles& row : kTable) {
    const Eigen::Vector3d force = SpringForce(dp, row.dv, row.rest_length, {10.0, 2.0}, row.law);
    EXPECT_LT((force - row.force).norm(), 1e-12) << "rest length " << row.rest_length << ": " << force.transpose();
    const Eigen::Vector3d on_other = SpringForce(-dp, -row.dv, row.rest_length, {10.0, 2.0}, row.law);
    EXPECT_EQ(on_other, -force);
  }
}

TEST(Spring, S20_TheSignedForceIsTheSlopeOfItsEnergy) {
  const auto energy = [](const Eigen::Vector3d& dp) { return 0.5 * 7.0 * (dp.norm() - 0.3) * (dp.norm() - 0.3); };
  for (const Eigen::Vector3d& dp : {Eigen::Vector3d(0.1, 0.05, -0.2), Eigen::Vector3d(0.4, -0.3, 0.1)}) {
    Eigen::Vector3d slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
      slope[axis] = (energy(dp + step) - energy(dp - step)) / 2e-6;
    }
    const Eigen::Vector3d force = SpringForce(dp, Eigen::Vector3d::Zero(), 0.3, {7.0, 0.0}, SpringLaw::kSigned);
    EXPECT_LT((force + slope).norm(), 1e-7);
  }
}

TEST(Spring, S20_TheDamperTakesEnergyWhateverTheMotion) {
  for (const Eigen::Vector3d& dv : {Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(-3.0, 0.1, 2.0)}) {
    const Eigen::Vector3d force =
        SpringForce({0.2, 0.1, 0.3}, dv, Eigen::Vector3d(0.2, 0.1, 0.3).norm(), {5.0, 0.4}, SpringLaw::kPrinted);
    EXPECT_LT(force.dot(dv), 0.0);
  }
}

TEST(Spring, S20_ParticlesOnOnePlaceHaveNoDirection) {
  EXPECT_EQ(SpringForce(Eigen::Vector3d::Zero(), {1.0, 0.0, 0.0}, 0.5, {10.0, 2.0}, SpringLaw::kPrinted),
            Eigen::Vector3d::Zero().eval());
}

}  // namespace
}  // namespace fitroom::paper
