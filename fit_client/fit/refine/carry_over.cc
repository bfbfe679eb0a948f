#include "fit_client/fit/refine/carry_over.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace fitroom {
namespace {

using Eigen::Vector2d;

constexpr int kLargestCellCount = 1 << 20;
// A place so far beside a triangle is taken on its border instead (unit: weight).
constexpr double kFarthestWeight = -1.0;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Vector2d AtRest(const ClothMesh& mesh, int vertex) {
  return mesh.rest_positions[static_cast<size_t>(vertex)].head<2>();
}

// The panel of each piece. Panels read from a file do not say which is which: 0.
std::vector<int> PanelsOf(const ClothPieces& pieces, const ClothMesh& mesh) {
  std::vector<int> panels(static_cast<size_t>(pieces.count), 0);
  const size_t count = std::min(mesh.panel_of_particle.size(), pieces.piece_of_particle.size());
  for (size_t particle = 0; particle < count; ++particle) {
    panels[static_cast<size_t>(pieces.piece_of_particle[particle])] = mesh.panel_of_particle[particle];
  }
  return panels;
}

// The triangles of one flat piece by the cells of a grid that they overlap.
class PieceGrid {
 public:
  PieceGrid(const ClothMesh& mesh, std::vector<int> triangles);

  // Returns the place of a point that is in the piece or beside it.
  PlaceOnMesh Find(const Vector2d& point) const;

 private:
  int Column(double x) const { return Axis(x, bounds_.min().x(), columns_); }
  int Row(double y) const { return Axis(y, bounds_.min().y(), rows_); }
  int Axis(double value, double low, int count) const {
    return static_cast<int>(std::clamp(std::floor((value - low) / cell_), 0.0, static_cast<double>(count - 1)));
  }
  size_t Cell(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  }
  Eigen::AlignedBox2d BoxOf(int triangle) const {
    Eigen::AlignedBox2d box;
    for (const int corner : mesh_.triangles[static_cast<size_t>(triangle)]) box.extend(AtRest(mesh_, corner));
    return box;
  }
  // The weights of a point, and how far it is outside of the triangle: 0 inside (unit: metre).
  std::pair<std::array<double, 3>, double> Weigh(int triangle, const Vector2d& point) const;

  const ClothMesh& mesh_;
  std::vector<int> triangles_;
  Eigen::AlignedBox2d bounds_;
  double cell_ = 1.0;  // (unit: metre)
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::vector<int>> triangles_of_cell_;
};

PieceGrid::PieceGrid(const ClothMesh& mesh, std::vector<int> triangles)
    : mesh_(mesh), triangles_(std::move(triangles)) {
  double mean_size = 0.0;
  for (const int triangle : triangles_) {
    const Eigen::AlignedBox2d box = BoxOf(triangle);
    bounds_.extend(box);
    mean_size += box.sizes().maxCoeff() / static_cast<double>(triangles_.size());
  }
  const Vector2d sizes = bounds_.sizes().cwiseMax(mean_size);
  cell_ = std::max({mean_size, std::sqrt(sizes.x() * sizes.y() / kLargestCellCount), 1e-6});
  columns_ = 1 + static_cast<int>(std::min(sizes.x() / cell_, static_cast<double>(kLargestCellCount)));
  rows_ = 1 + static_cast<int>(std::min(sizes.y() / cell_, static_cast<double>(kLargestCellCount)));
  triangles_of_cell_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
  for (const int triangle : triangles_) {
    const Eigen::AlignedBox2d box = BoxOf(triangle);
    for (int row = Row(box.min().y()); row <= Row(box.max().y()); ++row) {
      for (int column = Column(box.min().x()); column <= Column(box.max().x()); ++column) {
        triangles_of_cell_[Cell(column, row)].push_back(triangle);
      }
    }
  }
}

std::pair<std::array<double, 3>, double> PieceGrid::Weigh(int triangle, const Vector2d& point) const {
  const Eigen::Vector3i& corners = mesh_.triangles[static_cast<size_t>(triangle)];
  const std::array<Vector2d, 3> at = {AtRest(mesh_, corners[0]), AtRest(mesh_, corners[1]), AtRest(mesh_, corners[2])};
  const double area = Cross(at[1] - at[0], at[2] - at[0]);
  if (std::abs(area) < 1e-14) return {{1.0, 0.0, 0.0}, std::numeric_limits<double>::max()};
  std::array<double, 3> weights = {};
  double outside = 0.0;
  for (size_t corner = 0; corner < 3; ++corner) {
    const Vector2d& from = at[(corner + 1) % 3];
    const Vector2d& to = at[(corner + 2) % 3];
    weights[corner] = Cross(to - from, point - from) / area;
    outside = std::max(outside, -weights[corner] * std::abs(area) / (to - from).norm());
  }
  return {weights, outside};
}

PlaceOnMesh PieceGrid::Find(const Vector2d& point) const {
  const int column = Column(point.x());
  const int row = Row(point.y());
  PlaceOnMesh place;
  double best = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring < columns_ + rows_; ++ring) {
    for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
      const bool is_whole_row = std::abs(r - row) == ring;
      for (int c = column - ring; c <= column + ring; c += is_whole_row || ring == 0 ? 1 : 2 * ring) {
        if (c < 0 || c >= columns_) continue;
        for (const int triangle : triangles_of_cell_[Cell(c, r)]) {
          const auto [weights, outside] = Weigh(triangle, point);
          if (outside >= best) continue;
          best = outside;
          const Eigen::Vector3i& corners = mesh_.triangles[static_cast<size_t>(triangle)];
          place = {{corners[0], corners[1], corners[2]}, weights};
        }
      }
    }
    // What lies in the next ring is farther away than this.
    if (best <= ring * cell_) break;
  }
  if (std::min({place.weights[0], place.weights[1], place.weights[2]}) < kFarthestWeight) {
    double sum = 0.0;
    for (double& weight : place.weights) sum += weight = std::max(weight, 0.0);
    for (double& weight : place.weights) weight /= sum;
  }
  return place;
}

}  // namespace

Result<std::vector<PlaceOnMesh>> FindPlaces(const ClothMesh& coarse, const ClothMesh& fine) {
  const ClothPieces pieces = FindPieces(coarse);
  const ClothPieces fine_pieces = FindPieces(fine);
  if (PanelsOf(pieces, coarse) != PanelsOf(fine_pieces, fine) || coarse.triangles.empty()) {
    return InvalidArgument("MESHES_DIFFER", "the coarse and the fine mesh are not of the same panels");
  }
  std::vector<std::vector<int>> triangles(static_cast<size_t>(pieces.count));
  for (size_t index = 0; index < coarse.triangles.size(); ++index) {
    const size_t vertex = static_cast<size_t>(coarse.triangles[index][0]);
    triangles[static_cast<size_t>(pieces.piece_of_particle[vertex])].push_back(static_cast<int>(index));
  }
  std::vector<PieceGrid> grids;
  for (std::vector<int>& of_piece : triangles) {
    if (of_piece.empty()) return InvalidArgument("MESHES_DIFFER", "a piece of the coarse mesh has no triangle");
    grids.emplace_back(coarse, std::move(of_piece));
  }
  std::vector<PlaceOnMesh> places;
  places.reserve(fine.rest_positions.size());
  for (size_t vertex = 0; vertex < fine.rest_positions.size(); ++vertex) {
    places.push_back(
        grids[static_cast<size_t>(fine_pieces.piece_of_particle[vertex])].Find(AtRest(fine, static_cast<int>(vertex))));
  }
  return places;
}

std::vector<Eigen::Vector3d> CarryOver(std::span<const PlaceOnMesh> places,
                                       std::span<const Eigen::Vector3d> positions) {
  std::vector<Eigen::Vector3d> carried;
  if (positions.empty()) return carried;
  carried.reserve(places.size());
  for (const PlaceOnMesh& place : places) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t corner = 0; corner < 3; ++corner) {
      sum += place.weights[corner] * positions[static_cast<size_t>(place.vertices[corner])];
    }
    carried.push_back(sum);
  }
  return carried;
}

}  // namespace fitroom
