#include "fit_client/fit/paper/integration.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/spring.h"

namespace fitroom::paper {
namespace {

// A mass of 1 kg on a spring with angular frequency 1 rad/s, along x; `omega_step` is omega dt.
class Oscillator {
 public:
  Oscillator(double omega_step, IntegrationLaw law) : step_(omega_step), law_(law) {
    motion_.position = Eigen::Vector3d::UnitX();
  }
  void Step() { motion_ = Integrate(motion_, -motion_.position, 1.0, step_, law_); }
  double x() const { return motion_.position.x(); }
  double v() const { return motion_.velocity.x(); }
  double energy() const { return 0.5 * (x() * x() + v() * v()); }

 private:
  double step_;
  IntegrationLaw law_;
  ParticleMotion motion_;
};

// v_n = n g dt and p_n = g dt^2 (1 + 2 + ... + n).
TEST(Integration, S21_FreeFallIsExactForTheSemiImplicitScheme) {
  const double dt = 1.0 / 1024.0;  // A power of two: no rounding.
  const Eigen::Vector3d weight(0.0, -8.0, 0.0);
  ParticleMotion motion;
  ParticleMotion explicit_motion;
  for (int n = 1; n <= 500; ++n) {
    motion = Integrate(motion, weight, 1.0, dt, IntegrationLaw::kPrinted);
    explicit_motion = Integrate(explicit_motion, weight, 1.0, dt, IntegrationLaw::kExplicit);
    EXPECT_EQ(motion.velocity.y(), -8.0 * n * dt);
    EXPECT_EQ(motion.position.y(), -8.0 * dt * dt * n * (n + 1) / 2.0);
    EXPECT_EQ(explicit_motion.position.y(), -8.0 * dt * dt * n * (n - 1) / 2.0);
  }
}

TEST(Integration, S21_AHeavierParticleIsSlower) {
  const ParticleMotion motion = Integrate({}, {6.0, 0.0, 0.0}, 3.0, 0.5, IntegrationLaw::kPrinted);
  EXPECT_DOUBLE_EQ(motion.velocity.x(), 1.0);
  EXPECT_DOUBLE_EQ(motion.position.x(), 0.5);
}

// The scheme turns the phase by acos(1 - (omega dt)^2 / 2) a step: the root of its characteristic polynomial
// z^2 - (2 - omega^2 dt^2) z + 1.
TEST(Integration, S21_OscillatorHasTheSchemesPeriod) {
  for (const double omega_step : {0.05, 0.3, 1.0}) {
    Oscillator oscillator(omega_step, IntegrationLaw::kPrinted);
    const double phase_step = std::acos(1.0 - 0.5 * omega_step * omega_step);
    double first_crossing = 0.0;
    double last_crossing = 0.0;
    int crossings = 0;
    double x_before = oscillator.x();
    for (int n = 1; n <= 4000; ++n) {
      oscillator.Step();
      if (x_before < 0.0 && oscillator.x() >= 0.0) {
        last_crossing = n;
        if (crossings++ == 0) first_crossing = n;
      }
      x_before = oscillator.x();
    }
    ASSERT_GT(crossings, 10);
    const double steps_a_period = (last_crossing - first_crossing) / (crossings - 1);
    EXPECT_NEAR(steps_a_period, 2.0 * M_PI / phase_step, 1.0 / (crossings - 1) + 1e-9) << omega_step;
  }
}

// x^2 + v^2 - omega dt x v is kept exactly, so that the energy stays between its (1 - h/2) and (1 + h/2) parts.
TEST(Integration, S21_EnergyIsBoundedUpToOmegaDtOfOne) {
  for (const double omega_step : {0.1, 0.5, 1.0}) {
    Oscillator oscillator(omega_step, IntegrationLaw::kPrinted);
    const auto kept = [&] {
      return 0.5 * (oscillator.x() * oscillator.x() + oscillator.v() * oscillator.v() -
                    omega_step * oscillator.x() * oscillator.v());
    };
    const double kept_at_first = kept();
    double largest = 0.0;
    for (int n = 0; n < 100000; ++n) {
      oscillator.Step();
      largest = std::max(largest, oscillator.energy());
    }
    EXPECT_NEAR(kept(), kept_at_first, 1e-9);
    EXPECT_LE(largest, 0.5 / (1.0 - 0.5 * omega_step) + 1e-9);
    EXPECT_LE(largest / 0.5, 3.0);
  }
}

TEST(Integration, S21_BlowsUpBeyondTwo) {
  Oscillator below(1.99, IntegrationLaw::kPrinted);
  Oscillator above(2.05, IntegrationLaw::kPrinted);
  for (int n = 0; n < 200; ++n) {
    below.Step();
    above.Step();
  }
  EXPECT_LT(below.energy(), 1e3);
  EXPECT_GT(above.energy(), 1e12);
}

// What "explicit Euler", the name in print, would do: energy times 1 + (omega dt)^2 a step.
TEST(Integration, S21_ExplicitEulerGainsEnergyAtAnyStep) {
  Oscillator oscillator(0.1, IntegrationLaw::kExplicit);
  for (int n = 0; n < 100; ++n) oscillator.Step();
  EXPECT_NEAR(oscillator.energy() / 0.5, std::pow(1.01, 100.0), 1e-9);
}

PaperCloth Chain(int particle_count, double stiffness, double mass) {
  PaperCloth chain;
  for (int i = 0; i < particle_count; ++i) {
    chain.positions.emplace_back(i, 0.0, 0.0);
    chain.velocities.emplace_back(0.0, 0.0, 0.0);
    chain.masses.push_back(mass);
    chain.pinned.push_back(0);
    chain.particle_of_vertex.push_back(i);
    if (i > 0) chain.springs.push_back({i - 1, i, 1.0, {stiffness, 0.0}});
  }
  return chain;
}

// Two masses on a spring: sqrt(2 k / m). A chain of n: 2 sqrt(k / m) cos(pi / 2n), below the bound 2 sqrt(k / m).
TEST(Integration, S21_HighestFrequencyBoundsWhatTheNetHas) {
  EXPECT_NEAR(HighestFrequency(Chain(2, 8.0, 4.0)), 2.0, 1e-12);
  for (const int count : {3, 10, 50}) {
    const double bound = HighestFrequency(Chain(count, 8.0, 2.0));
    const double exact = 2.0 * std::sqrt(8.0 / 2.0) * std::cos(M_PI / (2.0 * count));
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 1.2 * exact);
  }
}

}  // namespace
}  // namespace fitroom::paper
