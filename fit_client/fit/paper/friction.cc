#include "fit_client/fit/paper/friction.h"

#include <algorithm>

namespace fitroom::paper {

Eigen::Vector3d FrictionForce(const Eigen::Vector3d& velocity, double factor, const PaperFrame& frame,
                              FrictionAxes axes) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  const int second = axes == FrictionAxes::kFrontalPlane ? frame.up : frame.depth;
  force[frame.across] = factor * velocity[frame.across];
  force[second] = factor * velocity[second];
  return force;
}

Eigen::Vector3d CoulombSlowed(const Eigen::Vector3d& tangential_velocity, double normal_speed, double coefficient) {
  const double speed = tangential_velocity.norm();
  if (speed == 0.0) return tangential_velocity;
  return tangential_velocity * std::max(0.0, 1.0 - coefficient * normal_speed / speed);
}

}  // namespace fitroom::paper
