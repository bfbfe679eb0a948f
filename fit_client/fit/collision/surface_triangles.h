#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// The triangles of a closed surface in single precision about an origin, with the normals that tell inside from outside
// (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal", 2005): a triangle's own
// in its interior, the sum of both neighbours' on an edge, the angle-weighted sum round a vertex. Immutable.
class SurfaceTriangles {
 public:
  // A point's place against one triangle.
  struct Offset {
    float squared_distance = 0.0F;  // (unit: m^2)
    bool is_inside = false;         // Behind the surface, if this is the closest triangle.
  };

  SurfaceTriangles() = default;
  // Takes the triangles of `body` that come within `margin` of `region`; the origin is the region's minimum.
  SurfaceTriangles(const TriangleMesh& body, const Eigen::AlignedBox3d& region, double margin);

  size_t size() const { return triangles_.size(); }
  const Eigen::Vector3f& Corner(size_t triangle, int corner) const {
    return vertices_[static_cast<size_t>(triangles_[triangle][corner])];
  }
  // Returns where `point` lies against a triangle, by the triangle's feature that is closest to it.
  Offset OffsetFrom(size_t triangle, const Eigen::Vector3f& point) const;
  // Returns only the squared distance; says no more than "further than `limit`" beyond that distance, which is quick.
  float SquaredDistance(size_t triangle, const Eigen::Vector3f& point, float limit) const;

  size_t memory_size() const;

 private:
  void ComputeNormals();

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<Eigen::Vector4f> balls_;  // One a triangle: centre and radius of a ball round it.
  std::vector<Eigen::Vector3f> face_normals_;
  std::vector<Eigen::Vector3f> vertex_normals_;
  std::vector<int32_t> twins_;  // See FindTwins().
};

}  // namespace fitroom
