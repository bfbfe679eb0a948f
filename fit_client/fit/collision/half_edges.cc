#include "fit_client/fit/collision/half_edges.h"

#include <algorithm>

namespace fitroom {
namespace {

struct HalfEdge {
  int32_t high = 0;    // The edge's larger vertex; the smaller one is the bucket.
  int32_t corner = 0;  // 3 * triangle + corner.
  bool rising = false;
};

}  // namespace

std::vector<int32_t> FindTwins(std::span<const Eigen::Vector3i> triangles, size_t vertex_count) {
  std::vector<uint32_t> begin(vertex_count + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (size_t triangle = 0; triangle < triangles.size(); ++triangle) {
      for (int corner = 0; corner < 3; ++corner) {
        const int from = triangles[triangle][corner];
        const int to = triangles[triangle][corner == 2 ? 0 : corner + 1];
        visit(static_cast<size_t>(std::min(from, to)),
              HalfEdge{std::max(from, to), static_cast<int32_t>(3 * triangle) + corner, from < to});
      }
    }
  };
  for_each([&](size_t low, const HalfEdge&) { ++begin[low + 1]; });
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) begin[vertex + 1] += begin[vertex];
  std::vector<HalfEdge> bucketed(begin.back());
  std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
  for_each([&](size_t low, const HalfEdge& edge) { bucketed[next[low]++] = edge; });

  std::vector<int32_t> twins(3 * triangles.size(), -1);
  for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
    const auto first = bucketed.begin() + begin[vertex];
    const auto last = bucketed.begin() + begin[vertex + 1];
    // A few entries as a rule; sorted, so that a vertex with thousands of triangles costs no square of them.
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    for (auto run = first; run != last;) {
      const auto run_end = std::find_if(run, last, [&](const HalfEdge& edge) { return edge.high != run->high; });
      if (run_end - run == 2 && run[0].rising != run[1].rising) {
        twins[static_cast<size_t>(run[0].corner)] = run[1].corner;
        twins[static_cast<size_t>(run[1].corner)] = run[0].corner;
      }
      run = run_end;
    }
  }
  return twins;
}

bool IsClosed(std::span<const Eigen::Vector3i> triangles, size_t vertex_count) {
  const std::vector<int32_t> twins = FindTwins(triangles, vertex_count);
  return std::none_of(twins.begin(), twins.end(), [](int32_t twin) { return twin < 0; });
}

}  // namespace fitroom
