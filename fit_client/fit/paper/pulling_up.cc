#include "fit_client/fit/paper/pulling_up.h"

#include "fit_client/fit/paper/integration.h"

namespace fitroom::paper {

Eigen::Vector3d PulledUpVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& force,
                                 const Eigen::Vector3d& friction, double mass, double time_step, PullingUpLaw law) {
  const Eigen::Vector3d next_velocity = NextVelocity(velocity, force, mass, time_step);
  if (law == PullingUpLaw::kFrictionOnce) return next_velocity;
  return next_velocity + friction;
}

bool CrotchReached(const Eigen::Vector3d& crotch, const Eigen::Vector3d& groin, double epsilon) {
  return (crotch - groin).norm() < epsilon;
}

}  // namespace fitroom::paper
