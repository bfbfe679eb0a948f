#include "fit_client/fit/collision/surface_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit_client/fit/collision/half_edges.h"
#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom {
namespace {

// The angle at the corner between two sides, within 1e-3 rad: a weight, not a measurement.
float AngleBetween(const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
  const float scale = std::sqrt(u.squaredNorm() * v.squaredNorm());
  if (!(scale > 0.0F)) return 0.0F;
  return std::acos(std::clamp(u.dot(v) / scale, -1.0F, 1.0F));
}

}  // namespace

SurfaceTriangles::SurfaceTriangles(const TriangleMesh& body, const Eigen::AlignedBox3d& region, double margin) {
  const Eigen::Vector3d origin = region.min();
  const Eigen::Array3f low = Eigen::Array3f::Constant(static_cast<float>(-margin));
  const Eigen::Array3f high = region.sizes().cast<float>().array() + static_cast<float>(margin);
  std::vector<int32_t> new_index(body.vertices.size(), -1);
  std::vector<Eigen::Vector3f> local;
  local.reserve(body.vertices.size());
  for (const Eigen::Vector3d& vertex : body.vertices) local.push_back((vertex - origin).cast<float>());
  for (const Eigen::Vector3i& triangle : body.triangles) {
    const Eigen::Vector3f& a = local[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3f& b = local[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3f& c = local[static_cast<size_t>(triangle[2])];
    const Eigen::Vector3f triangle_low = a.cwiseMin(b).cwiseMin(c);
    const Eigen::Vector3f triangle_high = a.cwiseMax(b).cwiseMax(c);
    if ((triangle_high.array() < low).any() || (triangle_low.array() > high).any()) continue;
    const Eigen::Vector3f centre = 0.5F * (triangle_low + triangle_high);
    const float squared_radius =
        std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()});
    balls_.emplace_back(centre.x(), centre.y(), centre.z(), std::sqrt(squared_radius));
    Eigen::Vector3i kept;
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& index = new_index[static_cast<size_t>(triangle[corner])];
      if (index < 0) {
        index = static_cast<int32_t>(vertices_.size());
        vertices_.push_back(local[static_cast<size_t>(triangle[corner])]);
      }
      kept[corner] = index;
    }
    triangles_.push_back(kept);
  }
  ComputeNormals();
}

void SurfaceTriangles::ComputeNormals() {
  twins_ = FindTwins(triangles_, vertices_.size());
  vertex_normals_.assign(vertices_.size(), Eigen::Vector3f::Zero());
  face_normals_.reserve(triangles_.size());
  for (size_t index = 0; index < triangles_.size(); ++index) {
    const Eigen::Vector3f& a = Corner(index, 0);
    const Eigen::Vector3f& b = Corner(index, 1);
    const Eigen::Vector3f& c = Corner(index, 2);
    const Eigen::Vector3f normal = (b - a).cross(c - a).normalized();
    face_normals_.push_back(normal);
    const float angle_a = AngleBetween(b - a, c - a);
    const float angle_b = AngleBetween(c - b, a - b);
    const float angle_c = std::max(0.0F, static_cast<float>(M_PI) - angle_a - angle_b);
    vertex_normals_[static_cast<size_t>(triangles_[index][0])] += normal * angle_a;
    vertex_normals_[static_cast<size_t>(triangles_[index][1])] += normal * angle_b;
    vertex_normals_[static_cast<size_t>(triangles_[index][2])] += normal * angle_c;
  }
}

SurfaceTriangles::Offset SurfaceTriangles::OffsetFrom(size_t triangle, const Eigen::Vector3f& point) const {
  const ClosestPoint<float> closest =
      ClosestPointOnTriangle<float>(point, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2));
  Eigen::Vector3f normal = face_normals_[triangle];
  const int feature = static_cast<int>(closest.feature);
  if (feature < 3) {
    normal = vertex_normals_[static_cast<size_t>(triangles_[triangle][feature])];
  } else if (closest.feature != TriangleFeature::kFace) {
    const int32_t twin = twins_[3 * triangle + static_cast<size_t>(feature - 3)];
    if (twin >= 0) normal += face_normals_[static_cast<size_t>(twin / 3)];
  }
  const Eigen::Vector3f way = point - closest.point;
  return {way.squaredNorm(), normal.dot(way) < 0.0F};
}

float SurfaceTriangles::SquaredDistance(size_t triangle, const Eigen::Vector3f& point, float limit) const {
  const Eigen::Vector4f& ball = balls_[triangle];
  const float reach = limit + ball[3];
  if ((point - ball.head<3>()).squaredNorm() > reach * reach) return std::numeric_limits<float>::infinity();
  const ClosestPoint<float> closest =
      ClosestPointOnTriangle<float>(point, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2));
  return (point - closest.point).squaredNorm();
}

size_t SurfaceTriangles::memory_size() const {
  return (vertices_.size() + vertex_normals_.size() + face_normals_.size()) * sizeof(Eigen::Vector3f) +
         triangles_.size() * sizeof(Eigen::Vector3i) + balls_.size() * sizeof(Eigen::Vector4f) +
         twins_.size() * sizeof(int32_t);
}

}  // namespace fitroom
