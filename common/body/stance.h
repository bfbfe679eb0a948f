#pragma once

#include <string>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// How a body stands in a mesh, in the mesh's own frame and unit.
struct Stance {
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();  // Unit, perpendicular to `up`.
  Eigen::Vector3d floor_centre =
      Eigen::Vector3d::Zero();  // Below the middle of the trunk, at the lowest point's height.
  double stature = 0.0;         // The extent along `up`.
  std::string up_reason;        // What the shape showed, for people.
  std::string facing_reason;
};

// Reads the sections along `up`: two legs at the bottom, one trunk above them, one head at the top, toes in front of
// the ankles. Tries both signs of `up` unless the sign is known. NOT_A_BODY names the first thing that is missing;
// SEVERAL_BODIES where there are more legs and heads than one body has.
Result<Stance> FindStanceAlong(const TriangleMesh& mesh, const Eigen::Vector3d& up, bool sign_is_known);

}  // namespace fitroom
