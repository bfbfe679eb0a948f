#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/collision/surface_triangles.h"

namespace fitroom {

// Computes the signed distances on one brick of 9 x 9 x 9 samples from the triangles near it. Samples within
// kNearCells pitches of a triangle are exact; the others take the best of the triangles that a hint and their
// neighbours know, and the sign of their neighbours. One object a task; holds scratch memory only.
class BrickFiller {
 public:
  static constexpr int kNodes = 9;
  static constexpr int kSampleCount = kNodes * kNodes * kNodes;
  static constexpr float kNearCells = 1.25F;  // (unit: pitch)

  BrickFiller(const SurfaceTriangles& surface, float pitch);

  // Fills the brick whose first sample is node `first_node` of the fine grid. `near` are the triangles within two
  // pitches of the brick, at least one. `hints` are triangles for the 27 places half a brick apart, x fastest, or -1.
  void Fill(const Eigen::Vector3i& first_node, std::span<const uint32_t> near, std::span<const int32_t, 27> hints);

  // Signed distance and closest triangle of the sample at a node of the brick.
  float distance(const Eigen::Vector3i& node) const {
    const size_t index = Index(node.x(), node.y(), node.z());
    const float size = std::sqrt(squared_[index]);
    return side_[index] < 0 ? -size : size;
  }
  int32_t triangle(const Eigen::Vector3i& node) const { return triangle_[Index(node.x(), node.y(), node.z())]; }

 private:
  // Rows are padded to three groups of four, so that four samples are one register.
  static constexpr int kRow = 12;
  static constexpr size_t kPaddedCount = static_cast<size_t>(kRow) * kNodes * kNodes;

  static size_t Index(int x, int y, int z) { return static_cast<size_t>(x + kRow * (y + kNodes * z)); }
  Eigen::Vector3f Place(int x, int y, int z) const {
    return (first_node_ + Eigen::Vector3i(x, y, z)).cast<float>() * pitch_;
  }
  void Splat(uint32_t triangle);
  void TakeHints(std::span<const int32_t, 27> hints);
  void SpreadTriangles();
  void Consider(int32_t triangle, int x, int y, int z);
  void SpreadSigns();

  const SurfaceTriangles& surface_;
  float pitch_ = 0.0F;
  Eigen::Vector3i first_node_ = Eigen::Vector3i::Zero();
  alignas(16) std::array<float, kPaddedCount> squared_ = {};
  alignas(16) std::array<int32_t, kPaddedCount> triangle_ = {};
  std::array<bool, kPaddedCount> is_near_ = {};
  std::array<int8_t, kPaddedCount> side_ = {};  // -1 inside, 1 outside, 0 not known yet.
};

}  // namespace fitroom
