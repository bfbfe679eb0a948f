#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// The largest gap that MeasureGaps() tells apart; more counts as this much (unit: metre).
inline constexpr double kLargestGap = 0.06;

// Returns how far each position is from the surface of a mesh, holes or not, at most kLargestGap (unit: metre). For
// cloth that is known to lie outside: the distance has no sign. Positions that are not finite get kLargestGap; a mesh
// whose triangles are far larger than a body's gives an empty list.
std::vector<double> MeasureGaps(const TriangleMesh& body, const std::vector<Eigen::Vector3d>& positions);

}  // namespace fitroom
