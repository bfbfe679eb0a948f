#include "fit_client/fit/collision/body_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
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

// Drops triangles that name a vertex twice, and all but the first of those with the same three vertices.
void DropDoubles(Triangles& triangles, size_t vertex_count) {
  std::erase_if(triangles, [](const Eigen::Vector3i& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  struct Entry {
    int middle;
    int high;
    size_t triangle;
  };
  std::vector<uint32_t> begin(vertex_count + 1, 0);
  for (const Eigen::Vector3i& t : triangles) ++begin[static_cast<size_t>(t.minCoeff()) + 1];
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) begin[vertex + 1] += begin[vertex];
  std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
  std::vector<Entry> entries(triangles.size());
  for (size_t index = 0; index < triangles.size(); ++index) {
    const Eigen::Vector3i& t = triangles[index];
    const int low = t.minCoeff();
    const int high = t.maxCoeff();
    entries[next[static_cast<size_t>(low)]++] = {t.sum() - low - high, high, index};
  }
  std::vector<bool> drop(triangles.size(), false);
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
    std::sort(entries.begin() + begin[vertex], entries.begin() + begin[vertex + 1], [](const Entry& a, const Entry& b) {
      return std::tie(a.middle, a.high, a.triangle) < std::tie(b.middle, b.high, b.triangle);
    });
    for (uint32_t index = begin[vertex] + 1; index < begin[vertex + 1]; ++index) {
      drop[entries[index].triangle] =
          entries[index].middle == entries[index - 1].middle && entries[index].high == entries[index - 1].high;
    }
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

uint64_t EdgeKey(int from, int to) {
  return (static_cast<uint64_t>(static_cast<uint32_t>(from)) << 32) | static_cast<uint32_t>(to);
}
using EdgeSet = std::unordered_set<uint64_t>;

// Turns neighbours to face the same way, walking from triangle to triangle, and drops a triangle that wants a directed
// edge that another one has. Afterwards each directed edge belongs to at most one triangle.
void OrientAndThin(Triangles& triangles, size_t vertex_count) {
  const EdgeList edges = ListEdges(triangles, vertex_count);
  std::vector<std::array<bool, 2>> taken(edges.begin.size(), {false, false});  // Per edge: falling, rising.
  enum class State : char { kUnseen, kQueued, kKept, kDropped };
  std::vector<State> state(triangles.size(), State::kUnseen);
  // Calls `visit` with each edge of a triangle and whether it rises, as the triangle stands or turned round.
  const auto for_each_edge = [&](size_t triangle, bool turned, const auto& visit) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3i& t = triangles[triangle];
      const bool rises = t[k] < t[(k + 1) % 3];
      visit(static_cast<size_t>(edges.edge_of_corner[3 * triangle + static_cast<size_t>(k)]), rises != turned);
    }
  };
  const auto is_free = [&](size_t triangle, bool turned) {
    bool all_free = true;
    for_each_edge(triangle, turned, [&](size_t edge, bool rises) { all_free = all_free && !taken[edge][rises]; });
    return all_free;
  };
  std::vector<bool> turn(triangles.size(), false);
  std::vector<size_t> queue;
  for (size_t seed = 0; seed < triangles.size(); ++seed) {
    if (state[seed] != State::kUnseen) continue;
    queue.assign(1, seed);
    state[seed] = State::kQueued;
    for (size_t next = 0; next < queue.size(); ++next) {
      const size_t triangle = queue[next];
      const bool turned = !is_free(triangle, false);
      if (turned && !is_free(triangle, true)) {
        state[triangle] = State::kDropped;
        continue;
      }
      state[triangle] = State::kKept;
      turn[triangle] = turned;
      for_each_edge(triangle, turned, [&](size_t edge, bool rises) {
        taken[edge][rises] = true;
        if (edges.begin[edge + 1] - edges.begin[edge] > 2) return;  // Which of many goes on here is not known.
        for (uint32_t entry = edges.begin[edge]; entry < edges.begin[edge + 1]; ++entry) {
          const size_t neighbour = static_cast<size_t>(edges.corners[entry] / 3);
          if (state[neighbour] != State::kUnseen) continue;
          state[neighbour] = State::kQueued;
          queue.push_back(neighbour);
        }
      });
    }
  }
  size_t kept = 0;
  for (size_t index = 0; index < triangles.size(); ++index) {
    if (state[index] != State::kKept) continue;
    if (turn[index]) std::swap(triangles[index][1], triangles[index][2]);
    triangles[kept++] = triangles[index];
  }
  triangles.resize(kept);
}

// Returns the border as closed walks, each vertex at most once a walk, in the direction that filling triangles need.
std::vector<std::vector<int>> FindHoles(const Triangles& triangles, size_t vertex_count) {
  const std::vector<int32_t> twins = FindTwins(triangles, vertex_count);
  std::vector<std::pair<int, int>> border;  // From, to.
  for (size_t index = 0; index < triangles.size(); ++index) {
    for (int k = 0; k < 3; ++k) {
      if (twins[3 * index + static_cast<size_t>(k)] >= 0) continue;
      border.emplace_back(triangles[index][(k + 1) % 3], triangles[index][k]);
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
void FillHole(const std::vector<int>& hole, const std::vector<Eigen::Vector3d>& vertices, EdgeSet& edges,
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
    if (edges.contains(EdgeKey(at(before), at(after))) || edges.contains(EdgeKey(at(after), at(before)))) chord += 1e3;
    ears.push({chord, index, version[static_cast<size_t>(index)]});
  };
  const auto add = [&](int a, int b, int c) {
    triangles.emplace_back(at(a), at(b), at(c));
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      edges.insert(EdgeKey(at(from), at(to)));
    }
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

void FillHoles(const std::vector<Eigen::Vector3d>& vertices, Triangles& triangles) {
  const std::vector<std::vector<int>> holes = FindHoles(triangles, vertices.size());
  std::vector<bool> is_border(vertices.size(), false);
  for (const std::vector<int>& hole : holes) {
    for (const int vertex : hole) is_border[static_cast<size_t>(vertex)] = true;
  }
  EdgeSet edges;  // Only edges between border vertices can be met again by a chord.
  for (const Eigen::Vector3i& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int from = t[k];
      const int to = t[(k + 1) % 3];
      if (is_border[static_cast<size_t>(from)] && is_border[static_cast<size_t>(to)]) edges.insert(EdgeKey(from, to));
    }
  }
  for (const std::vector<int>& hole : holes) FillHole(hole, vertices, edges, triangles);
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
    DropDoubles(body.triangles, body.vertices.size());
    if (body.triangles.empty()) {
      return InvalidArgument("BODY_WITHOUT_TRIANGLES", "the body has no triangles of positive area");
    }
    DropIslands(body.vertices, body.triangles);
    OrientAndThin(body.triangles, body.vertices.size());
    FillHoles(body.vertices, body.triangles);
  }
  const double volume = SignedVolume(body.vertices, body.triangles);
  if (volume < 0.0) {
    for (Eigen::Vector3i& t : body.triangles) std::swap(t[1], t[2]);
  }
  return body;
}

}  // namespace fitroom
