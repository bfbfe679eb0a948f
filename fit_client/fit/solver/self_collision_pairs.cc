#include "fit_client/fit/solver/self_collision_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom {
namespace {

using Eigen::Vector3f;

constexpr int kTaskCount = 16;
constexpr float kBeyond = 0.03F;         // Places so far outside a triangle or edge still count (unit: its size).
constexpr float kLeastSine = 0.15F;      // Edges that are more nearly parallel are left to vertices and triangles.
constexpr float kRoundGradient = 0.15F;  // Gradients of the contour's length below this move less than a full step.
constexpr uint64_t kEdgePair = uint64_t{1} << 63U;

uint64_t KeyOf(int first, int second) {
  return (static_cast<uint64_t>(static_cast<uint32_t>(first)) << 32U) | static_cast<uint32_t>(second);
}

// Looks at all that is near one range of particles.
class EncounterSearch {
 public:
  EncounterSearch(const ClothModel& model, const SelfCollisionTopology& topology, const NumberLists& near,
                  std::span<const Float4> positions, std::span<const Float4> planes, std::span<const Float4> middles,
                  float reach)
      : model_(model),
        topology_(topology),
        near_(near),
        positions_(positions),
        planes_(planes),
        middles_(middles),
        reach_(reach),
        triangle_marks_(planes.size(), 0),
        edge_marks_(middles.size(), 0) {}

  void LookAtVertices(int begin, int end, std::vector<ClothContact>& contacts);
  void LookAtEdges(int begin, int end, std::vector<ClothContact>& contacts, std::vector<ClothCrossing>& crossings);

 private:
  Vector3f At(int particle) const {
    const Float4& at = positions_[static_cast<size_t>(particle)];
    return {at.x, at.y, at.z};
  }
  float Height(int triangle, int particle) const {
    const Float4& plane = planes_[static_cast<size_t>(triangle)];
    const Float4& at = positions_[static_cast<size_t>(particle)];
    return plane.x * at.x + plane.y * at.y + plane.z * at.z - plane.w;
  }
  void AddVertexContact(int particle, int triangle, std::vector<ClothContact>& contacts) const;
  void AddEdgeContact(int first, int second, std::vector<ClothContact>& contacts) const;
  void AddCrossing(int edge, int triangle, std::vector<ClothCrossing>& crossings) const;
  void Finish(ClothContact& contact, const Vector3f& normal, float gap) const;
  // Whether two edges are so near that a contact between them is possible.
  bool AreNear(int first, int second) const {
    const Float4& a = middles_[static_cast<size_t>(first)];
    const Float4& b = middles_[static_cast<size_t>(second)];
    const float x = a.x - b.x;
    const float y = a.y - b.y;
    const float z = a.z - b.z;
    const float reach = (1.0F + 2.0F * kBeyond) * (a.w + b.w) + reach_;
    return x * x + y * y + z * z <= reach * reach;
  }
  // The items of the lists of `particles`' near ones that are to be kept, each once, ascending. Most are met several
  // times: `marks`, one an item, tells those that were looked at.
  template <typename Keep>
  void Collect(std::span<const int> particles, const NumberLists& lists, std::vector<int>& marks, const Keep& keep);

  const ClothModel& model_;
  const SelfCollisionTopology& topology_;
  const NumberLists& near_;
  std::span<const Float4> positions_;
  std::span<const Float4> planes_;   // One a triangle: unit normal, offset.
  std::span<const Float4> middles_;  // One an edge: its middle, half its length.
  float reach_;
  std::vector<int> triangle_marks_;
  std::vector<int> edge_marks_;
  int mark_ = 0;  // Of the current collection.
  std::vector<int> candidates_;
};

template <typename Keep>
void EncounterSearch::Collect(std::span<const int> particles, const NumberLists& lists, std::vector<int>& marks,
                              const Keep& keep) {
  candidates_.clear();
  ++mark_;
  for (const int particle : particles) {
    for (const int other : near_.Of(particle)) {
      for (const int item : lists.Of(other)) {
        int& mark = marks[static_cast<size_t>(item)];
        if (mark == mark_) continue;
        mark = mark_;
        if (keep(item)) candidates_.push_back(item);
      }
    }
  }
  std::sort(candidates_.begin(), candidates_.end());
}

// Completes a contact from its particles, weights and the direction from the second place to the first.
void EncounterSearch::Finish(ClothContact& contact, const Vector3f& normal, float gap) const {
  contact.side = gap >= 0.0F ? 1 : -1;
  const Vector3f outwards = gap >= 0.0F ? normal : Vector3f(-normal);
  contact.normal = {outwards.x(), outwards.y(), outwards.z(), std::abs(gap)};
  float sum = 0.0F;
  for (size_t place = 0; place < 4; ++place) {
    sum +=
        contact.weights[place] * contact.weights[place] * positions_[static_cast<size_t>(contact.particles[place])].w;
  }
  contact.scale = sum > 0.0F ? 1.0F / sum : 0.0F;
}

void EncounterSearch::AddVertexContact(int particle, int triangle, std::vector<ClothContact>& contacts) const {
  const float height = Height(triangle, particle);
  if (std::abs(height) > reach_) return;
  const auto& [i, j, k] = model_.triangles()[static_cast<size_t>(triangle)];
  if (i == particle || j == particle || k == particle) return;
  const Vector3f a = At(i);
  const Vector3f ab = At(j) - a;
  const Vector3f ac = At(k) - a;
  const Vector3f ap = At(particle) - a;
  const Vector3f normal = ab.cross(ac);
  const float squared = normal.squaredNorm();
  if (!(squared > std::numeric_limits<float>::min())) return;
  const float at_b = ap.cross(ac).dot(normal) / squared;
  const float at_c = ab.cross(ap).dot(normal) / squared;
  const float at_a = 1.0F - at_b - at_c;
  if (std::min({at_a, at_b, at_c}) < -kBeyond) return;
  ClothContact contact;
  contact.particles = {particle, i, j, k};
  contact.weights = {1.0F, -at_a, -at_b, -at_c};
  contact.key = KeyOf(particle, triangle);
  Finish(contact, normal / std::sqrt(squared), height);
  contacts.push_back(contact);
}

void EncounterSearch::AddEdgeContact(int first, int second, std::vector<ClothContact>& contacts) const {
  const auto& [i, j] = model_.edges()[static_cast<size_t>(first)];
  const auto& [k, l] = model_.edges()[static_cast<size_t>(second)];
  if (i == k || i == l || j == k || j == l) return;
  const Vector3f a = At(i);
  const Vector3f c = At(k);
  const Vector3f u = At(j) - a;
  const Vector3f v = At(l) - c;
  const Vector3f w = a - c;
  const Vector3f normal = u.cross(v);
  const float squared = normal.squaredNorm();
  const float uu = u.squaredNorm();
  const float vv = v.squaredNorm();
  if (!(squared > kLeastSine * kLeastSine * uu * vv)) return;
  const float gap = w.dot(normal);
  if (gap * gap > reach_ * reach_ * squared) return;
  const float uv = u.dot(v);
  const float s = (uv * v.dot(w) - vv * u.dot(w)) / squared;
  const float t = (uu * v.dot(w) - uv * u.dot(w)) / squared;
  if (std::min(s, t) < -kBeyond || std::max(s, t) > 1.0F + kBeyond) return;
  ClothContact contact;
  contact.particles = {i, j, k, l};
  contact.weights = {1.0F - s, s, t - 1.0F, -t};
  contact.key = kEdgePair | KeyOf(first, second);
  const float length = std::sqrt(squared);
  Finish(contact, normal / length, gap / length);
  contacts.push_back(contact);
}

void EncounterSearch::AddCrossing(int edge, int triangle, std::vector<ClothCrossing>& crossings) const {
  const auto& [p, q] = model_.edges()[static_cast<size_t>(edge)];
  const auto& [i, j, k] = model_.triangles()[static_cast<size_t>(triangle)];
  if (i == p || i == q || j == p || j == q || k == p || k == q) return;
  const Vector3f a = At(i);
  const Vector3f ab = At(j) - a;
  const Vector3f ac = At(k) - a;
  const Vector3f at_p = At(p);
  const Vector3f along = At(q) - at_p;
  if (!SegmentCrossesTriangle(at_p.cast<double>(), At(q).cast<double>(), a.cast<double>(), At(j).cast<double>(),
                              At(k).cast<double>())) {
    return;
  }
  const Vector3f normal = ab.cross(ac);
  const float across = along.dot(normal);
  const float squared = normal.squaredNorm();
  if (!(squared > std::numeric_limits<float>::min()) || across == 0.0F) return;
  ClothCrossing crossing;
  crossing.edge = edge;
  crossing.triangle = triangle;
  const float s = std::clamp((a - at_p).dot(normal) / across, 0.0F, 1.0F);
  const Vector3f ap = at_p + s * along - a;
  const float at_b = std::clamp(ap.cross(ac).dot(normal) / squared, 0.0F, 1.0F);
  const float at_c = std::clamp(ab.cross(ap).dot(normal) / squared, 0.0F, 1.0F - at_b);
  crossing.edge_weights = {1.0F - s, s};
  crossing.triangle_weights = {1.0F - at_b - at_c, at_b, at_c};
  const Vector3f unit = normal * ((across > 0.0F ? 1.0F : -1.0F) / std::sqrt(squared));
  crossing.normal = {unit.x(), unit.y(), unit.z(), 0.0F};
  Vector3f gradient = Vector3f::Zero();
  for (const int side : topology_.triangles_of_edge[static_cast<size_t>(edge)]) {
    if (side < 0) continue;
    int opposite = -1;
    for (const int corner : model_.triangles()[static_cast<size_t>(side)]) {
      if (corner != p && corner != q) opposite = corner;
    }
    if (opposite < 0) continue;
    // From the place that is common to both into the triangle beside the edge, along the cut.
    const Vector3f to_opposite = At(opposite) - at_p;
    const Vector3f inwards = to_opposite - along * (to_opposite.dot(along) / along.squaredNorm());
    Vector3f cut = along.cross(to_opposite).cross(normal);
    const float length = cut.norm();
    if (!(length > std::numeric_limits<float>::min())) continue;
    cut *= (cut.dot(inwards) >= 0.0F ? 1.0F : -1.0F) / length;
    gradient += cut - unit * (2.0F * along.dot(cut) / along.dot(unit));
  }
  const Vector3f way = gradient / std::sqrt(gradient.squaredNorm() + kRoundGradient * kRoundGradient);
  if (!way.allFinite()) return;
  crossing.way = {way.x(), way.y(), way.z(), 0.0F};
  crossings.push_back(crossing);
}

void EncounterSearch::LookAtVertices(int begin, int end, std::vector<ClothContact>& contacts) {
  for (int particle = begin; particle < end; ++particle) {
    if (near_.Of(particle).empty()) continue;
    Collect({&particle, 1}, topology_.triangles_of_particle, triangle_marks_,
            [&](int triangle) { return std::abs(Height(triangle, particle)) <= reach_; });
    for (const int triangle : candidates_) AddVertexContact(particle, triangle, contacts);
  }
}

void EncounterSearch::LookAtEdges(int begin, int end, std::vector<ClothContact>& contacts,
                                  std::vector<ClothCrossing>& crossings) {
  for (int edge = begin; edge < end; ++edge) {
    const std::array<int, 2>& ends = model_.edges()[static_cast<size_t>(edge)];
    if (near_.Of(ends[0]).empty() && near_.Of(ends[1]).empty()) continue;
    Collect(ends, topology_.edges_of_particle, edge_marks_,
            [&](int other) { return other > edge && AreNear(edge, other); });
    for (const int other : candidates_) AddEdgeContact(edge, other, contacts);
    Collect(ends, topology_.triangles_of_particle, triangle_marks_,
            [&](int triangle) { return (Height(triangle, ends[0]) < 0.0F) != (Height(triangle, ends[1]) < 0.0F); });
    for (const int triangle : candidates_) AddCrossing(edge, triangle, crossings);
  }
}

}  // namespace

ClothEncounters FindEncounters(const ClothModel& model, const SelfCollisionTopology& topology, const NumberLists& near,
                               std::span<const Float4> positions, float reach, Executor& executor) {
  const auto begin_of = [](int task, size_t count) {
    return static_cast<int>(count * static_cast<size_t>(task) / static_cast<size_t>(kTaskCount));
  };
  const size_t triangle_count = model.triangles().size();
  std::vector<Float4> planes(triangle_count);
  executor.Run(kTaskCount, [&](int task) {
    for (int index = begin_of(task, triangle_count); index < begin_of(task + 1, triangle_count); ++index) {
      const auto& corners = model.triangles()[static_cast<size_t>(index)];
      if (near.Of(corners[0]).empty() && near.Of(corners[1]).empty() && near.Of(corners[2]).empty()) continue;
      const auto at = [&](size_t corner) {
        const Float4& place = positions[static_cast<size_t>(corners[corner])];
        return Vector3f(place.x, place.y, place.z);
      };
      const Vector3f normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      planes[static_cast<size_t>(index)] = {normal.x(), normal.y(), normal.z(), normal.dot(at(0))};
    }
  });
  const size_t edge_count = model.edges().size();
  std::vector<Float4> middles(edge_count);
  executor.Run(kTaskCount, [&](int task) {
    for (int index = begin_of(task, edge_count); index < begin_of(task + 1, edge_count); ++index) {
      const auto& [i, j] = model.edges()[static_cast<size_t>(index)];
      const Float4& a = positions[static_cast<size_t>(i)];
      const Float4& b = positions[static_cast<size_t>(j)];
      const Vector3f half(0.5F * (b.x - a.x), 0.5F * (b.y - a.y), 0.5F * (b.z - a.z));
      middles[static_cast<size_t>(index)] = {a.x + half.x(), a.y + half.y(), a.z + half.z(), half.norm()};
    }
  });
  std::vector<ClothEncounters> vertices(kTaskCount);
  std::vector<ClothEncounters> edges(kTaskCount);
  executor.Run(2 * kTaskCount, [&](int task) {
    EncounterSearch search(model, topology, near, positions, planes, middles, reach);
    const int part = task / 2;
    if (task % 2 == 0) {
      const size_t count = static_cast<size_t>(model.particle_count());
      search.LookAtVertices(begin_of(part, count), begin_of(part + 1, count),
                            vertices[static_cast<size_t>(part)].contacts);
    } else {
      const size_t count = model.edges().size();
      ClothEncounters& found = edges[static_cast<size_t>(part)];
      search.LookAtEdges(begin_of(part, count), begin_of(part + 1, count), found.contacts, found.crossings);
    }
  });
  ClothEncounters all;
  for (const std::vector<ClothEncounters>* parts : {&vertices, &edges}) {
    for (const ClothEncounters& part : *parts) {
      all.contacts.insert(all.contacts.end(), part.contacts.begin(), part.contacts.end());
      all.crossings.insert(all.crossings.end(), part.crossings.begin(), part.crossings.end());
    }
  }
  return all;
}

void TurnPartedPiecesBack(const ClothModel& model, std::span<ClothCrossing> crossings) {
  if (crossings.empty()) return;
  std::vector<char> is_cut(model.edges().size(), 0);
  for (const ClothCrossing& crossing : crossings) is_cut[static_cast<size_t>(crossing.edge)] = 1;
  std::vector<int> parent(static_cast<size_t>(model.particle_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](int particle) {
    while (parent[static_cast<size_t>(particle)] != particle) {
      parent[static_cast<size_t>(particle)] = parent[static_cast<size_t>(parent[static_cast<size_t>(particle)])];
      particle = parent[static_cast<size_t>(particle)];
    }
    return particle;
  };
  for (size_t index = 0; index < is_cut.size(); ++index) {
    if (is_cut[index] != 0) continue;
    const int a = root_of(model.edges()[index][0]);
    const int b = root_of(model.edges()[index][1]);
    parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<int> sizes(parent.size(), 0);
  for (int particle = 0; particle < model.particle_count(); ++particle) ++sizes[static_cast<size_t>(root_of(particle))];
  for (ClothCrossing& crossing : crossings) {
    const auto& [p, q] = model.edges()[static_cast<size_t>(crossing.edge)];
    const int part_of_p = root_of(p);
    const int part_of_q = root_of(q);
    if (part_of_p == part_of_q) continue;
    const float sign = sizes[static_cast<size_t>(part_of_p)] <= sizes[static_cast<size_t>(part_of_q)] ? 1.0F : -1.0F;
    crossing.way = {sign * crossing.normal.x, sign * crossing.normal.y, sign * crossing.normal.z, 0.0F};
  }
}

}  // namespace fitroom
