#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// Widths of a bottom at rest, level by level: [side][panel], measured along the level (unit: metre).
class GarmentLevels {
 public:
  using Widths = std::array<std::array<double, 2>, 2>;

  // `across` tells the side of each particle by its sign: positive for the left.
  GarmentLevels(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& across);

  // At the level nearest to a height at rest. Beyond the ends, and where a curved edge leaves part of a level empty,
  // the next full level counts.
  Widths At(double rest_y) const;

 private:
  static constexpr double kStep = 0.01;  // (unit: metre)

  void AddTriangle(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& across, const Eigen::Vector3i& triangle);
  void FillFrom(size_t full, size_t at, double share);

  double low_ = 0.0;
  std::vector<Widths> widths_;  // Level k lies k steps above the lowest particle.
};

}  // namespace fitroom
