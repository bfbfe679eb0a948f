#include "fit_client/fit/measure/garment_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace fitroom {
namespace {

constexpr double kLeastSpan = 0.6;  // Part of a panel's width that a level cut has to reach over.

// Where one triangle is cut: two points at rest and as worn.
struct CutPiece {
  std::array<Eigen::Vector3d, 2> rest;
  std::array<Eigen::Vector3d, 2> worn;
  std::array<std::pair<int, int>, 2> edges;  // The cut edges, the lower particle first.
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
    piece.edges[count] = std::minmax(static_cast<int>(a), static_cast<int>(b));
    ++count;
  }
  if (count != 2) return std::nullopt;
  return piece;
}

std::vector<bool> SewnFlags(const ClothMesh& cloth) {
  std::vector<bool> is_sewn(cloth.rest_positions.size(), false);
  for (const SeamPair& pair : cloth.seams) {
    is_sewn[static_cast<size_t>(pair.a)] = true;
    is_sewn[static_cast<size_t>(pair.b)] = true;
  }
  return is_sewn;
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

// Where the line on one panel comes to the panel's border.
class LineEnds {
 public:
  // Takes a cut triangle: an edge that only one of them has is of the border.
  void Meet(const CutPiece& piece, bool is_torso) {
    for (const size_t k : {0U, 1U}) {
      End& end = ends_[piece.edges[k]];
      ++end.use_count;
      end.is_torso = end.is_torso || is_torso;
      end.rest_x = piece.rest[k].x();
      end.worn = piece.worn[k];
    }
  }

  // Writes the outermost ends into `half`; false where an end is no seam, or there is none.
  bool Find(const std::vector<bool>& is_sewn, LineHalf& half) const {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const auto& [edge, end] : ends_) {
      if (end.use_count != 1 || !end.is_torso) continue;
      if (!is_sewn[static_cast<size_t>(edge.first)] || !is_sewn[static_cast<size_t>(edge.second)]) return false;
      if (end.rest_x < lowest) half.ends[0] = end.worn;
      if (end.rest_x > highest) half.ends[1] = end.worn;
      lowest = std::min(lowest, end.rest_x);
      highest = std::max(highest, end.rest_x);
    }
    return lowest < highest;
  }

 private:
  struct End {
    int use_count = 0;
    bool is_torso = false;
    double rest_x = 0.0;
    Eigen::Vector3d worn = Eigen::Vector3d::Zero();
  };
  std::map<std::pair<int, int>, End> ends_;
};

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
  std::array<LineEnds, 2> ends;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    const size_t panel = PanelOf(cloth, triangle);
    std::array<double, 3> value = {};
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)]);
      value[k] = cloth.rest_positions[corner].y() - heights[panel];
    }
    const std::optional<CutPiece> piece = Cut(cloth, positions, triangle, value);
    if (!piece) continue;
    const bool is_torso = IsTorso(cloth, triangle);
    ends[panel].Meet(*piece, is_torso);
    if (!is_torso) continue;
    Add(*piece, line);
    LineHalf& half = line.halves[panel];
    const double worn = (piece->worn[1] - piece->worn[0]).norm();
    half.worn_length += worn;
    half.flat_length += (piece->rest[1] - piece->rest[0]).norm();
    half.height += worn * 0.5 * (piece->worn[0].y() + piece->worn[1].y());
    half.centre += worn * 0.5 * (piece->worn[0] + piece->worn[1]);
  }
  line.is_closed = true;
  const std::vector<bool> is_sewn = SewnFlags(cloth);
  for (const size_t panel : {0U, 1U}) {
    LineHalf& half = line.halves[panel];
    if (!(half.worn_length > 0.0)) return {};
    half.height /= half.worn_length;
    half.centre /= half.worn_length;
    line.is_closed = ends[panel].Find(is_sewn, half) && line.is_closed;
  }
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
  std::set<std::pair<int, int>> of_sleeve;
  std::set<std::pair<int, int>> of_torso;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    const bool is_sleeve = SleevePart(cloth, triangle, left) > 0.5;
    if (!is_sleeve && !IsTorso(cloth, triangle)) continue;
    std::array<double, 3> value = {};
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<size_t>(triangle[static_cast<Eigen::Index>(k)]);
      value[k] = direction.dot(positions[corner] - origin);
    }
    const std::optional<CutPiece> piece = Cut(cloth, positions, triangle, value);
    if (!piece || (piece->worn[0] - origin).norm() > reach) continue;
    (is_sleeve ? of_sleeve : of_torso).insert(piece->edges.begin(), piece->edges.end());
    if (is_sleeve) Add(*piece, line);
  }
  line.is_closed = std::none_of(of_sleeve.begin(), of_sleeve.end(),
                                [&](const std::pair<int, int>& edge) { return of_torso.contains(edge); });
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
  const std::vector<bool> is_sewn = SewnFlags(cloth);
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
      Add({{cloth.rest_positions[a], cloth.rest_positions[b]}, {positions[a], positions[b]}, {}}, line);
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
