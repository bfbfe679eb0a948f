#include "fit_client/fit/paper/collision_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom::paper {

Eigen::Vector3d InelasticVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& normal) {
  const double normal_speed = velocity.dot(normal);
  if (normal_speed >= 0.0) return velocity;
  return velocity - normal_speed * normal;
}

Result<BodyCollider> BodyCollider::Build(const TriangleMesh& body, double cloth_pitch,
                                         const CollisionOptions& options) {
  // A polygon in the border between two voxels has the particles that it is to stop in the voxel behind it.
  constexpr double kLeastMargin = 0.25;  // (unit: voxel)
  const double voxel_size = 0.5 * cloth_pitch;
  const double margin = std::max(options.contact_offset, kLeastMargin * voxel_size);
  FR_ASSIGN_OR_RETURN(VoxelGrid grid, VoxelGrid::Build(body, voxel_size, options.registration, margin));
  return BodyCollider(body, std::move(grid), options);
}

BodyCollider::BodyCollider(TriangleMesh body, VoxelGrid grid, const CollisionOptions& options)
    : body_(std::move(body)), grid_(std::move(grid)), options_(options) {
  normals_.reserve(body_.triangles.size());
  for (size_t triangle = 0; triangle < body_.triangles.size(); ++triangle) {
    const int32_t index = static_cast<int32_t>(triangle);
    const Eigen::Vector3d normal = (Corner(index, 1) - Corner(index, 0)).cross(Corner(index, 2) - Corner(index, 0));
    const double length = normal.norm();
    normals_.push_back(length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  }
}

const Eigen::Vector3d& BodyCollider::Corner(int32_t triangle, int corner) const {
  return body_.vertices[static_cast<size_t>(body_.triangles[static_cast<size_t>(triangle)][corner])];
}

double BodyCollider::PlaneDistance(int32_t triangle, const Eigen::Vector3d& point) const {
  return normals_[static_cast<size_t>(triangle)].dot(point - Corner(triangle, 0));
}

std::optional<BodyContact> BodyCollider::NearestBehind(std::span<const int32_t> triangles,
                                                       const Eigen::Vector3d& to) const {
  // In front of every plane is in front of the nearest polygon.
  const bool may_touch = std::any_of(triangles.begin(), triangles.end(), [&](int32_t triangle) {
    return PlaneDistance(triangle, to) < options_.contact_offset;
  });
  if (!may_touch) return std::nullopt;
  double nearest = std::numeric_limits<double>::infinity();
  double largest_plane_distance = 0.0;
  BodyContact contact;
  for (const int32_t triangle : triangles) {
    if (normals_[static_cast<size_t>(triangle)].isZero()) continue;
    const Eigen::Vector3d foot =
        ClosestPointOnTriangle<double>(to, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2)).point;
    const double distance = (to - foot).norm();
    const double plane_distance = PlaneDistance(triangle, to);
    // Polygons that share the nearest edge or corner are equally near; the one that faces the point most has the sign.
    const bool is_tied = distance < nearest + 1e-9 && std::abs(plane_distance) > largest_plane_distance;
    if (distance < nearest - 1e-9 || is_tied) {
      nearest = std::min(nearest, distance);
      largest_plane_distance = std::abs(plane_distance);
      contact = {normals_[static_cast<size_t>(triangle)], std::copysign(distance, plane_distance)};
    }
  }
  if (contact.distance >= options_.contact_offset) return std::nullopt;
  return contact;
}

std::optional<BodyContact> BodyCollider::FirstCrossed(std::span<const int32_t> triangles, const Eigen::Vector3d& from,
                                                      const Eigen::Vector3d& to) const {
  double first = std::numeric_limits<double>::infinity();
  std::optional<BodyContact> contact;
  for (const int32_t triangle : triangles) {
    const double before = PlaneDistance(triangle, from);
    const double after = PlaneDistance(triangle, to);
    if (before < 0.0 || after >= 0.0) continue;
    const double t = before / (before - after);
    if (t < first && SegmentCrossesTriangle(from, to, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2))) {
      first = t;
      contact = BodyContact{normals_[static_cast<size_t>(triangle)], after};
    }
  }
  return contact;
}

std::optional<BodyContact> BodyCollider::FindContact(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const std::span<const int32_t> here = grid_.TrianglesAt(to);
  if (options_.swept) {
    for (const std::span<const int32_t> triangles : {here, grid_.TrianglesAt(from)}) {
      if (std::optional<BodyContact> crossed = FirstCrossed(triangles, from, to)) return crossed;
    }
  }
  if (here.empty()) return std::nullopt;
  return NearestBehind(here, to);
}

}  // namespace fitroom::paper
