#include "fit_client/fit/paper/spring.h"

#include <cmath>

namespace fitroom::paper {

Eigen::Vector3d SpringForce(const Eigen::Vector3d& dp, const Eigen::Vector3d& dv, double rest_length,
                            const SpringConstants& constants, SpringLaw law) {
  const double length = dp.norm();
  if (length == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d direction = dp / length;
  const double signed_extension = length - rest_length;
  const double extension = law == SpringLaw::kPrinted ? std::abs(signed_extension) : signed_extension;
  return -(constants.stiffness * extension + constants.damping * dv.dot(direction)) * direction;
}

}  // namespace fitroom::paper
