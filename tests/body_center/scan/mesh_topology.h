#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.h"

namespace fitroom::testing {

using EdgeCounts = std::map<std::pair<int, int>, int>;
inline EdgeCounts CountEdges(const TriangleMesh& mesh) {
  EdgeCounts counts;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++counts[{t[i], t[(i + 1) % 3]}];
  }
  return counts;
}

inline int BoundaryEdges(const TriangleMesh& mesh) {
  int boundary = 0;
  const EdgeCounts counts = CountEdges(mesh);
  for (const auto& [edge, count] : counts) boundary += counts.contains({edge.second, edge.first}) ? 0 : 1;
  return boundary;
}

inline int ComponentCount(const TriangleMesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&parent](int i) {
    while (parent[static_cast<size_t>(i)] != i)
      i = parent[static_cast<size_t>(i)] = parent[static_cast<size_t>(parent[static_cast<size_t>(i)])];
    return i;
  };
  for (const Eigen::Vector3i& t : mesh.triangles) {
    parent[static_cast<size_t>(root(t[0]))] = root(t[1]);
    parent[static_cast<size_t>(root(t[1]))] = root(t[2]);
  }
  std::set<int> roots;
  for (size_t i = 0; i < parent.size(); ++i) roots.insert(root(static_cast<int>(i)));
  return static_cast<int>(roots.size());
}

}  // namespace fitroom::testing
