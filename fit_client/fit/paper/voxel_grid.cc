#include "fit_client/fit/paper/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace fitroom::paper {
namespace {

constexpr double kLargestCoordinate = 100.0;  // (unit: metre)

Status CheckBody(const TriangleMesh& body, double voxel_size) {
  if (body.triangles.empty()) return InvalidArgument("BODY_EMPTY", "the body has no triangles");
  if (!(voxel_size > 0.0)) return InvalidArgument("VOXEL_SIZE", "the side of a voxel must be positive");
  for (const Eigen::Vector3d& vertex : body.vertices) {
    if (!vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > kLargestCoordinate) {
      return InvalidArgument("BODY_NOT_FINITE", "a vertex of the body is not finite or over 100 m away");
    }
  }
  for (const Eigen::Vector3i& triangle : body.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= static_cast<int>(body.vertices.size())) {
      return InvalidArgument("BODY_INDEX_OUT_OF_RANGE", "a triangle of the body names a vertex that does not exist");
    }
  }
  return Status();
}

// The part of space in whose voxels a triangle is registered: a point, its centroid, or its box.
Eigen::AlignedBox3d RegisteredBox(const TriangleMesh& body, const Eigen::Vector3i& triangle, Registration registration,
                                  double margin) {
  const Eigen::Vector3d& a = body.vertices[static_cast<size_t>(triangle[0])];
  const Eigen::Vector3d& b = body.vertices[static_cast<size_t>(triangle[1])];
  const Eigen::Vector3d& c = body.vertices[static_cast<size_t>(triangle[2])];
  if (registration == Registration::kCentroid) return Eigen::AlignedBox3d(Eigen::Vector3d((a + b + c) / 3.0));
  Eigen::AlignedBox3d box(a);
  box.extend(b);
  box.extend(c);
  const Eigen::Vector3d grown = Eigen::Vector3d::Constant(margin);
  return Eigen::AlignedBox3d(box.min() - grown, box.max() + grown);
}

}  // namespace

Result<VoxelGrid> VoxelGrid::Build(const TriangleMesh& body, double voxel_size, Registration registration,
                                   double margin) {
  FR_RETURN_IF_ERROR(CheckBody(body, voxel_size));
  const Eigen::AlignedBox3d bounds = ComputeBounds(body);
  // One voxel of air all round, so that what touches the body from outside lies in the grid.
  const double air = voxel_size + margin;
  const Eigen::Array3d sizes = ((bounds.sizes().array() + 2.0 * air) / voxel_size).ceil();
  if (sizes.prod() > static_cast<double>(kLargestVoxelCount)) {
    return ResourceExhausted("TOO_MANY_VOXELS",
                             "a dense grid of voxels this small would not fit into memory; use a "
                             "coarser mesh for the cloth");
  }
  VoxelGrid grid;
  grid.voxel_size_ = voxel_size;
  grid.origin_ = bounds.min() - Eigen::Vector3d::Constant(air);
  grid.counts_ = sizes.cast<int>();
  const auto for_each_voxel = [&](const Eigen::Vector3i& triangle, const auto& visit) {
    const Eigen::AlignedBox3d box = RegisteredBox(body, triangle, registration, margin);
    const Eigen::Array3i low = ((box.min() - grid.origin_) / voxel_size).array().floor().cast<int>().max(0);
    const Eigen::Array3i high =
        ((box.max() - grid.origin_) / voxel_size).array().floor().cast<int>().min(grid.counts_ - 1);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          visit(static_cast<size_t>(x) +
                static_cast<size_t>(grid.counts_.x()) *
                    (static_cast<size_t>(y) + static_cast<size_t>(grid.counts_.y()) * static_cast<size_t>(z)));
        }
      }
    }
  };
  grid.begin_.assign(static_cast<size_t>(sizes.prod()) + 1, 0);
  int64_t entry_count = 0;
  for (const Eigen::Vector3i& triangle : body.triangles) {
    for_each_voxel(triangle, [&](size_t voxel) {
      ++grid.begin_[voxel + 1];
      ++entry_count;
    });
    if (entry_count > kLargestVoxelCount) {
      return ResourceExhausted("TOO_MANY_VOXELS", "the body's triangles reach over too many voxels");
    }
  }
  for (size_t voxel = 1; voxel < grid.begin_.size(); ++voxel) grid.begin_[voxel] += grid.begin_[voxel - 1];
  grid.triangles_.resize(static_cast<size_t>(grid.begin_.back()));
  std::vector<int32_t> next(grid.begin_.begin(), grid.begin_.end() - 1);
  for (size_t index = 0; index < body.triangles.size(); ++index) {
    for_each_voxel(body.triangles[index], [&](size_t voxel) {
      grid.triangles_[static_cast<size_t>(next[voxel]++)] = static_cast<int32_t>(index);
    });
  }
  return grid;
}

int64_t VoxelGrid::VoxelOf(const Eigen::Vector3d& point) const {
  const Eigen::Array3d cell = ((point - origin_) / voxel_size_).array().floor();
  if (!(cell >= 0.0).all() || !(cell < counts_.cast<double>()).all()) return -1;
  return static_cast<int64_t>(cell.x()) +
         counts_.x() * (static_cast<int64_t>(cell.y()) + counts_.y() * static_cast<int64_t>(cell.z()));
}

std::span<const int32_t> VoxelGrid::TrianglesAt(const Eigen::Vector3d& point) const {
  const int64_t voxel = VoxelOf(point);
  if (voxel < 0) return {};
  const size_t begin = static_cast<size_t>(begin_[static_cast<size_t>(voxel)]);
  const size_t end = static_cast<size_t>(begin_[static_cast<size_t>(voxel) + 1]);
  return std::span<const int32_t>(triangles_).subspan(begin, end - begin);
}

}  // namespace fitroom::paper
