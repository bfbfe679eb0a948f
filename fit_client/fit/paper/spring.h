#pragma once

#include <Eigen/Core>

namespace fitroom::paper {

// How equation (1) is read.
enum class SpringLaw {
  kPrinted,  // f = -k | ||dp|| - l | u: the bars make a compressed spring pull too.
  kSigned,   // f = -k (||dp|| - l) u: a compressed spring pushes.
};

// A spring between two particles with its damper, both along the line that joins them.
struct SpringConstants {
  double stiffness = 0.0;  // k (unit: N/m)
  double damping = 0.0;    // k_d (unit: N s/m)
};

// Equation (1): the force of one spring on particle i, with dp = p_i - p_j, dv = v_i - v_j and u = dp / ||dp||:
//   printed   f = -k || dp - l || (dp / ||dp||) - k_d dv (dp / ||dp||).
// A length cannot be taken from a vector and two vectors cannot be multiplied, so that dp - l is read as ||dp|| - l,
// and k_d dv u as the dot product times the direction, k_d (dv . u) u. The force on j is the opposite. Zero where both
// particles lie on one place, because there is no direction then.
Eigen::Vector3d SpringForce(const Eigen::Vector3d& dp, const Eigen::Vector3d& dv, double rest_length,
                            const SpringConstants& constants, SpringLaw law);

}  // namespace fitroom::paper
