#include "fit_client/fit/solver/drape_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Geometry>

#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom {
namespace {

constexpr size_t kItemsPerTask = 2048;

int TaskCount(size_t item_count) { return static_cast<int>((item_count + kItemsPerTask - 1) / kItemsPerTask); }

// Triangles by the cells of a grid that they overlap, for finding those near an edge.
class TriangleGrid {
 public:
  TriangleGrid(std::span<const Eigen::Vector3d> positions, std::span<const std::array<int, 3>> triangles);

  // Calls `visit` with each triangle whose cells overlap the box; one may come several times.
  template <typename Visit>
  void ForEachNear(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    ForEachCell(box, [&](size_t cell) {
      for (uint32_t entry = begin_[cell]; entry < begin_[cell + 1]; ++entry) visit(entries_[entry], cell);
    });
  }
  // Returns the cell of a point; every pair of boxes that overlap shares the cell of their common lowest corner.
  size_t CellOf(const Eigen::Vector3d& point) const {
    const Eigen::Vector3i cell = Cell(point);
    return Index(cell);
  }

 private:
  Eigen::Vector3i Cell(const Eigen::Vector3d& point) const {
    return ((point - bounds_.min()) / cell_size_)
        .array()
        .floor()
        .matrix()
        .cast<int>()
        .cwiseMax(0)
        .cwiseMin(count_ - Eigen::Vector3i::Ones());
  }
  size_t Index(const Eigen::Vector3i& cell) const {
    return static_cast<size_t>(cell.x()) +
           static_cast<size_t>(count_.x()) *
               (static_cast<size_t>(cell.y()) + static_cast<size_t>(count_.y()) * static_cast<size_t>(cell.z()));
  }
  template <typename Visit>
  void ForEachCell(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    const Eigen::Vector3i low = Cell(box.min());
    const Eigen::Vector3i high = Cell(box.max());
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) visit(Index({x, y, z}));
      }
    }
  }

  Eigen::AlignedBox3d bounds_;
  double cell_size_ = 1.0;
  Eigen::Vector3i count_ = Eigen::Vector3i::Ones();
  std::vector<uint32_t> begin_;
  std::vector<uint32_t> entries_;
};

Eigen::AlignedBox3d BoxOf(std::span<const Eigen::Vector3d> positions, std::span<const int> particles) {
  Eigen::AlignedBox3d box;
  for (const int particle : particles) box.extend(positions[static_cast<size_t>(particle)]);
  return box;
}

TriangleGrid::TriangleGrid(std::span<const Eigen::Vector3d> positions, std::span<const std::array<int, 3>> triangles) {
  for (const Eigen::Vector3d& position : positions) bounds_.extend(position);
  double mean_size = 0.0;
  for (const auto& triangle : triangles) mean_size += BoxOf(positions, triangle).sizes().maxCoeff();
  mean_size = std::max(mean_size / static_cast<double>(std::max<size_t>(1, triangles.size())), 1e-4);
  // No more cells than some tens a triangle, whatever the bounds.
  const double volume = bounds_.sizes().cwiseMax(mean_size).prod();
  cell_size_ = std::max(1.5 * mean_size, std::cbrt(volume / (64.0 * static_cast<double>(triangles.size() + 1))));
  count_ = (bounds_.sizes() / cell_size_).array().floor().matrix().cast<int>() + Eigen::Vector3i::Ones();
  begin_.assign(static_cast<size_t>(count_.cast<Eigen::Index>().prod()) + 1, 0);
  for (const auto& triangle : triangles) {
    ForEachCell(BoxOf(positions, triangle), [&](size_t cell) { ++begin_[cell + 1]; });
  }
  for (size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  entries_.resize(begin_.back());
  std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (size_t index = 0; index < triangles.size(); ++index) {
    ForEachCell(BoxOf(positions, triangles[index]),
                [&](size_t cell) { entries_[next[cell]++] = static_cast<uint32_t>(index); });
  }
}

}  // namespace

double Percentile(std::vector<double> values, double share) {
  FR_CHECK(!values.empty());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::lround(std::clamp(place, 0.0, 1e18)));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

void MeasureStrain(const ClothModel& model, std::span<const Eigen::Vector3d> positions, const ClothMesh& mesh,
                   DrapeReport& report) {
  std::vector<double> strains;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const size_t from = static_cast<size_t>(triangle[corner]);
      const size_t to = static_cast<size_t>(triangle[(corner + 1) % 3]);
      const double rest = (mesh.rest_positions[from] - mesh.rest_positions[to]).norm();
      const Eigen::Vector3d& p = positions[static_cast<size_t>(model.particle_of_vertex()[from])];
      const Eigen::Vector3d& q = positions[static_cast<size_t>(model.particle_of_vertex()[to])];
      if (rest > 0.0) strains.push_back((p - q).norm() / rest - 1.0);
    }
  }
  report.strain_p50 = Percentile(strains, 0.5);
  report.strain_p95 = Percentile(strains, 0.95);
  report.strain_p99 = Percentile(strains, 0.99);
  report.strain_max = Percentile(strains, 1.0);
}

void MeasurePenetration(const ClothModel& model, std::span<const Eigen::Vector3d> positions,
                        const SignedDistanceField& body, Executor& executor, DrapeReport& report) {
  const size_t particle_count = positions.size();
  const size_t edge_count = model.edges().size();
  std::vector<Eigen::Vector3d> samples(positions.begin(), positions.end());
  for (const auto& [a, b] : model.edges()) {
    samples.push_back(0.5 * (positions[static_cast<size_t>(a)] + positions[static_cast<size_t>(b)]));
  }
  for (const auto& [a, b, c] : model.triangles()) {
    samples.push_back(
        (positions[static_cast<size_t>(a)] + positions[static_cast<size_t>(b)] + positions[static_cast<size_t>(c)]) /
        3.0);
  }
  FR_CHECK(samples.size() == particle_count + edge_count + model.triangles().size());
  std::vector<double> distances(samples.size());
  executor.Run(TaskCount(samples.size()), [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kItemsPerTask;
    for (size_t index = begin; index < std::min(begin + kItemsPerTask, samples.size()); ++index) {
      distances[index] = body.Distance(samples[index]);
      if (std::abs(distances[index]) < 0.5 * body.pitch()) distances[index] = body.ExactDistance(samples[index]);
    }
  });
  report.particles_inside = report.samples_inside = 0;
  report.deepest_penetration = 0.0;
  for (size_t index = 0; index < distances.size(); ++index) {
    if (distances[index] >= 0.0) continue;
    ++(index < particle_count ? report.particles_inside : report.samples_inside);
    report.deepest_penetration = std::max(report.deepest_penetration, -distances[index]);
  }
}

int CountSelfCrossings(const ClothModel& model, std::span<const Eigen::Vector3d> positions, Executor& executor) {
  const std::span<const std::array<int, 2>> edges = model.edges();
  const std::span<const std::array<int, 3>> triangles = model.triangles();
  const TriangleGrid grid(positions, triangles);
  std::vector<int> counts(static_cast<size_t>(TaskCount(edges.size())), 0);
  executor.Run(TaskCount(edges.size()), [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kItemsPerTask;
    for (size_t index = begin; index < std::min(begin + kItemsPerTask, edges.size()); ++index) {
      const auto& [p, q] = edges[index];
      const Eigen::AlignedBox3d box = BoxOf(positions, edges[index]);
      grid.ForEachNear(box, [&](uint32_t triangle, size_t cell) {
        const auto& [a, b, c] = triangles[triangle];
        if (a == p || a == q || b == p || b == q || c == p || c == q) return;
        const Eigen::AlignedBox3d common = box.intersection(BoxOf(positions, triangles[triangle]));
        if (common.isEmpty() || grid.CellOf(common.min()) != cell) return;
        if (SegmentCrossesTriangle(positions[static_cast<size_t>(p)], positions[static_cast<size_t>(q)],
                                   positions[static_cast<size_t>(a)], positions[static_cast<size_t>(b)],
                                   positions[static_cast<size_t>(c)])) {
          ++counts[static_cast<size_t>(task)];
        }
      });
    }
  });
  int total = 0;
  for (const int count : counts) total += count;
  return total;
}

}  // namespace fitroom
