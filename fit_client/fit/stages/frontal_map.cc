#include "fit_client/fit/stages/frontal_map.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace fitroom {
namespace {

constexpr double kShortestRun = 0.01;  // A stretch of body shorter than this is noise (unit: metre).

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

FrontalMap::FrontalMap(const TriangleMesh& body, double pitch) : pitch_(pitch) {
  FR_CHECK(pitch > 0.0);
  FR_CHECK(!body.vertices.empty());
  const Eigen::AlignedBox3d bounds = ComputeBounds(body);
  origin_ = bounds.min().head<2>() - Eigen::Vector2d::Constant(pitch);
  columns_ = static_cast<int>(std::ceil(bounds.sizes().x() / pitch)) + 3;
  rows_ = static_cast<int>(std::ceil(bounds.sizes().y() / pitch)) + 3;
  cells_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
  for (const Eigen::Vector3i& triangle : body.triangles) {
    RasterTriangle(body.vertices[static_cast<size_t>(triangle[0])], body.vertices[static_cast<size_t>(triangle[1])],
                   body.vertices[static_cast<size_t>(triangle[2])]);
  }
}

void FrontalMap::RasterTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const auto mark = [this](int column, int row, double z) {
    Cell& target = cell(column, row);
    const auto depth = static_cast<float>(z);
    target.front = target.filled ? std::max(target.front, depth) : depth;
    target.back = target.filled ? std::min(target.back, depth) : depth;
    target.filled = true;
  };
  // Corners always count, so that triangles smaller than a cell are not lost between cell centres.
  for (const Eigen::Vector3d* corner : {&a, &b, &c}) {
    const Eigen::Vector2d place = (corner->head<2>() - origin_) / pitch_;
    mark(static_cast<int>(place.x()), static_cast<int>(place.y()), corner->z());
  }
  const Eigen::Vector2d pa = (a.head<2>() - origin_) / pitch_;
  const Eigen::Vector2d pb = (b.head<2>() - origin_) / pitch_;
  const Eigen::Vector2d pc = (c.head<2>() - origin_) / pitch_;
  const double doubled_area = Cross(pb - pa, pc - pa);
  if (std::abs(doubled_area) < 1e-12) return;
  const Eigen::Vector2d low = pa.cwiseMin(pb).cwiseMin(pc);
  const Eigen::Vector2d high = pa.cwiseMax(pb).cwiseMax(pc);
  for (int row = static_cast<int>(std::ceil(low.y() - 0.5)); row + 0.5 <= high.y(); ++row) {
    for (int column = static_cast<int>(std::ceil(low.x() - 0.5)); column + 0.5 <= high.x(); ++column) {
      const Eigen::Vector2d centre(column + 0.5, row + 0.5);
      const double weight_a = Cross(pb - centre, pc - centre) / doubled_area;
      const double weight_b = Cross(pc - centre, pa - centre) / doubled_area;
      const double weight_c = 1.0 - weight_a - weight_b;
      if (weight_a < 0.0 || weight_b < 0.0 || weight_c < 0.0) continue;
      mark(column, row, weight_a * a.z() + weight_b * b.z() + weight_c * c.z());
    }
  }
}

template <typename Visit>
void FrontalMap::VisitDisc(double x, double y, double radius, const Visit& visit) const {
  const Eigen::Vector2d centre = (Eigen::Vector2d(x, y) - origin_) / pitch_;
  const double reach = std::max(radius / pitch_, 0.5);
  const int first_row = std::max(0, static_cast<int>(std::floor(centre.y() - reach)));
  const int last_row = std::min(rows_ - 1, static_cast<int>(std::floor(centre.y() + reach)));
  const int first_column = std::max(0, static_cast<int>(std::floor(centre.x() - reach)));
  const int last_column = std::min(columns_ - 1, static_cast<int>(std::floor(centre.x() + reach)));
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const Eigen::Vector2d offset = Eigen::Vector2d(column + 0.5, row + 0.5) - centre;
      if (offset.squaredNorm() > reach * reach + 0.5 || !cell(column, row).filled) continue;
      visit(cell(column, row));
    }
  }
}

std::optional<double> FrontalMap::FrontDepth(double x, double y, double radius) const {
  std::optional<double> depth;
  VisitDisc(x, y, radius, [&](const Cell& seen) { depth = std::max(depth.value_or(seen.front), double{seen.front}); });
  return depth;
}

std::optional<double> FrontalMap::BackDepth(double x, double y, double radius) const {
  std::optional<double> depth;
  VisitDisc(x, y, radius, [&](const Cell& seen) { depth = std::min(depth.value_or(seen.back), double{seen.back}); });
  return depth;
}

std::vector<FrontalMap::Run> FrontalMap::RowRuns(double y) const {
  const int row = std::clamp(static_cast<int>((y - origin_.y()) / pitch_), 0, rows_ - 1);
  std::vector<Run> runs;
  int last_filled = -10;
  for (int column = 0; column < columns_; ++column) {
    if (!cell(column, row).filled) continue;
    const double x = origin_.x() + (column + 0.5) * pitch_;
    if (column - last_filled <= 2) {
      runs.back().end = x;
    } else {
      runs.push_back({x, x});
    }
    last_filled = column;
  }
  std::erase_if(runs, [](const Run& run) { return run.end - run.begin < kShortestRun; });
  return runs;
}

std::optional<double> FrontalMap::ColumnTop(double x, double highest) const {
  const int column = static_cast<int>(std::floor((x - origin_.x()) / pitch_));
  if (column < 0 || column >= columns_) return std::nullopt;
  const int first_row = std::min(rows_ - 1, static_cast<int>(std::floor((highest - origin_.y()) / pitch_)));
  for (int row = first_row; row >= 0; --row) {
    if (cell(column, row).filled) return origin_.y() + (row + 1.0) * pitch_;
  }
  return std::nullopt;
}

}  // namespace fitroom
