#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom::paper {

// In which voxels a polygon of the body is registered.
enum class Registration {
  kCentroid,  // In the one that holds its centroid, as printed. Misses what reaches into a neighbour.
  kOverlap,   // In every voxel that its bounding box overlaps.
};

// The body's bounding box cut into equal voxels, densely stored, each with the list of the polygons registered in it.
// Immutable; owns its lists, not the body.
class VoxelGrid {
 public:
  // Most voxels that a grid may have: a body at 2.5 mm, a quarter of a gigabyte.
  static constexpr int64_t kLargestVoxelCount = int64_t{1} << 26;

  // Registers the triangles of `body` in voxels of side `voxel_size` (unit: metre). With kOverlap the triangles' boxes
  // are grown by `margin`, so that contact at an offset is seen. INVALID_ARGUMENT for an empty or non-finite body or a
  // size that is not positive; RESOURCE_EXHAUSTED (TOO_MANY_VOXELS) above kLargestVoxelCount.
  static Result<VoxelGrid> Build(const TriangleMesh& body, double voxel_size, Registration registration, double margin);

  // Returns the triangles registered in the voxel that holds `point`; none outside of the grid.
  std::span<const int32_t> TrianglesAt(const Eigen::Vector3d& point) const;
  // Returns the index of the voxel that holds `point`, or -1 outside of the grid.
  int64_t VoxelOf(const Eigen::Vector3d& point) const;

  double voxel_size() const { return voxel_size_; }
  const Eigen::Array3i& counts() const { return counts_; }

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double voxel_size_ = 0.0;
  Eigen::Array3i counts_ = Eigen::Array3i::Zero();
  std::vector<int32_t> begin_;  // Into triangles_; one more than voxels.
  std::vector<int32_t> triangles_;
};

}  // namespace fitroom::paper
