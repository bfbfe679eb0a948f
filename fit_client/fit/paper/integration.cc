#include "fit_client/fit/paper/integration.h"

#include <algorithm>
#include <cmath>

namespace fitroom::paper {

Eigen::Vector3d NextVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& force, double mass,
                             double time_step) {
  return velocity + force * (time_step / mass);
}

Eigen::Vector3d NextPosition(const Eigen::Vector3d& position, const Eigen::Vector3d& next_velocity, double time_step) {
  return position + next_velocity * time_step;
}

ParticleMotion Integrate(const ParticleMotion& motion, const Eigen::Vector3d& force, double mass, double time_step,
                         IntegrationLaw law) {
  const Eigen::Vector3d next_velocity = NextVelocity(motion.velocity, force, mass, time_step);
  const Eigen::Vector3d moving = law == IntegrationLaw::kPrinted ? next_velocity : motion.velocity;
  return {NextPosition(motion.position, moving, time_step), next_velocity};
}

double HighestFrequency(const PaperCloth& cloth) {
  std::vector<double> stiffness_sums(cloth.positions.size(), 0.0);
  for (const PaperSpring& spring : cloth.springs) {
    stiffness_sums[static_cast<size_t>(spring.a)] += spring.constants.stiffness;
    stiffness_sums[static_cast<size_t>(spring.b)] += spring.constants.stiffness;
  }
  double largest = 0.0;
  for (size_t particle = 0; particle < stiffness_sums.size(); ++particle) {
    if (cloth.IsAlive(particle)) largest = std::max(largest, 2.0 * stiffness_sums[particle] / cloth.masses[particle]);
  }
  return std::sqrt(largest);
}

}  // namespace fitroom::paper
