#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"

namespace fitroom::panels {

// Triangulates the inside of a simple polygon together with points inside it: the constrained Delaunay triangulation,
// that is, every side of the polygon is an edge, and the circle of a triangle holds no point that can be seen from it.
// `points` (unit: metre, within ±4 m): first the polygon's `polygon_count` corners, counter-clockwise, then the points
// inside. Returns counter-clockwise triangles; no point is added or moved.
// Fails with INVALID_ARGUMENT: TOO_FEW_POINTS, POINT_OUT_OF_RANGE (not finite, too far out), DUPLICATE_POINT (two
// points within 60 nm), CROSSING_OUTLINE (the polygon meets itself or passes through a point).
Result<std::vector<Eigen::Vector3i>> TriangulatePolygon(std::span<const Eigen::Vector2d> points, int polygon_count);

}  // namespace fitroom::panels
