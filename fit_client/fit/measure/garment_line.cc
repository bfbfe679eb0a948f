#include "fit_client/fit/measure/garment_line.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fitroom {
namespace {

constexpr double kLeastSpan = 0.6;  // Part of a panel's width that a level cut has to reach over.

// Where one triangle is cut: two points at rest and as worn.
struct CutPiece {
  std::array<Eigen::Vector3d, 2> rest;
  std::array<Eigen::Vector3d, 2> worn;
};

bool IsTorso(const ClothMesh& cloth, const Eigen::Vector3i& triangle) {
  return std::max(SleevePart(cloth, triangle, true), SleevePart(cloth, triangle, false)) <= 0.5;
}

size_t PanelOf(const ClothMesh& cloth, const Eigen::Vector3i& triangle) {
  return cloth.panel_of_particle[static_cast<size_t>(triangle[0])] == 0 ? 0U : 1U;
}

// Cuts a triangle where `value` of its corners changes its sign; a corner at zero counts as positive.
std::optional<CutPiece> Cut(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                            const Eigen::Vector3i& triangle, const std::array<double, 3>& value) {
  CutPiece piece;
  size_t count = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t next = (k + 1) % 3;
    if ((value[k] >= 0.0) == (value[next] >= 0.0)) continue;
    const double t = value[k] / (value[k] - value[next]);
    const auto a = static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)]);
    const auto b = static_cast<size_t>(triangle[static_cast<Eigen::Index>(next)]);
    piece.rest[count] = cloth.rest_positions[a] + t * (cloth.rest_positions[b] - cloth.rest_positions[a]);
    piece.worn[count] = positions[a] + t * (positions[b] - positions[a]);
    ++count;
  }
  if (count != 2) return std::nullopt;
  return piece;
}

void Add(const CutPiece& piece, GarmentLine& line) {
  const double worn = (piece.worn[1] - piece.worn[0]).norm();
  line.worn_girth += worn;
  line.flat_girth += (piece.rest[1] - piece.rest[0]).norm();
  line.height += worn * 0.5 * (piece.worn[0].y() + piece.worn[1].y());  // Divided by the length at the end.
}

void Conclude(GarmentLine& line) {
  line.found = line.worn_girth > 0.0 && line.flat_girth > 0.0;
  if (line.found) line.height /= line.worn_girth;
}

}  // namespace

double SleevePart(const ClothMesh& cloth, const Eigen::Vector3i& triangle, bool left) {
  const std::vector<double>& weights = left ? cloth.left_sleeve_weights : cloth.right_sleeve_weights;
  if (weights.size() != cloth.rest_positions.size()) return 0.0;
  double sum = 0.0;
  for (const int corner : triangle) sum += weights[static_cast<size_t>(corner)];
  return sum / 3.0;
}

GarmentLine MeasureLine(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                        const LineHeights& heights) {
  GarmentLine line;
  if (positions.size() != cloth.rest_positions.size()) return line;
  std::array<bool, 2> has_panel = {false, false};
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    const size_t panel = PanelOf(cloth, triangle);
    std::array<double, 3> value = {};
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)]);
      value[k] = cloth.rest_positions[corner].y() - heights[panel];
    }
    const std::optional<CutPiece> piece = Cut(cloth, positions, triangle, value);
    if (!piece || !IsTorso(cloth, triangle)) continue;
    has_panel[panel] = true;
    Add(*piece, line);
  }
  if (!has_panel[0] || !has_panel[1]) return {};
  Conclude(line);
  return line;
}

std::optional<LineHeights> FindLineAt(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                      double height) {
  if (positions.size() != cloth.rest_positions.size()) return std::nullopt;
  std::array<double, 2> weight = {0.0, 0.0};
  LineHeights heights = {0.0, 0.0};
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    std::array<double, 3> value = {};
    for (size_t k = 0; k < 3; ++k) {
      value[k] = positions[static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)])].y() - height;
    }
    const std::optional<CutPiece> piece = Cut(cloth, positions, triangle, value);
    if (!piece || !IsTorso(cloth, triangle)) continue;
    const size_t panel = PanelOf(cloth, triangle);
    const double width = std::abs(piece->rest[1].x() - piece->rest[0].x());
    heights[panel] += width * 0.5 * (piece->rest[0].y() + piece->rest[1].y());
    weight[panel] += width;
  }
  for (const size_t panel : {0U, 1U}) {
    if (!(weight[panel] > 0.0)) return std::nullopt;
    heights[panel] /= weight[panel];
  }
  const GarmentLine line = MeasureLine(cloth, positions, heights);
  if (!line.found || std::min(weight[0], weight[1]) < kLeastSpan * 0.5 * line.flat_girth) return std::nullopt;
  return heights;
}

GarmentLine MeasureSleeve(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                          const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach, bool left) {
  GarmentLine line;
  if (positions.size() != cloth.rest_positions.size()) return line;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    if (SleevePart(cloth, triangle, left) <= 0.5) continue;
    std::array<double, 3> value = {};
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)]);
      value[k] = direction.dot(positions[corner] - origin);
    }
    const std::optional<CutPiece> piece = Cut(cloth, positions, triangle, value);
    if (!piece || (piece->worn[0] - origin).norm() > reach) continue;
    Add(*piece, line);
  }
  Conclude(line);
  return line;
}

GarmentLine MeasureOpening(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                           const std::vector<int>& particles) {
  GarmentLine line;
  if (positions.size() != cloth.rest_positions.size()) return line;
  std::map<std::pair<int, int>, int> uses;
  for (const Eigen::Vector3i& t : cloth.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::vector<bool> is_sewn(positions.size(), false);
  for (const SeamPair& pair : cloth.seams) {
    is_sewn[static_cast<size_t>(pair.a)] = true;
    is_sewn[static_cast<size_t>(pair.b)] = true;
  }
  // Each particle of an open border has one or two neighbours on it.
  std::map<int, std::vector<int>> along;
  for (const auto& [edge, count] : uses) {
    const bool is_seam = is_sewn[static_cast<size_t>(edge.first)] && is_sewn[static_cast<size_t>(edge.second)];
    if (count != 1 || is_seam) continue;
    along[edge.first].push_back(edge.second);
    along[edge.second].push_back(edge.first);
  }
  std::vector<bool> reached(positions.size(), false);
  std::vector<int> next;
  for (const int particle : particles) {
    if (particle < 0 || static_cast<size_t>(particle) >= positions.size()) continue;
    if (along.contains(particle) && !reached[static_cast<size_t>(particle)]) {
      reached[static_cast<size_t>(particle)] = true;
      next.push_back(particle);
    }
  }
  for (size_t k = 0; k < next.size(); ++k) {
    const auto a = static_cast<size_t>(next[k]);
    for (const int other : along[next[k]]) {
      const auto b = static_cast<size_t>(other);
      // Every edge is met from both its ends: half of it each time.
      Add({{cloth.rest_positions[a], cloth.rest_positions[b]}, {positions[a], positions[b]}}, line);
      if (!reached[b]) {
        reached[b] = true;
        next.push_back(other);
      }
    }
  }
  line.worn_girth *= 0.5;
  line.flat_girth *= 0.5;
  line.height *= 0.5;
  Conclude(line);
  return line;
}

}  // namespace fitroom
