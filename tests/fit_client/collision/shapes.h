#pragma once

#include "common/geometry/triangle_mesh.h"

namespace fitroom::testing {

// Closed, outward-facing test bodies with known distances.
// A sphere from a subdivided icosahedron; vertices lie on the sphere.
TriangleMesh MakeSphere(const Eigen::Vector3d& centre, double radius, int subdivisions);
// An axis-aligned box, each face cut into `cuts` x `cuts` squares of two triangles.
TriangleMesh MakeBox(const Eigen::AlignedBox3d& box, int cuts);
// A torus round the y axis.
TriangleMesh MakeTorus(double ring_radius, double tube_radius, int ring_count, int tube_count);
// A closed cylinder along y from `low` to `high`.
TriangleMesh MakeCylinder(double radius, double low, double high, int around, int along);

}  // namespace fitroom::testing
