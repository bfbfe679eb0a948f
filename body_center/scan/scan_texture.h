#pragma once

#include <vector>

#include <Eigen/Core>

#include "body_center/scan/implicit_solid.h"
#include "common/geometry/triangle_mesh.h"
#include "common/image/image.h"

namespace fitroom::body_center {

// A picture for a mesh: the left half is the body from the front, the right half from behind, each in parallel
// projection. A triangle takes the half that its normal faces.
struct ScanTexture {
  std::vector<Eigen::Vector2f> coordinates;  // (u, v), v upwards, 0 to 1.
  std::vector<Eigen::Vector3i> triangles;    // For each triangle of the mesh, indices into `coordinates`.
  Image image;                               // RGB.
};

// Paints a figure of the reference stature (canonical frame, metres): skin, face, and what people wear in a scanner:
// cap, top and shorts. `solid` tells arms from trunk. `seed` varies the mottling of the skin.
ScanTexture PaintScanTexture(const TriangleMesh& mesh, const ImplicitSolid& solid, uint64_t seed);

}  // namespace fitroom::body_center
