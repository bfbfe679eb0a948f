#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// The body seen from the front, parallel to Z: for each cell of a regular grid over x and y, the foremost and the
// rearmost z of its surface. Immutable; safe to read from several threads. Canonical body frame, metres.
class FrontalMap {
 public:
  // One stretch of body in a row of the grid, cell centres included.
  struct Run {
    double begin = 0.0;  // Smallest x (unit: metre).
    double end = 0.0;    // Largest x (unit: metre).
  };

  // Rasters `body` at `pitch` (unit: metre, > 0). The body should be free of holes: through a hole one sees the far
  // side.
  FrontalMap(const TriangleMesh& body, double pitch);

  // Return the z of the body's surface seen from the front (largest) or from behind (smallest) at (x, y), the extreme
  // over a disc of `radius`; nothing where the disc meets no body.
  std::optional<double> FrontDepth(double x, double y, double radius) const;
  std::optional<double> BackDepth(double x, double y, double radius) const;

  // Returns the stretches of body in the row nearest to y, from small to large x; stretches shorter than a centimetre
  // and gaps of one cell are ignored.
  std::vector<Run> RowRuns(double y) const;

  // Returns the largest y of the body, not above `highest`, in the column nearest to x; nothing where there is none.
  // The bound keeps the head out where it overhangs the shoulders.
  std::optional<double> ColumnTop(double x, double highest) const;

  double pitch() const { return pitch_; }
  double min_y() const { return origin_.y(); }
  double max_y() const { return origin_.y() + pitch_ * rows_; }

 private:
  struct Cell {
    float front = 0.0F;
    float back = 0.0F;
    bool filled = false;
  };
  size_t Index(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  }
  const Cell& cell(int column, int row) const { return cells_[Index(column, row)]; }
  Cell& cell(int column, int row) { return cells_[Index(column, row)]; }
  void RasterTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  template <typename Visit>
  void VisitDisc(double x, double y, double radius, const Visit& visit) const;

  double pitch_ = 0.0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();  // Lower left corner of cell (0, 0).
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace fitroom
