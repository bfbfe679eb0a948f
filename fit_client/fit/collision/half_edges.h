#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// Returns for each corner k of each triangle t, at 3 t + k, the corner at which the triangle on the other side of the
// edge from k to k + 1 starts the same edge, or -1 where there is none: at a border, at an edge of three or more
// triangles, and between triangles that face opposite ways. Indices must lie in 0 ... vertex_count - 1.
std::vector<int32_t> FindTwins(std::span<const Eigen::Vector3i> triangles, size_t vertex_count);

// The undirected edges of a mesh, numbered.
struct EdgeList {
  std::vector<int32_t> edge_of_corner;  // At 3 t + k: the edge from corner k to k + 1 of triangle t.
  std::vector<uint32_t> begin;          // Per edge, plus one: where its corners start in `corners`.
  std::vector<int32_t> corners;         // 3 t + k of each triangle at the edge, ascending.
};
EdgeList ListEdges(std::span<const Eigen::Vector3i> triangles, size_t vertex_count);

// Says whether every edge has exactly two triangles that face the same way: a closed, oriented surface.
bool IsClosed(std::span<const Eigen::Vector3i> triangles, size_t vertex_count);

}  // namespace fitroom
