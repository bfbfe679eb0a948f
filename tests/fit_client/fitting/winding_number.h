#pragma once

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom::testing {

// Returns how often a closed mesh winds round `point`: 1 inside, 0 outside. The sum of the triangles' solid angles over
// 4 pi (van Oosterom and Strackee 1983): slow, exact, and nothing the fit itself uses.
double WindingNumber(const TriangleMesh& closed, const Eigen::Vector3d& point);

}  // namespace fitroom::testing
