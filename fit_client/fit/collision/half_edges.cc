#include "fit_client/fit/collision/half_edges.h"

#include <algorithm>

namespace fitroom {
namespace {

struct HalfEdge {
  int32_t high = 0;    // The edge's larger vertex; the smaller one is the bucket.
  int32_t corner = 0;  // 3 * triangle + corner.
};

}  // namespace

EdgeList ListEdges(std::span<const Eigen::Vector3i> triangles, size_t vertex_count) {
  std::vector<uint32_t> begin(vertex_count + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (size_t triangle = 0; triangle < triangles.size(); ++triangle) {
      for (int corner = 0; corner < 3; ++corner) {
        const int from = triangles[triangle][corner];
        const int to = triangles[triangle][corner == 2 ? 0 : corner + 1];
        visit(static_cast<size_t>(std::min(from, to)),
              HalfEdge{std::max(from, to), static_cast<int32_t>(3 * triangle) + corner});
      }
    }
  };
  for_each([&](size_t low, const HalfEdge&) { ++begin[low + 1]; });
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) begin[vertex + 1] += begin[vertex];
  std::vector<HalfEdge> bucketed(begin.back());
  std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
  for_each([&](size_t low, const HalfEdge& edge) { bucketed[next[low]++] = edge; });

  EdgeList edges;
  edges.edge_of_corner.resize(3 * triangles.size());
  edges.corners.reserve(bucketed.size());
  edges.begin.reserve(bucketed.size() / 2 + 1);
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
    // A few entries as a rule; sorted, so that a vertex with thousands of triangles costs no square of them.
    std::sort(
        bucketed.begin() + begin[vertex], bucketed.begin() + begin[vertex + 1],
        [](const HalfEdge& a, const HalfEdge& b) { return a.high != b.high ? a.high < b.high : a.corner < b.corner; });
    for (uint32_t index = begin[vertex]; index < begin[vertex + 1]; ++index) {
      if (index == begin[vertex] || bucketed[index].high != bucketed[index - 1].high) edges.begin.push_back(index);
      edges.edge_of_corner[static_cast<size_t>(bucketed[index].corner)] = static_cast<int32_t>(edges.begin.size()) - 1;
      edges.corners.push_back(bucketed[index].corner);
    }
  }
  edges.begin.push_back(static_cast<uint32_t>(edges.corners.size()));
  return edges;
}

std::vector<int32_t> FindTwins(std::span<const Eigen::Vector3i> triangles, size_t vertex_count) {
  const EdgeList edges = ListEdges(triangles, vertex_count);
  const auto start_of = [&](int32_t corner) { return triangles[static_cast<size_t>(corner / 3)][corner % 3]; };
  std::vector<int32_t> twins(3 * triangles.size(), -1);
  for (size_t edge = 0; edge + 1 < edges.begin.size(); ++edge) {
    const uint32_t first = edges.begin[edge];
    if (edges.begin[edge + 1] - first != 2) continue;
    const int32_t a = edges.corners[first];
    const int32_t b = edges.corners[first + 1];
    if (start_of(a) == start_of(b)) continue;
    twins[static_cast<size_t>(a)] = b;
    twins[static_cast<size_t>(b)] = a;
  }
  return twins;
}

bool IsClosed(std::span<const Eigen::Vector3i> triangles, size_t vertex_count) {
  const std::vector<int32_t> twins = FindTwins(triangles, vertex_count);
  return std::none_of(twins.begin(), twins.end(), [](int32_t twin) { return twin < 0; });
}

}  // namespace fitroom
