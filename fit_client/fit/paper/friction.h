#pragma once

#include <Eigen/Core>

namespace fitroom::paper {

// Which way the axes of the caller's frame point. The body's canonical frame is Y up and faces +Z; in the method's
// files, as 3D Studio Max writes them, Z is up.
struct PaperFrame {
  int across = 0;            // Axis from one side of the body to the other.
  int up = 1;                // Axis that points away from the floor.
  int depth = 2;             // Axis through front and back.
  double front_sign = +1.0;  // Which way along `depth` the body faces.

  static PaperFrame YUp() { return {}; }
  static PaperFrame ZUp() { return {0, 2, 1, -1.0}; }

  Eigen::Vector3d Up() const { return Eigen::Vector3d::Unit(up); }
  Eigen::Vector3d Front() const { return front_sign * Eigen::Vector3d::Unit(depth); }
};

// The two readings of "along x-z only".
enum class FrictionAxes {
  kFrontalPlane,  // The file's x and z where z is up: across and upwards. Can brake cloth that slides down.
  kGroundPlane,   // x and z where y is up: across and depth. Does nothing against sliding down.
};

// The method's coefficient (unit: N s/m a particle): negative, against the motion.
inline constexpr double kPrintedFrictionFactor = -0.01;

// Equation (4): f = mu v, along two axes of the file's frame, on a particle that collides (the caller's decision). The
// third component is exactly zero. A drag: it holds nothing at rest, and does not know how hard the cloth is pressed.
Eigen::Vector3d FrictionForce(const Eigen::Vector3d& velocity, double factor, const PaperFrame& frame,
                              FrictionAxes axes);

// What (4) is not, for comparison: Coulomb's friction at an inelastic contact that took `normal_speed` from the
// particle. Returns the tangential velocity less at most `coefficient` times that.
Eigen::Vector3d CoulombSlowed(const Eigen::Vector3d& tangential_velocity, double normal_speed, double coefficient);

}  // namespace fitroom::paper
