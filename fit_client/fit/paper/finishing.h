#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom::paper {

// The foot of the normal that leads from the body's surface to a point: the surface's nearest place.
struct FootOfNormal {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  double signed_distance = 0.0;  // Negative inside the body (unit: metre).
};

// Returns the foot for `point` by looking at every triangle of `body`, which must not be empty.
FootOfNormal FindFootOfNormal(const TriangleMesh& body, const Eigen::Vector3d& point);

// Equation (6): a top is done when ||dd|| < epsilon, dd = N - p_i, for every shoulder-sleeve point p_i, with N the foot
// of the normal. The distances are signed: a point inside the body counts as being there. True for no points.
bool TopIsDone(std::span<const double> signed_distances, double epsilon);

// Equation (6) to the letter, with N a unit normal: subtracts a place from a direction. Depends on where the origin is,
// which is why it cannot be meant.
double DistanceToTheLetter(const Eigen::Vector3d& unit_normal, const Eigen::Vector3d& point);

// Returns the length of a chain of places (unit: metre).
double ChainLength(std::span<const Eigen::Vector3d> chain);

// Equation (11): a bottom is done when ||dd1|| + ||dd2|| < epsilon, dd = l0 - lr, with the rest lengths and the present
// lengths of the outseams e1-e2 and e3-e4 (unit: metre).
bool BottomIsDone(const std::array<double, 2>& rest_lengths, const std::array<double, 2>& lengths, double epsilon);

// The rest that both profiles wait for after the method's own condition.
struct RestOptions {
  double speed = 0.018;  // 0.03 cm per 1/60 s (unit: m/s).
  double share = 0.985;  // Part of the particles that must be slower.
  int windows = 3;       // Sixtieths of a second for which it must hold, or a hem's turning point would count.
};

// Returns the speeds of all particles, from how far they came in `seconds` (unit: m/s).
std::vector<double> MeanSpeeds(std::span<const Eigen::Vector3d> before, std::span<const Eigen::Vector3d> after,
                               double seconds);

// Returns the part of the speeds that is below `rest_speed`; 1 for no speeds.
double ShareAtRest(std::span<const double> speeds, double rest_speed);

}  // namespace fitroom::paper
