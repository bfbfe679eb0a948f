#include "fit_client/fit/collision/signed_distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit_client/fit/collision/signed_distance_field_builder.h"

namespace fitroom {
namespace {

// Interpolates the eight corner values of a cell at fractions `t` along its edges.
//
//      6-----7        corner = x + 2 y + 4 z
//     /|    /|
//    4-----5 |
//    | 2---|-3
//    |/    |/
//    0-----1
SignedDistanceField::Sample Interpolate(const std::array<float, 8>& corners, const Eigen::Vector3d& t, double pitch) {
  std::array<double, 4> along_x = {};
  std::array<double, 4> slope_x = {};
  for (size_t edge = 0; edge < 4; ++edge) {
    const double low = static_cast<double>(corners[2 * edge]);
    slope_x[edge] = static_cast<double>(corners[2 * edge + 1]) - low;
    along_x[edge] = low + slope_x[edge] * t.x();
  }
  const double low_z = along_x[0] + (along_x[1] - along_x[0]) * t.y();
  const double high_z = along_x[2] + (along_x[3] - along_x[2]) * t.y();
  const double slope_low_z = slope_x[0] + (slope_x[1] - slope_x[0]) * t.y();
  const double slope_high_z = slope_x[2] + (slope_x[3] - slope_x[2]) * t.y();
  SignedDistanceField::Sample sample;
  sample.distance = low_z + (high_z - low_z) * t.z();
  sample.gradient.x() = (slope_low_z + (slope_high_z - slope_low_z) * t.z()) / pitch;
  sample.gradient.y() = ((along_x[1] - along_x[0]) * (1.0 - t.z()) + (along_x[3] - along_x[2]) * t.z()) / pitch;
  sample.gradient.z() = (high_z - low_z) / pitch;
  return sample;
}

}  // namespace

Result<SignedDistanceField> SignedDistanceField::Build(const TriangleMesh& body,
                                                       const SignedDistanceFieldOptions& options, Executor& executor) {
  return SignedDistanceFieldBuilder(body, options, executor).Build();
}

SignedDistanceField::Sample SignedDistanceField::QueryAlone(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d inside = point.cwiseMax(region_.min()).cwiseMin(region_.max());
  const Eigen::Vector3d fine = (inside - region_.min()) / pitch_;
  const Eigen::Vector3i last_cell = brick_count_ * kBrickCells - Eigen::Vector3i::Ones();
  const Eigen::Vector3i cell = fine.cast<int>().cwiseMin(last_cell);
  const Eigen::Vector3i brick = cell / kBrickCells;
  const int32_t slot = brick_slot_[BrickIndex(brick)];
  std::array<float, 8> corners = {};
  Sample sample;
  if (slot >= 0) {
    const Eigen::Vector3i local = cell - brick * kBrickCells;
    const float* const base =
        &brick_samples_[static_cast<size_t>(slot) * kBrickSampleCount +
                        static_cast<size_t>(local.x() + kBrickNodes * (local.y() + kBrickNodes * local.z()))];
    for (size_t corner = 0; corner < 8; ++corner) {
      corners[corner] = base[(corner & 1) + kBrickNodes * ((corner >> 1 & 1) + kBrickNodes * (corner >> 2))];
    }
    sample = Interpolate(corners, fine - cell.cast<double>(), pitch_);
  } else {
    constexpr int kStride = kBrickCells / kCoarsePerBrick;
    const Eigen::Vector3i coarse = cell / kStride;
    const size_t base = CoarseIndex(coarse);
    const size_t step_y = static_cast<size_t>(coarse_count_.x());
    const size_t step_z = step_y * static_cast<size_t>(coarse_count_.y());
    for (size_t corner = 0; corner < 8; ++corner) {
      corners[corner] = coarse_samples_[base + (corner & 1) + step_y * (corner >> 1 & 1) + step_z * (corner >> 2)];
    }
    sample = Interpolate(corners, fine / kStride - coarse.cast<double>(), pitch_ * kStride);
  }
  const double outside = (point - inside).norm();
  if (outside > 0.0) {
    sample.distance += outside;
    sample.gradient = (point - inside) / outside;
  }
  return sample;
}

double SignedDistanceField::ExactDistanceAlone(const Eigen::Vector3d& point) const {
  const double interpolated = QueryAlone(point).distance;
  if (!region_.contains(point)) return interpolated;
  const Eigen::Vector3d fine = (point - region_.min()) / pitch_;
  const Eigen::Vector3i brick = (fine / kBrickCells).cast<int>().cwiseMin(brick_count_ - Eigen::Vector3i::Ones());
  const int32_t slot = brick_slot_[BrickIndex(brick)];
  if (slot < 0) return interpolated;
  const Eigen::Vector3f local = (point - region_.min()).cast<float>();
  SurfaceTriangles::Offset nearest{std::numeric_limits<float>::infinity(), false};
  float limit = static_cast<float>(2.0 * pitch_);  // All triangles that are this close are in the brick's list.
  for (uint32_t entry = brick_triangles_begin_[static_cast<size_t>(slot)];
       entry < brick_triangles_begin_[static_cast<size_t>(slot) + 1]; ++entry) {
    if (!(surface_.SquaredDistance(brick_triangles_[entry], local, limit) < nearest.squared_distance)) continue;
    nearest = surface_.OffsetFrom(brick_triangles_[entry], local);
    limit = std::min(limit, std::sqrt(nearest.squared_distance));
  }
  const double distance = std::sqrt(static_cast<double>(nearest.squared_distance));
  if (!(distance <= 2.0 * pitch_)) return interpolated;
  return nearest.is_inside ? -distance : distance;
}

size_t SignedDistanceField::memory_size() const {
  size_t united = 0;
  for (const SignedDistanceField& other : united_) united += other.memory_size();
  return united + brick_slot_.size() * sizeof(int32_t) + brick_samples_.size() * sizeof(float) +
         coarse_samples_.size() * sizeof(float) + surface_.memory_size() +
         (brick_triangles_begin_.size() + brick_triangles_.size()) * sizeof(uint32_t);
}

}  // namespace fitroom
