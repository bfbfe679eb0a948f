#include "common/geometry/triangle_mesh.h"

namespace fitroom {

Eigen::AlignedBox3d ComputeBounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  return bounds;
}

std::vector<Eigen::Vector3d> ComputeVertexNormals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3d& b = mesh.vertices[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3d& c = mesh.vertices[static_cast<size_t>(triangle[2])];
    const Eigen::Vector3d twice_area_normal = (b - a).cross(c - a);
    for (const int corner : triangle) normals[static_cast<size_t>(corner)] += twice_area_normal;
  }
  for (Eigen::Vector3d& normal : normals) {
    const double length = normal.norm();
    if (length > 0.0) normal /= length;
  }
  return normals;
}

}  // namespace fitroom
