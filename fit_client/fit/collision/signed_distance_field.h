#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/collision/surface_triangles.h"

namespace fitroom {

struct SignedDistanceFieldOptions {
  // Distance between samples near the surface (unit: metre). Trilinear interpolation errs by about pitch^2 / (8 R) on a
  // surface of radius R: 0.2 mm for 4 mm on a 1 cm finger. Below 2 mm the field grows past the cache without a gain.
  double pitch = 0.004;
  // Only this part of space gets the accurate field; everything that touches cloth must lie in it. Without it: the
  // body's bounds. Queries outside are answered by the nearest point of the region plus the way there.
  std::optional<Eigen::AlignedBox3d> region;
};

// The signed distance to a closed surface: negative inside, in metres, in the frame of the mesh.
// Near the surface (within 8 mm and more) samples on bricks of 8 x 8 x 8 cells hold the exact distance; the rest of the
// region is covered by a grid of four times the pitch whose distances come from the closest triangle known to a
// neighbour: right to a few tenths of a millimetre, which only decides whether contact may be skipped.
// Immutable after Build(); safe to query from several threads. Owns its samples and a copy of the surface's triangles.
class SignedDistanceField {
 public:
  struct Sample {
    double distance = 0.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // Not normalised; length near 1 but at ridges.
  };

  // Builds the field of a closed, outward-facing mesh (see RepairBody). The same field for any executor.
  // INVALID_ARGUMENT for no triangles, non-finite or enormous coordinates (over 10 m), or indices out of range;
  // RESOURCE_EXHAUSTED where the region would need more than 2^24 coarse nodes.
  static Result<SignedDistanceField> Build(const TriangleMesh& body, const SignedDistanceFieldOptions& options,
                                           Executor& executor);

  // Adds another body: from now on the distance is that to the nearer of both, which is right outside of the two
  // together, and negative inside of either. The region stays this field's own.
  void Unite(SignedDistanceField other) { united_.push_back(std::move(other)); }

  // Lays a level floor that nothing can fall through: from now on the distance is at most the height above it, and
  // negative below (unit: metre, along y).
  void LayFloor(double height) { floor_ = height; }

  // Returns the interpolated signed distance at `point`.
  double Distance(const Eigen::Vector3d& point) const { return Query(point).distance; }
  // Returns the interpolated signed distance at `point` and its gradient.
  Sample Query(const Eigen::Vector3d& point) const {
    Sample nearest = QueryAlone(point);
    for (const SignedDistanceField& other : united_) {
      const Sample sample = other.Query(point);
      if (sample.distance < nearest.distance) nearest = sample;
    }
    if (point.y() - floor_ < nearest.distance) nearest = {point.y() - floor_, Eigen::Vector3d::UnitY()};
    return nearest;
  }
  // Returns the distance from the triangles themselves where `point` is within about 5 mm of the surface, and the
  // interpolated distance elsewhere.
  double ExactDistance(const Eigen::Vector3d& point) const {
    double nearest = std::min(ExactDistanceAlone(point), point.y() - floor_);
    for (const SignedDistanceField& other : united_) nearest = std::min(nearest, other.ExactDistance(point));
    return nearest;
  }

  double pitch() const { return pitch_; }
  const Eigen::AlignedBox3d& region() const { return region_; }
  size_t brick_count() const { return brick_samples_.size() / kBrickSampleCount; }
  // Bytes held by samples, indices and triangles.
  size_t memory_size() const;

 private:
  friend class SignedDistanceFieldBuilder;

  static constexpr int kBrickCells = 8;                // Cells along a brick's edge.
  static constexpr int kBrickNodes = kBrickCells + 1;  // Samples along a brick's edge; borders are stored twice.
  static constexpr int kBrickSampleCount = kBrickNodes * kBrickNodes * kBrickNodes;
  static constexpr int kCoarsePerBrick = 2;  // Coarse cells along a brick's edge.

  SignedDistanceField() = default;

  // Of this body without the united ones.
  Sample QueryAlone(const Eigen::Vector3d& point) const;
  double ExactDistanceAlone(const Eigen::Vector3d& point) const;

  size_t BrickIndex(const Eigen::Vector3i& brick) const {
    return static_cast<size_t>(brick.x()) +
           static_cast<size_t>(brick_count_.x()) *
               (static_cast<size_t>(brick.y()) +
                static_cast<size_t>(brick_count_.y()) * static_cast<size_t>(brick.z()));
  }
  size_t CoarseIndex(const Eigen::Vector3i& node) const {
    return static_cast<size_t>(node.x()) +
           static_cast<size_t>(coarse_count_.x()) *
               (static_cast<size_t>(node.y()) + static_cast<size_t>(coarse_count_.y()) * static_cast<size_t>(node.z()));
  }

  double pitch_ = 0.0;
  Eigen::AlignedBox3d region_;
  Eigen::Vector3i brick_count_ = Eigen::Vector3i::Zero();
  Eigen::Vector3i coarse_count_ = Eigen::Vector3i::Zero();
  std::vector<int32_t> brick_slot_;    // Per brick of the region: its slot among the stored ones, or -1.
  std::vector<float> brick_samples_;   // kBrickSampleCount per slot, x fastest (unit: metre).
  std::vector<float> coarse_samples_;  // Per coarse node, x fastest (unit: metre).

  // For ExactDistance: the triangles near each stored brick.
  SurfaceTriangles surface_;
  std::vector<uint32_t> brick_triangles_begin_;  // Per slot, plus one.
  std::vector<uint32_t> brick_triangles_;

  std::vector<SignedDistanceField> united_;
  double floor_ = -std::numeric_limits<double>::infinity();
};

}  // namespace fitroom
