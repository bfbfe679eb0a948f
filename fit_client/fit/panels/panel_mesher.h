#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/panels/mesh_size.h"

namespace fitroom::panels {

// A triangulated panel. The outline's samples come first, as given; then the points inside.
struct PanelMesh {
  std::vector<Eigen::Vector2d> points;     // (unit: metre)
  std::vector<Eigen::Vector3i> triangles;  // Counter-clockwise.
};

// Fills a counter-clockwise outline, sampled about as `size` says, with triangles of about that size: an equilateral
// lattice that mirrors itself at x = 0, each finer one holding the coarser ones, joined to the outline by a constrained
// Delaunay triangulation and smoothed where the two meet. `sewn` says of each sample of the outline whether it is sewn
// to the other panel: no inner edge joins two of these, because both panels may have it and sewn up the two would be
// one edge with four triangles. Fails as TriangulatePolygon().
Result<PanelMesh> MeshPanel(std::span<const Eigen::Vector2d> outline, const std::vector<bool>& sewn,
                            const MeshSize& size);

}  // namespace fitroom::panels
