#include "fit_client/fit/solver/drape_hoops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace fitroom {
namespace {

constexpr double kSleeve = 0.5;          // Weight from which on a particle belongs to a sleeve.
constexpr double kSameGround = 0.02;     // A hoop closes where it comes back this near (unit: metre).
constexpr double kOneSided = 0.2;        // Of a hoop's width: farther off the middle it is a leg's (unit: 1).
constexpr size_t kMostCrossings = 4000;  // A hoop of so many edges has gone astray.

using Edge = std::pair<int, int>;  // Lower vertex first.

Edge EdgeOf(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// An edge of a border that is sewn to another one: vertex for vertex.
struct SewnEdge {
  std::array<int, 2> vertices = {};
  std::array<int, 2> partners = {};
  std::array<int, 2> pairs = {};  // Of ClothMesh::seams.
};

// Follows level lines over the cloth.
class HoopTracer {
 public:
  explicit HoopTracer(const ClothMesh& mesh) : mesh_(mesh) {
    for (size_t index = 0; index < mesh.triangles.size(); ++index) {
      for (int k = 0; k < 3; ++k) {
        const Edge edge = EdgeOf(mesh.triangles[index][k], mesh.triangles[index][(k + 1) % 3]);
        triangles_of_edge_[edge].push_back(static_cast<int>(index));
      }
    }
    pairs_of_vertex_.resize(mesh.rest_positions.size());
    for (size_t index = 0; index < mesh.seams.size(); ++index) {
      pairs_of_vertex_[static_cast<size_t>(mesh.seams[index].a)].push_back(static_cast<int>(index));
      pairs_of_vertex_[static_cast<size_t>(mesh.seams[index].b)].push_back(static_cast<int>(index));
    }
    for (const auto& [edge, triangles] : triangles_of_edge_) {
      if (triangles.size() != 1) continue;
      if (const std::optional<SewnEdge> sewn = FindPartner(edge)) sewn_edges_.emplace(edge, *sewn);
    }
    SetSleeveAxes();
  }

  std::vector<GarmentHoop> TraceAll() const {
    std::vector<GarmentHoop> hoops;
    for (const auto& [edge, sewn] : sewn_edges_) {
      if (mesh_.seams[static_cast<size_t>(sewn.pairs[0])].a != sewn.vertices[0]) continue;  // Each from its side a.
      std::optional<GarmentHoop> hoop = Trace(sewn);
      if (hoop) hoops.push_back(std::move(*hoop));
    }
    return hoops;
  }

 private:
  const Eigen::Vector3d& Rest(int vertex) const { return mesh_.rest_positions[static_cast<size_t>(vertex)]; }
  int Partner(int pair, int vertex) const {
    const SeamPair& seam = mesh_.seams[static_cast<size_t>(pair)];
    return seam.a == vertex ? seam.b : seam.a;
  }
  // -1: the right sleeve, 1: the left one, 0: neither.
  int SleeveOf(int vertex) const {
    const size_t at = static_cast<size_t>(vertex);
    if (mesh_.left_sleeve_weights.size() == mesh_.rest_positions.size() && mesh_.left_sleeve_weights[at] > kSleeve) {
      return 1;
    }
    return mesh_.right_sleeve_weights.size() == mesh_.rest_positions.size() && mesh_.right_sleeve_weights[at] > kSleeve
               ? -1
               : 0;
  }
  int SleeveOf(const SewnEdge& sewn) const {
    const int sleeve = SleeveOf(sewn.vertices[0]);
    return sleeve == SleeveOf(sewn.vertices[1]) ? sleeve : 0;
  }

  std::optional<SewnEdge> FindPartner(const Edge& edge) const {
    for (const int first : pairs_of_vertex_[static_cast<size_t>(edge.first)]) {
      for (const int second : pairs_of_vertex_[static_cast<size_t>(edge.second)]) {
        if (first == second) continue;
        const SewnEdge sewn = {
            {edge.first, edge.second}, {Partner(first, edge.first), Partner(second, edge.second)}, {first, second}};
        const auto other = triangles_of_edge_.find(EdgeOf(sewn.partners[0], sewn.partners[1]));
        if (other != triangles_of_edge_.end() && other->second.size() == 1 && other->first != edge) return sewn;
      }
    }
    return std::nullopt;
  }

  // Along a sleeve run its seams.
  void SetSleeveAxes() {
    for (const auto& [edge, sewn] : sewn_edges_) {
      const int sleeve = SleeveOf(sewn);
      if (sleeve == 0) continue;
      const Eigen::Vector3d way = Rest(edge.second) - Rest(edge.first);
      sleeve_axes_[sleeve > 0 ? 0 : 1] += way * (way.x() * sleeve > 0.0 ? 1.0 : -1.0);
    }
    for (Eigen::Vector3d& axis : sleeve_axes_) {
      if (axis.norm() > 1e-6) axis.normalize();
    }
  }

  std::optional<GarmentHoop> Trace(const SewnEdge& start) const;
  // Says whether the seam that the hoop starts on is the one that gives way, of those that it crosses.
  static bool StartsWhereItOpens(const GarmentHoop& hoop, const std::vector<Eigen::Vector3d>& crossings);

  const ClothMesh& mesh_;
  std::map<Edge, std::vector<int>> triangles_of_edge_;
  std::vector<std::vector<int>> pairs_of_vertex_;
  std::map<Edge, SewnEdge> sewn_edges_;
  std::array<Eigen::Vector3d, 2> sleeve_axes_ = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  // Left, right.
};

std::optional<GarmentHoop> HoopTracer::Trace(const SewnEdge& start) const {
  const int sleeve = SleeveOf(start);
  const Eigen::Vector3d axis =
      sleeve == 0 ? Eigen::Vector3d(Eigen::Vector3d::UnitY()) : sleeve_axes_[sleeve > 0 ? 0 : 1];
  if (axis.isZero()) return std::nullopt;
  GarmentHoop hoop;
  hoop.pairs = start.pairs;
  hoop.is_sleeve = sleeve != 0;
  hoop.seam_length = (Rest(start.vertices[1]) - Rest(start.vertices[0])).norm();
  EdgePoint at = {start.vertices[0], start.vertices[1], 0.5};
  hoop.rest_start = at.In(mesh_.rest_positions);
  std::vector<Eigen::Vector3d> crossings = {hoop.rest_start};
  hoop.parts.push_back({at});
  int triangle = triangles_of_edge_.at(EdgeOf(at.p, at.q)).front();
  for (size_t count = 0; count < kMostCrossings; ++count) {
    // Out of the triangle by the one of its two other edges that the level crosses.
    const double level = axis.dot(at.In(mesh_.rest_positions));
    const Eigen::Vector3i& corners = mesh_.triangles[static_cast<size_t>(triangle)];
    const int opposite = corners.sum() - at.p - at.q;
    const double height_p = axis.dot(Rest(at.p)) - level;
    const double height_o = axis.dot(Rest(opposite)) - level;
    const int other = (height_p >= 0.0) != (height_o >= 0.0) ? at.p : at.q;
    const double height = axis.dot(Rest(other)) - level;
    if ((height >= 0.0) == (height_o >= 0.0)) return std::nullopt;  // The edge itself is level.
    const EdgePoint out = {other, opposite, height / (height - height_o)};
    hoop.rest_length += (out.In(mesh_.rest_positions) - at.In(mesh_.rest_positions)).norm();
    hoop.parts.back().push_back(out);
    const Edge edge = EdgeOf(out.p, out.q);
    const std::vector<int>& sides = triangles_of_edge_.at(edge);
    at = out;
    if (sides.size() == 2) {
      triangle = sides[0] == triangle ? sides[1] : sides[0];
      continue;
    }
    const auto sewn = sewn_edges_.find(edge);
    if (sides.size() != 1 || sewn == sewn_edges_.end()) return std::nullopt;  // An opening.
    const bool along = sewn->second.vertices[0] == out.p;
    at = {sewn->second.partners[along ? 0 : 1], sewn->second.partners[along ? 1 : 0], out.t};
    const Eigen::Vector3d place = at.In(mesh_.rest_positions);
    const bool is_home = triangles_of_edge_.at(EdgeOf(start.vertices[0], start.vertices[1])) ==
                             triangles_of_edge_.at(EdgeOf(at.p, at.q)) ||
                         ((place - hoop.rest_start).norm() < kSameGround && crossings.size() > 1 &&
                          mesh_.panel_of_particle.size() == mesh_.rest_positions.size() &&
                          mesh_.panel_of_particle[static_cast<size_t>(at.p)] ==
                              mesh_.panel_of_particle[static_cast<size_t>(start.vertices[0])]);
    if (is_home) {
      if (!StartsWhereItOpens(hoop, crossings)) return std::nullopt;
      return hoop;
    }
    crossings.push_back(place);
    triangle = triangles_of_edge_.at(EdgeOf(at.p, at.q)).front();
    hoop.parts.push_back({at});
  }
  return std::nullopt;
}

bool HoopTracer::StartsWhereItOpens(const GarmentHoop& hoop, const std::vector<Eigen::Vector3d>& crossings) {
  const auto before = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return hoop.is_sleeve ? a.y() < b.y() : a.x() < b.x();
  };
  const auto [low, high] = std::minmax_element(crossings.begin(), crossings.end(), before);
  if (hoop.is_sleeve) return low == crossings.begin();
  const double width = high->x() - low->x();
  const bool is_right_leg = 0.5 * (high->x() + low->x()) < -kOneSided * width;
  return (is_right_leg ? low : high) == crossings.begin();
}

}  // namespace

double GarmentHoop::ClothLength(std::span<const Eigen::Vector3d> positions) const {
  double length = 0.0;
  for (const std::vector<EdgePoint>& part : parts) {
    for (size_t k = 1; k < part.size(); ++k) length += (part[k].In(positions) - part[k - 1].In(positions)).norm();
  }
  return length;
}

std::vector<GarmentHoop> FindHoops(const ClothMesh& mesh) {
  if (mesh.seams.empty() || mesh.triangles.empty()) return {};
  return HoopTracer(mesh).TraceAll();
}

}  // namespace fitroom
