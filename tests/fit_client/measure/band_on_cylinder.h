#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// A band of cloth round an upright cylinder: two panels of equilateral triangles, sewn at both sides, at rest flat.
// All lengths in metres.
struct Band {
  ClothMesh cloth;
  std::vector<Eigen::Vector3d> worn;  // On a cylinder of the given radius round the Y axis, middle at y = 1.
};

// Makes a band whose rest girth is 2 pi radius / (1 + strain) and whose worn width is its rest width times
// (1 + strain_across). Triangles of about `pitch`.
Band MakeBand(double radius, double width, double strain, double strain_across, double pitch);

// A closed cylinder round the Y axis, from y = 0.7 to y = 1.3, outward-facing.
TriangleMesh MakeCylinder(double radius);

}  // namespace fitroom
