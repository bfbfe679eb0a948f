#include "fit_client/fit/stages/garment_levels.h"

#include <algorithm>
#include <cmath>

namespace fitroom {

using Eigen::Vector3d;

GarmentLevels::GarmentLevels(const ClothMesh& cloth, const std::vector<Vector3d>& across) {
  double low = 1e9;
  double high = -1e9;
  for (const Vector3d& place : cloth.rest_positions) {
    low = std::min(low, place.y());
    high = std::max(high, place.y());
  }
  low_ = low;
  const size_t count = static_cast<size_t>(std::clamp((high - low) / kStep, 1.0, 400.0)) + 1;
  widths_.assign(count, Widths{});
  for (const Eigen::Vector3i& triangle : cloth.triangles) AddTriangle(cloth, across, triangle);
  for (size_t k = 1; k < count; ++k) FillFrom(k - 1, k, 0.8);
  for (size_t k = count - 1; k-- > 0;) FillFrom(k + 1, k, 0.8);
}

GarmentLevels::Widths GarmentLevels::At(double rest_y) const {
  const double place = std::clamp((rest_y - low_) / kStep, 0.0, static_cast<double>(widths_.size() - 1));
  return widths_[static_cast<size_t>(std::lround(place))];
}

void GarmentLevels::AddTriangle(const ClothMesh& cloth, const std::vector<Vector3d>& across,
                                const Eigen::Vector3i& triangle) {
  const auto rest = [&](int k) { return cloth.rest_positions[static_cast<size_t>(triangle[k])]; };
  const double low = std::min({rest(0).y(), rest(1).y(), rest(2).y()});
  const double high = std::max({rest(0).y(), rest(1).y(), rest(2).y()});
  double side = 0.0;
  for (int k = 0; k < 3; ++k) side += across[static_cast<size_t>(triangle[k])].x();
  const size_t panel = static_cast<size_t>(cloth.panel_of_particle[static_cast<size_t>(triangle[0])]);
  for (int level = static_cast<int>(std::ceil((low - low_) / kStep));
       level <= static_cast<int>(std::floor((high - low_) / kStep)) && level < static_cast<int>(widths_.size());
       ++level) {
    const double y = low_ + level * kStep;
    double left = 1e9;
    double right = -1e9;
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = rest(k);
      const Vector3d b = rest((k + 1) % 3);
      if ((a.y() <= y) == (b.y() <= y)) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (right > left) widths_[static_cast<size_t>(level)][side >= 0.0 ? 0 : 1][panel] += right - left;
  }
}

void GarmentLevels::FillFrom(size_t full, size_t at, double share) {
  for (size_t side = 0; side < 2; ++side) {
    for (size_t panel = 0; panel < 2; ++panel) {
      double& width = widths_[at][side][panel];
      const double other = widths_[full][side][panel];
      if (width < share * other) width = other;
    }
  }
}

}  // namespace fitroom
