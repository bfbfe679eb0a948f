#pragma once

#include <Eigen/Core>

namespace fitroom::paper {

// How equation (7) is read.
enum class PullingUpLaw {
  kPrinted,       // v' = v + F dt / m + f_f, although F holds friction already.
  kFrictionOnce,  // v' = v + F dt / m.
};

// Equation (7): the velocity of a particle while a bottom is pulled up. `force` is the sum of all forces, friction
// included; `friction` is f_f. Printed, a force is added to a velocity, and friction acts twice: as a force and, per
// step whatever its length, as a velocity.
Eigen::Vector3d PulledUpVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& force,
                                 const Eigen::Vector3d& friction, double mass, double time_step, PullingUpLaw law);

// The condition that ends it: the crotch of the garment is less than `epsilon` away from the groin.
bool CrotchReached(const Eigen::Vector3d& crotch, const Eigen::Vector3d& groin, double epsilon);

}  // namespace fitroom::paper
