#include "common/scan_file/range_grid.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace fitroom {
namespace {

constexpr double kMaxEdgeFactor = 4.0;        // Longest edge by median spacing, as in Turk and Levoy's zipper.
constexpr size_t kMaxSpacingSamples = 65536;  // Enough for a median; keeps memory small on any grid.

}  // namespace

RangeGridTriangulator::RangeGridTriangulator(const RangeGrid& grid, const Eigen::Vector3d* vertices)
    : grid_(grid), vertices_(vertices) {
  MeasureSpacing();
}

void RangeGridTriangulator::MeasureSpacing() {
  std::vector<double> squared_spacings;
  Eigen::Vector3d along_rows = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_columns = Eigen::Vector3d::Zero();
  const int64_t stride = 1 + static_cast<int64_t>(2 * grid_.vertex.size() / kMaxSpacingSamples);
  int64_t pair = 0;
  for (int64_t row = 0; row < grid_.row_count; ++row) {
    for (int64_t column = 0; column < grid_.column_count; ++column) {
      const int32_t a = At(column, row);
      const int32_t b = column + 1 < grid_.column_count ? At(column + 1, row) : -1;
      const int32_t d = row + 1 < grid_.row_count ? At(column, row + 1) : -1;
      if (a >= 0 && b >= 0) {
        along_rows += vertices_[b] - vertices_[a];
        if (pair++ % stride == 0) squared_spacings.push_back(SquaredDistance(a, b));
      }
      if (a >= 0 && d >= 0) {
        along_columns += vertices_[d] - vertices_[a];
        if (pair++ % stride == 0) squared_spacings.push_back(SquaredDistance(a, d));
      }
    }
  }
  if (squared_spacings.empty()) return;
  const auto median = squared_spacings.begin() + static_cast<int64_t>(squared_spacings.size() / 2);
  std::nth_element(squared_spacings.begin(), median, squared_spacings.end());
  max_squared_edge_ = kMaxEdgeFactor * kMaxEdgeFactor * *median;
  is_mirrored_ = along_rows.cross(along_columns).z() < 0.0;
}

template <typename Emit>
void RangeGridTriangulator::EmitIfShort(int32_t a, int32_t b, int32_t c, const Emit& emit) const {
  const double longest = std::max({SquaredDistance(a, b), SquaredDistance(b, c), SquaredDistance(c, a)});
  if (longest > max_squared_edge_) return;
  emit(is_mirrored_ ? Eigen::Vector3i(a, c, b) : Eigen::Vector3i(a, b, c));
}

template <typename Emit>
void RangeGridTriangulator::ForEachTriangle(const Emit& emit) const {
  for (int64_t row = 0; row + 1 < grid_.row_count; ++row) {
    for (int64_t column = 0; column + 1 < grid_.column_count; ++column) {
      const int32_t a = At(column, row), b = At(column + 1, row), c = At(column + 1, row + 1), d = At(column, row + 1);
      const int present = (a >= 0) + (b >= 0) + (c >= 0) + (d >= 0);
      if (present < 3) continue;
      if (present == 3) {
        if (a < 0) EmitIfShort(b, c, d, emit);
        if (b < 0) EmitIfShort(a, c, d, emit);
        if (c < 0) EmitIfShort(a, b, d, emit);
        if (d < 0) EmitIfShort(a, b, c, emit);
      } else if (SquaredDistance(a, c) <= SquaredDistance(b, d)) {
        EmitIfShort(a, b, c, emit);
        EmitIfShort(a, c, d, emit);
      } else {
        EmitIfShort(a, b, d, emit);
        EmitIfShort(b, c, d, emit);
      }
    }
  }
}

int64_t RangeGridTriangulator::CountTriangles() const {
  int64_t count = 0;
  ForEachTriangle([&](const Eigen::Vector3i&) { ++count; });
  return count;
}

void RangeGridTriangulator::Write(Eigen::Vector3i* triangles) const {
  ForEachTriangle([&](const Eigen::Vector3i& triangle) { *triangles++ = triangle; });
}

}  // namespace fitroom
