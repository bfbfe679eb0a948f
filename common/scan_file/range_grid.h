#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// A grid of range samples as Cyberware scanners write it, row by row: each place holds a vertex index or -1.
struct RangeGrid {
  int64_t column_count = 0;
  int64_t row_count = 0;
  std::vector<int32_t> vertex;
};

// Triangulates the grid: of each cell with four samples two triangles along the shorter diagonal, with three samples
// one. Triangles with an edge longer than four times the median spacing span a jump in depth and are left out (Turk and
// Levoy 1994, section 3). They face +z, towards the scanner, counter-clockwise seen from there.
//
//   row+1   d --- c        a = (column, row)
//           |   / |
//           | /   |
//   row     a --- b
//
// Every index of the grid must be -1 or in range.
class RangeGridTriangulator {
 public:
  // Borrows both.
  RangeGridTriangulator(const RangeGrid& grid, const Eigen::Vector3d* vertices);

  int64_t CountTriangles() const;
  // Writes CountTriangles() triangles to `triangles`.
  void Write(Eigen::Vector3i* triangles) const;

 private:
  template <typename Emit>
  void ForEachTriangle(const Emit& emit) const;
  template <typename Emit>
  void EmitIfShort(int32_t a, int32_t b, int32_t c, const Emit& emit) const;
  int32_t At(int64_t column, int64_t row) const {
    return grid_.vertex[static_cast<size_t>(row * grid_.column_count + column)];
  }
  double SquaredDistance(int32_t a, int32_t b) const { return (vertices_[a] - vertices_[b]).squaredNorm(); }
  void MeasureSpacing();

  const RangeGrid& grid_;
  const Eigen::Vector3d* vertices_;
  double max_squared_edge_ = 0.0;
  bool is_mirrored_ = false;  // Columns and rows run so that a, b, c is clockwise seen from +z.
};

}  // namespace fitroom
