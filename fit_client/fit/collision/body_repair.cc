#include "fit_client/fit/collision/body_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fit_client/fit/collision/half_edges.h"

namespace fitroom {
namespace {

constexpr double kSamePlace = 1e-5;     // Vertices in one cell of this size are one (unit: metre).
constexpr double kSmallestPart = 0.05;  // Parts with less than this share of the largest one's area are dropped.

using Triangles = std::vector<Eigen::Vector3i>;

int FindRoot(std::vector<int>& parent, int index) {
  while (parent[static_cast<size_t>(index)] != index) {
    parent[static_cast<size_t>(index)] = parent[static_cast<size_t>(parent[static_cast<size_t>(index)])];
    index = parent[static_cast<size_t>(index)];
  }
  return index;
}

Status CheckScan(const TriangleMesh& scan) {
  if (scan.triangles.empty()) return InvalidArgument("BODY_WITHOUT_TRIANGLES", "the body has no triangles");
  for (const Eigen::Vector3d& vertex : scan.vertices) {
    if (!vertex.allFinite() || vertex.cwiseAbs().maxCoeff() > 1e4) {
      return InvalidArgument("BODY_COORDINATE_OUT_OF_RANGE", "a body vertex is not finite or over 10 km away");
    }
  }
  for (const Eigen::Vector3i& triangle : scan.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= static_cast<int>(scan.vertices.size())) {
      return InvalidArgument("BODY_INDEX_OUT_OF_RANGE", "a triangle of the body names a vertex that does not exist");
    }
  }
  return Status();
}

// Returns for each vertex the first vertex in the same place.
std::vector<int> JoinVertices(const std::vector<Eigen::Vector3d>& vertices) {
  struct Keyed {
    std::array<int64_t, 3> cell;
    int vertex;
  };
  std::vector<Keyed> keyed;
  keyed.reserve(vertices.size());
  for (size_t vertex = 0; vertex < vertices.size(); ++vertex) {
    const auto cell = [&](int axis) { return static_cast<int64_t>(std::llround(vertices[vertex][axis] / kSamePlace)); };
    keyed.push_back({{cell(0), cell(1), cell(2)}, static_cast<int>(vertex)});
  }
  std::sort(keyed.begin(), keyed.end(),
            [](const Keyed& a, const Keyed& b) { return a.cell != b.cell ? a.cell < b.cell : a.vertex < b.vertex; });
  std::vector<int> joined(vertices.size());
  for (size_t index = 0; index < keyed.size(); ++index) {
    const bool same = index > 0 && keyed[index].cell == keyed[index - 1].cell;
    joined[static_cast<size_t>(keyed[index].vertex)] =
        same ? joined[static_cast<size_t>(keyed[index - 1].vertex)] : keyed[index].vertex;
  }
  return joined;
}

// Drops triangles without an area by their indices, and all but the first of those with the same three vertices.
void DropDoubles(Triangles& triangles) {
  const auto sorted = [](Eigen::Vector3i t) {
    std::sort(t.data(), t.data() + 3);
    return std::array<int, 3>{t[0], t[1], t[2]};
  };
  std::erase_if(triangles, [](const Eigen::Vector3i& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  std::vector<size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::vector<std::array<int, 3>> keys;
  keys.reserve(triangles.size());
  for (const Eigen::Vector3i& triangle : triangles) keys.push_back(sorted(triangle));
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  std::vector<bool> drop(triangles.size(), false);
  for (size_t index = 1; index < order.size(); ++index) {
    drop[order[index]] = keys[order[index]] == keys[order[index - 1]];
  }
  size_t kept = 0;
  for (size_t index = 0; index < triangles.size(); ++index) {
    if (!drop[index]) triangles[kept++] = triangles[index];
  }
  triangles.resize(kept);
}

double AreaOf(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3i& t) {
  const Eigen::Vector3d& a = vertices[static_cast<size_t>(t[0])];
  return 0.5 * (vertices[static_cast<size_t>(t[1])] - a).cross(vertices[static_cast<size_t>(t[2])] - a).norm();
}

// Drops the parts that are small beside the largest one: islands that a scanner sees in the air.
void DropIslands(const std::vector<Eigen::Vector3d>& vertices, Triangles& triangles) {
  std::vector<int> parent(vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Eigen::Vector3i& t : triangles) {
    for (const int other : {t[1], t[2]}) {
      const int a = FindRoot(parent, t[0]);
      const int b = FindRoot(parent, other);
      parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<double> area(vertices.size(), 0.0);
  for (const Eigen::Vector3i& t : triangles) {
    area[static_cast<size_t>(FindRoot(parent, t[0]))] += AreaOf(vertices, t);
  }
  const double smallest = kSmallestPart * *std::max_element(area.begin(), area.end());
  std::erase_if(triangles,
                [&](const Eigen::Vector3i& t) { return area[static_cast<size_t>(FindRoot(parent, t[0]))] < smallest; });
}

using DirectedEdges = std::unordered_map<uint64_t, int>;

uint64_t EdgeKey(int from, int to) {
  return (static_cast<uint64_t>(static_cast<uint32_t>(from)) << 32) | static_cast<uint32_t>(to);
}

// Turns neighbours to face the same way, walking from triangle to triangle, and drops a triangle that wants a directed
// edge that another one has. Afterwards each directed edge belongs to at most one triangle.
void OrientAndThin(Triangles& triangles) {
  std::unordered_map<uint64_t, std::vector<int>> triangles_of_edge;
  triangles_of_edge.reserve(triangles.size() * 2);
  const auto undirected = [](int a, int b) { return EdgeKey(std::min(a, b), std::max(a, b)); };
  for (size_t index = 0; index < triangles.size(); ++index) {
    const Eigen::Vector3i& t = triangles[index];
    for (int k = 0; k < 3; ++k) triangles_of_edge[undirected(t[k], t[(k + 1) % 3])].push_back(static_cast<int>(index));
  }
  DirectedEdges owner;
  owner.reserve(triangles.size() * 3);
  std::vector<char> state(triangles.size(), 0);  // 0 not seen, 1 queued, 2 kept, 3 dropped.
  std::vector<int> queue;
  for (size_t seed = 0; seed < triangles.size(); ++seed) {
    if (state[seed] != 0) continue;
    queue.assign(1, static_cast<int>(seed));
    state[seed] = 1;
    for (size_t next = 0; next < queue.size(); ++next) {
      const size_t index = static_cast<size_t>(queue[next]);
      Eigen::Vector3i& t = triangles[index];
      const auto conflicts = [&](const Eigen::Vector3i& c) {
        return static_cast<int>(owner.contains(EdgeKey(c[0], c[1]))) +
               static_cast<int>(owner.contains(EdgeKey(c[1], c[2]))) +
               static_cast<int>(owner.contains(EdgeKey(c[2], c[0])));
      };
      const Eigen::Vector3i turned(t[0], t[2], t[1]);
      if (conflicts(t) > 0) {
        if (conflicts(turned) > 0) {
          state[index] = 3;
          continue;
        }
        t = turned;
      }
      state[index] = 2;
      for (int k = 0; k < 3; ++k) {
        owner[EdgeKey(t[k], t[(k + 1) % 3])] = static_cast<int>(index);
        const std::vector<int>& neighbours = triangles_of_edge[undirected(t[k], t[(k + 1) % 3])];
        if (neighbours.size() > 2) continue;  // Which of many belongs on the other side is not known here.
        for (const int neighbour : neighbours) {
          if (state[static_cast<size_t>(neighbour)] != 0) continue;
          state[static_cast<size_t>(neighbour)] = 1;
          queue.push_back(neighbour);
        }
      }
    }
  }
  size_t kept = 0;
  for (size_t index = 0; index < triangles.size(); ++index) {
    if (state[index] == 2) triangles[kept++] = triangles[index];
  }
  triangles.resize(kept);
}

// Returns the border as closed walks, each vertex at most once a walk, in the direction that filling triangles need.
std::vector<std::vector<int>> FindHoles(const Triangles& triangles) {
  DirectedEdges owner;
  owner.reserve(triangles.size() * 3);
  for (size_t index = 0; index < triangles.size(); ++index) {
    const Eigen::Vector3i& t = triangles[index];
    for (int k = 0; k < 3; ++k) owner[EdgeKey(t[k], t[(k + 1) % 3])] = static_cast<int>(index);
  }
  std::vector<std::pair<int, int>> border;  // From, to; sorted, so that the order does not depend on hashing.
  for (const Eigen::Vector3i& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (!owner.contains(EdgeKey(t[(k + 1) % 3], t[k]))) border.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::sort(border.begin(), border.end());
  std::vector<bool> used(border.size(), false);
  const auto next_edge = [&](int from) {
    for (auto place = std::lower_bound(border.begin(), border.end(), std::pair(from, -1));
         place != border.end() && place->first == from; ++place) {
      const size_t index = static_cast<size_t>(place - border.begin());
      if (!used[index]) return static_cast<int>(index);
    }
    return -1;
  };
  std::vector<std::vector<int>> holes;
  std::unordered_map<int, size_t> place_in_walk;
  for (size_t start = 0; start < border.size(); ++start) {
    std::vector<int> walk;
    place_in_walk.clear();
    for (int edge = used[start] ? -1 : static_cast<int>(start); edge >= 0;) {
      used[static_cast<size_t>(edge)] = true;
      const auto [from, to] = border[static_cast<size_t>(edge)];
      place_in_walk[from] = walk.size();
      walk.push_back(from);
      if (const auto seen = place_in_walk.find(to); seen != place_in_walk.end()) {
        // Back at a vertex of this walk: what lies between is a hole of its own.
        const size_t begin = seen->second;
        holes.emplace_back(walk.begin() + static_cast<std::ptrdiff_t>(begin), walk.end());
        for (size_t index = begin; index < walk.size(); ++index) place_in_walk.erase(walk[index]);
        walk.resize(begin);
        if (walk.empty()) break;
      }
      edge = next_edge(to);
    }
  }
  return holes;
}

// Fills one hole: again and again the corner whose two neighbours are closest is clipped, so that the filling stays a
// tight membrane. The chord of a clipped corner must not be an edge of the surface already.
void FillHole(const std::vector<int>& hole, const std::vector<Eigen::Vector3d>& vertices, DirectedEdges& owner,
              Triangles& triangles) {
  const int count = static_cast<int>(hole.size());
  std::vector<int> next(hole.size());
  std::vector<int> previous(hole.size());
  std::vector<int> version(hole.size(), 0);
  for (int index = 0; index < count; ++index) {
    next[static_cast<size_t>(index)] = (index + 1) % count;
    previous[static_cast<size_t>(index)] = (index + count - 1) % count;
  }
  const auto at = [&](int index) { return hole[static_cast<size_t>(index)]; };
  const auto place = [&](int index) { return vertices[static_cast<size_t>(at(index))]; };
  struct Ear {
    double chord;
    int index;
    int version;
    bool operator<(const Ear& other) const { return chord != other.chord ? chord > other.chord : index > other.index; }
  };
  std::priority_queue<Ear> ears;
  const auto push = [&](int index) {
    const int before = previous[static_cast<size_t>(index)];
    const int after = next[static_cast<size_t>(index)];
    double chord = (place(before) - place(after)).norm();
    if (owner.contains(EdgeKey(at(before), at(after))) || owner.contains(EdgeKey(at(after), at(before)))) chord += 1e3;
    ears.push({chord, index, version[static_cast<size_t>(index)]});
  };
  const auto add = [&](int a, int b, int c) {
    triangles.emplace_back(at(a), at(b), at(c));
    const int triangle = static_cast<int>(triangles.size()) - 1;
    owner[EdgeKey(at(a), at(b))] = owner[EdgeKey(at(b), at(c))] = owner[EdgeKey(at(c), at(a))] = triangle;
  };
  for (int index = 0; index < count; ++index) push(index);
  int left = count;
  while (left > 3 && !ears.empty()) {
    const Ear ear = ears.top();
    ears.pop();
    if (ear.version != version[static_cast<size_t>(ear.index)]) continue;
    const int before = previous[static_cast<size_t>(ear.index)];
    const int after = next[static_cast<size_t>(ear.index)];
    add(before, ear.index, after);
    next[static_cast<size_t>(before)] = after;
    previous[static_cast<size_t>(after)] = before;
    version[static_cast<size_t>(ear.index)] = -1;
    --left;
    for (const int changed : {before, after}) {
      ++version[static_cast<size_t>(changed)];
      push(changed);
    }
  }
  for (int index = 0; index < count; ++index) {
    if (version[static_cast<size_t>(index)] < 0) continue;
    if (left == 3) {
      add(index, next[static_cast<size_t>(index)], next[static_cast<size_t>(next[static_cast<size_t>(index)])]);
    }
    break;
  }
}

double SignedVolume(const std::vector<Eigen::Vector3d>& vertices, const Triangles& triangles) {
  double six_volumes = 0.0;
  for (const Eigen::Vector3i& t : triangles) {
    six_volumes += vertices[static_cast<size_t>(t[0])].dot(
        vertices[static_cast<size_t>(t[1])].cross(vertices[static_cast<size_t>(t[2])]));
  }
  return six_volumes / 6.0;
}

}  // namespace

Result<TriangleMesh> RepairBody(const TriangleMesh& scan) {
  FR_RETURN_IF_ERROR(CheckScan(scan));
  TriangleMesh body;
  body.vertices = scan.vertices;
  body.triangles = scan.triangles;
  if (!IsClosed(body.triangles, body.vertices.size())) {
    const std::vector<int> joined = JoinVertices(body.vertices);
    for (Eigen::Vector3i& t : body.triangles) {
      for (int& corner : t) corner = joined[static_cast<size_t>(corner)];
    }
    DropDoubles(body.triangles);
    if (body.triangles.empty()) {
      return InvalidArgument("BODY_WITHOUT_TRIANGLES", "the body has no triangles of positive area");
    }
    DropIslands(body.vertices, body.triangles);
    OrientAndThin(body.triangles);
    DirectedEdges owner;
    const std::vector<std::vector<int>> holes = FindHoles(body.triangles);
    for (size_t index = 0; index < body.triangles.size(); ++index) {
      const Eigen::Vector3i& t = body.triangles[index];
      for (int k = 0; k < 3; ++k) owner[EdgeKey(t[k], t[(k + 1) % 3])] = static_cast<int>(index);
    }
    for (const std::vector<int>& hole : holes) FillHole(hole, body.vertices, owner, body.triangles);
  }
  const double volume = SignedVolume(body.vertices, body.triangles);
  if (volume < 0.0) {
    for (Eigen::Vector3i& t : body.triangles) std::swap(t[1], t[2]);
  }
  return body;
}

}  // namespace fitroom
