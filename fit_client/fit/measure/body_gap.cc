#include "fit_client/fit/measure/body_gap.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <Eigen/Geometry>

#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom {
namespace {

constexpr double kCell = 0.01;               // Edge of a cell (unit: metre).
constexpr int kReach = 6;                    // Cells looked at on each side: kLargestGap.
constexpr double kLargestRegion = 4.0;       // Of the cloth, each way (unit: metre).
constexpr int64_t kLargestIndex = 20000000;  // Triangles in cells, all together.

// Triangles by the cells of a grid round the cloth that their boxes meet.
class TriangleGrid {
 public:
  TriangleGrid(const TriangleMesh& mesh, const Eigen::AlignedBox3d& region) : mesh_(mesh), origin_(region.min()) {
    count_ = ((region.sizes() / kCell).array().floor().cast<int>() + 1).matrix();
    begin_.assign(static_cast<size_t>(count_.cast<int64_t>().prod()) + 1, 0);
    int64_t total = 0;
    for (const Eigen::Vector3i& t : mesh.triangles) total += Visit(t, [this](size_t cell) { ++begin_[cell + 1]; });
    is_usable_ = total <= kLargestIndex;
    if (!is_usable_) return;
    for (size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
    triangles_.resize(begin_.back());
    std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (size_t index = 0; index < mesh.triangles.size(); ++index) {
      Visit(mesh.triangles[index], [&](size_t cell) { triangles_[next[cell]++] = static_cast<uint32_t>(index); });
    }
  }

  bool is_usable() const { return is_usable_; }

  double DistanceTo(const Eigen::Vector3d& point) const {
    const Eigen::Vector3i middle = CellOf(point);
    double best = kLargestGap;
    // Shell by shell; what lies beyond shell r is at least r cells away.
    for (int shell = 0; shell <= kReach && best > (shell - 1) * kCell; ++shell) {
      for (int z = -shell; z <= shell; ++z) {
        for (int y = -shell; y <= shell; ++y) {
          const bool is_face = std::max(std::abs(z), std::abs(y)) == shell;
          for (int x = -shell; x <= shell; x += is_face || shell == 0 ? 1 : 2 * shell) {
            best = std::min(best, DistanceInCell(middle + Eigen::Vector3i(x, y, z), point));
          }
        }
      }
    }
    return best;
  }

 private:
  Eigen::Vector3i CellOf(const Eigen::Vector3d& point) const {
    return ((point - origin_) / kCell).array().floor().cast<int>().matrix();
  }
  size_t IndexOf(const Eigen::Vector3i& cell) const {
    return (static_cast<size_t>(cell.z()) * static_cast<size_t>(count_.y()) + static_cast<size_t>(cell.y())) *
               static_cast<size_t>(count_.x()) +
           static_cast<size_t>(cell.x());
  }

  // Calls `visit` with each cell of the grid that a triangle's box meets; returns how many there are.
  template <typename Function>
  int64_t Visit(const Eigen::Vector3i& triangle, const Function& visit) {
    Eigen::AlignedBox3d box;
    for (const int corner : triangle) box.extend(mesh_.vertices[static_cast<size_t>(corner)]);
    if (!box.min().allFinite() || !box.max().allFinite()) return 0;
    const Eigen::Vector3d far = origin_ + kCell * count_.cast<double>();
    if ((box.max().array() < origin_.array()).any() || (box.min().array() > far.array()).any()) return 0;
    const Eigen::Vector3i low = CellOf(box.min().cwiseMax(origin_)).cwiseMax(0);
    const Eigen::Vector3i high = CellOf(box.max().cwiseMin(far)).cwiseMin(count_ - Eigen::Vector3i::Ones());
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) visit(IndexOf({x, y, z}));
      }
    }
    return (high - low + Eigen::Vector3i::Ones()).cwiseMax(0).cast<int64_t>().prod();
  }

  double DistanceInCell(const Eigen::Vector3i& cell, const Eigen::Vector3d& point) const {
    if (cell.minCoeff() < 0 || (count_ - cell).minCoeff() <= 0) return kLargestGap;
    double best = kLargestGap;
    const size_t index = IndexOf(cell);
    for (uint32_t k = begin_[index]; k < begin_[index + 1]; ++k) {
      const Eigen::Vector3i& t = mesh_.triangles[triangles_[k]];
      const auto corner = [&](int i) -> const Eigen::Vector3d& { return mesh_.vertices[static_cast<size_t>(t[i])]; };
      best =
          std::min(best, (ClosestPointOnTriangle<double>(point, corner(0), corner(1), corner(2)).point - point).norm());
    }
    return best;
  }

  const TriangleMesh& mesh_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i count_ = Eigen::Vector3i::Zero();
  bool is_usable_ = false;
  std::vector<uint32_t> begin_;  // Into triangles_, one a cell and one more.
  std::vector<uint32_t> triangles_;
};

}  // namespace

std::vector<double> MeasureGaps(const TriangleMesh& body, const std::vector<Eigen::Vector3d>& positions) {
  Eigen::AlignedBox3d region;
  for (const Eigen::Vector3d& position : positions) {
    if (position.allFinite()) region.extend(position);
  }
  if (region.isEmpty() || body.triangles.empty() || region.sizes().maxCoeff() > kLargestRegion) return {};
  region.min().array() -= kLargestGap;
  region.max().array() += kLargestGap;
  const TriangleGrid grid(body, region);
  if (!grid.is_usable()) return {};
  std::vector<double> gaps(positions.size(), kLargestGap);
  for (size_t i = 0; i < positions.size(); ++i) {
    if (positions[i].allFinite()) gaps[i] = grid.DistanceTo(positions[i]);
  }
  return gaps;
}

}  // namespace fitroom
