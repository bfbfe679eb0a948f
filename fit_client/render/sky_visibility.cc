#include "fit_client/render/sky_visibility.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace fitroom::render {
namespace {

constexpr int kDirectionCount = 28;
constexpr float kCellSize = 0.012F;  // (unit: metre)
// A receiver is lifted this far off its own surface, or the grid's steps would shadow it (unit: metre).
constexpr float kLift = 0.016F;
constexpr int kMaxCellCount = 512;
constexpr float kNothing = -1e9F;

}  // namespace

SkyVisibility::SkyVisibility(const Eigen::Vector3d& bounds_min, const Eigen::Vector3d& bounds_max)
    : centre_((0.5 * (bounds_min + bounds_max)).cast<float>()),
      radius_(static_cast<float>(0.5 * (bounds_max - bounds_min).norm()) + 2.0F * kCellSize) {
  cell_count_ = std::clamp(static_cast<int>(std::ceil(2.0F * radius_ / kCellSize)), 1, kMaxCellCount);
  // A spiral over the sphere from the zenith to 25 degrees below the horizon: light also comes back from floor and
  // walls.
  const float golden_angle = 2.39996323F;
  for (int i = 0; i < kDirectionCount; ++i) {
    const float y = 1.0F - 1.42F * (static_cast<float>(i) + 0.5F) / static_cast<float>(kDirectionCount);
    const float r = std::sqrt(std::max(0.0F, 1.0F - y * y));
    const float angle = golden_angle * static_cast<float>(i);
    DepthMap map;
    map.direction = Eigen::Vector3f(r * std::cos(angle), y, r * std::sin(angle));
    map.across = map.direction.cross(Eigen::Vector3f::UnitX()).normalized();
    map.up = map.direction.cross(map.across);
    map.weight = 0.55F + 0.45F * y;
    map.heights.assign(static_cast<size_t>(cell_count_) * static_cast<size_t>(cell_count_), kNothing);
    maps_.push_back(std::move(map));
  }
}

void SkyVisibility::AddOccluder(std::span<const Eigen::Vector3d> positions,
                                std::span<const Eigen::Vector3i> triangles) {
  // Vertices and, on triangles larger than a cell, an even grid of points between them.
  std::vector<Eigen::Vector3f> samples;
  samples.reserve(positions.size());
  for (const Eigen::Vector3d& position : positions) samples.emplace_back(position.cast<float>() - centre_);
  for (const Eigen::Vector3i& t : triangles) {
    const Eigen::Vector3f a = samples[static_cast<size_t>(t[0])];
    const Eigen::Vector3f ab = samples[static_cast<size_t>(t[1])] - a;
    const Eigen::Vector3f ac = samples[static_cast<size_t>(t[2])] - a;
    const float longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
    const int steps = std::min(static_cast<int>(std::ceil(longest / kCellSize)), 64);
    for (int i = 0; i <= steps && steps > 1; ++i) {
      for (int k = 0; k + i <= steps; ++k) {
        const float u = static_cast<float>(i) / static_cast<float>(steps);
        const float v = static_cast<float>(k) / static_cast<float>(steps);
        samples.emplace_back(a + u * ab + v * ac);
      }
    }
  }
  const float scale = static_cast<float>(cell_count_) / (2.0F * radius_);
  for (DepthMap& map : maps_) {
    for (const Eigen::Vector3f& sample : samples) {
      const int x = static_cast<int>((sample.dot(map.across) + radius_) * scale);
      const int y = static_cast<int>((sample.dot(map.up) + radius_) * scale);
      if (x < 0 || y < 0 || x >= cell_count_ || y >= cell_count_) continue;
      float& height = map.heights[static_cast<size_t>(y) * static_cast<size_t>(cell_count_) + static_cast<size_t>(x)];
      height = std::max(height, sample.dot(map.direction));
    }
  }
}

std::vector<float> SkyVisibility::Compute(std::span<const Eigen::Vector3d> positions,
                                          std::span<const Eigen::Vector3d> normals) const {
  const float scale = static_cast<float>(cell_count_) / (2.0F * radius_);
  std::vector<float> seen(positions.size(), 0.0F);
  std::vector<float> whole(positions.size(), 0.0F);
  std::vector<Eigen::Vector3f> lifted(positions.size());
  std::vector<Eigen::Vector3f> facing(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    facing[i] = normals[i].cast<float>();
    lifted[i] = positions[i].cast<float>() - centre_ + kLift * facing[i];
  }
  for (const DepthMap& map : maps_) {
    for (size_t i = 0; i < positions.size(); ++i) {
      const Eigen::Vector3f& normal = facing[i];
      const float cosine = normal.dot(map.direction);
      if (cosine <= 0.0F) continue;
      const float weight = cosine * map.weight;
      whole[i] += weight;
      const Eigen::Vector3f offset = lifted[i] + 0.5F * kLift * map.direction;
      const float height = offset.dot(map.direction);
      const float x = (offset.dot(map.across) + radius_) * scale - 0.5F;
      const float y = (offset.dot(map.up) + radius_) * scale - 0.5F;
      const int x0 = static_cast<int>(std::floor(x));
      const int y0 = static_cast<int>(std::floor(y));
      if (x0 < 0 || y0 < 0 || x0 + 1 >= cell_count_ || y0 + 1 >= cell_count_) {
        seen[i] += weight;
        continue;
      }
      // Visibility at the four cells round the point, interpolated: no steps from cell to cell.
      const float fx = x - static_cast<float>(x0);
      const float fy = y - static_cast<float>(y0);
      const float* row = map.heights.data() + static_cast<size_t>(y0) * static_cast<size_t>(cell_count_) + x0;
      const float low = (row[0] <= height ? 1.0F - fx : 0.0F) + (row[1] <= height ? fx : 0.0F);
      row += cell_count_;
      const float high = (row[0] <= height ? 1.0F - fx : 0.0F) + (row[1] <= height ? fx : 0.0F);
      seen[i] += weight * ((1.0F - fy) * low + fy * high);
    }
  }
  for (size_t i = 0; i < seen.size(); ++i) seen[i] = whole[i] > 0.0F ? seen[i] / whole[i] : 1.0F;
  return seen;
}

}  // namespace fitroom::render
