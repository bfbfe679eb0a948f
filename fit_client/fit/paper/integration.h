#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/paper/paper_cloth.h"

namespace fitroom::paper {

// How equation (2) is read.
enum class IntegrationLaw {
  kPrinted,   // The new velocity moves the particle: semi-implicit (symplectic) Euler.
  kExplicit,  // The old velocity moves the particle: what "explicit Euler", the name in print, means. Gains energy.
};

// Where a particle is and how it moves.
struct ParticleMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // (unit: metre)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // (unit: m/s)
};

// Equation (2), first half: v' = v + F dt / m.
Eigen::Vector3d NextVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& force, double mass,
                             double time_step);
// Equation (2), second half: p' = p + v' dt.
Eigen::Vector3d NextPosition(const Eigen::Vector3d& position, const Eigen::Vector3d& next_velocity, double time_step);

// Equation (2) whole, for a particle that meets nothing.
ParticleMotion Integrate(const ParticleMotion& motion, const Eigen::Vector3d& force, double mass, double time_step,
                         IntegrationLaw law);

// Returns a bound of the largest angular frequency of the net of springs (unit: rad/s): omega^2 is an eigenvalue of
// M^-1 K, and by Gershgorin's circles no larger than 2 max_i sum_j k_ij / m_i. Exact for two equal masses on a spring.
// The scheme is stable for omega dt < 2; we keep omega dt <= 1, where its energy errs by no more than a factor of
// three.
double HighestFrequency(const PaperCloth& cloth);

}  // namespace fitroom::paper
