#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/paper/voxel_grid.h"

namespace fitroom::paper {

// The collision rule: inelastic, "only the horizontal component remains", horizontal along the polygon. Returns
// v - (v . n) n where v goes into the surface, v . n < 0, and v elsewhere. `normal` has unit length.
Eigen::Vector3d InelasticVelocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& normal);

// How a particle is found to touch the body, and where it is kept.
struct CollisionOptions {
  Registration registration = Registration::kCentroid;
  bool swept = false;           // Also look at where the particle comes from, and for polygons that it passes through.
  double contact_offset = 0.0;  // Printed: none, velocities alone are corrected. Else cloth is put this far outside.
};

// Where a particle touches the body.
struct BodyContact {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Of the polygon, outwards; unit length.
  double distance = 0.0;                             // Signed, of the looked-up place: negative inside (unit: metre).
};

// The body as the method collides with it: polygons found by the voxel in which a particle is. Immutable; owns a copy
// of the body. Safe to read from several threads.
class BodyCollider {
 public:
  // Voxels get half of `cloth_pitch`, the mean edge of the cloth (unit: metre). Fails like VoxelGrid::Build().
  static Result<BodyCollider> Build(const TriangleMesh& body, double cloth_pitch, const CollisionOptions& options);

  // Looks at a particle that is about to move from `from` to `to`: it touches where the nearest polygon registered in
  // the voxel of `to` has it behind itself, or nearer than the contact offset.
  std::optional<BodyContact> FindContact(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  const VoxelGrid& grid() const { return grid_; }
  double contact_offset() const { return options_.contact_offset; }

 private:
  BodyCollider(TriangleMesh body, VoxelGrid grid, const CollisionOptions& options);
  double PlaneDistance(int32_t triangle, const Eigen::Vector3d& point) const;
  const Eigen::Vector3d& Corner(int32_t triangle, int corner) const;
  std::optional<BodyContact> NearestBehind(std::span<const int32_t> triangles, const Eigen::Vector3d& to) const;
  std::optional<BodyContact> FirstCrossed(std::span<const int32_t> triangles, const Eigen::Vector3d& from,
                                          const Eigen::Vector3d& to) const;

  TriangleMesh body_;
  VoxelGrid grid_;
  CollisionOptions options_;
  std::vector<Eigen::Vector3d> normals_;  // One a triangle; zero for one without area.
};

}  // namespace fitroom::paper
