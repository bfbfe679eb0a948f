#pragma once

#include "body_center/scan/implicit_solid.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom::body_center {

// Returns the surface of `solid` as a mesh of nearly even triangles, about `spacing` apart (unit: metre): one vertex a
// grid cell that the surface crosses, one quadrilateral a crossed grid edge, split along its shorter diagonal; the
// vertices are then evened out along the surface and put back on it.
//
//      +-------+-------+        surface nets (Gibson 1998), the dual of marching cubes: a vertex lies inside its
//      |   o---|---o   |        cell, where it can be moved freely, so that there are no sliver triangles.
//      +---|---+---|---+
//      |   o---|---o   |
//      +-------+-------+
//
// Closed, every edge in two triangles, where the solid is closed and no thinner than the grid. Deterministic.
TriangleMesh PolygoniseSurface(const ImplicitSolid& solid, double spacing);

}  // namespace fitroom::body_center
