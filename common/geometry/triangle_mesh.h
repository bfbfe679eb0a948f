#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fitroom {

// An indexed triangle mesh. Vertices in metres unless a caller says otherwise; triangles are counter-clockwise seen
// from outside. May have holes, duplicate and non-manifold triangles: a laser scan does.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

// Returns the smallest axis-aligned box round all vertices; an empty box for no vertices.
Eigen::AlignedBox3d ComputeBounds(const TriangleMesh& mesh);

// Returns one area-weighted unit normal a vertex; zero where no triangle of positive area meets the vertex.
std::vector<Eigen::Vector3d> ComputeVertexNormals(const TriangleMesh& mesh);

}  // namespace fitroom
