#pragma once

#include <Eigen/Core>

namespace fitroom::paper {

// The gravity of equations (5) and (10): m g, with g pointing down (unit: newton for kg and m/s^2).
inline Eigen::Vector3d GravityForce(double mass, const Eigen::Vector3d& gravity) { return mass * gravity; }

// Equation (8), printed under the name of friction: f_r = -m g. Pulls a bottom up the legs.
inline Eigen::Vector3d AntigravityForce(double mass, const Eigen::Vector3d& gravity) { return -mass * gravity; }

}  // namespace fitroom::paper
