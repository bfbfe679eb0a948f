#include "fit_client/fit/panels/topology.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace fitroom {
namespace {

// Disjoint sets of particles; the root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int Root(int i) {
    while (parent_[static_cast<size_t>(i)] != i) {
      int& parent = parent_[static_cast<size_t>(i)];
      parent = parent_[static_cast<size_t>(parent)];
      i = parent;
    }
    return i;
  }

  void Join(int a, int b) {
    const int root_a = Root(a), root_b = Root(b);
    parent_[static_cast<size_t>(std::max(root_a, root_b))] = std::min(root_a, root_b);
  }

 private:
  std::vector<int> parent_;
};

int CountRoots(DisjointSets& sets, const std::vector<bool>& counted) {
  int count = 0;
  for (size_t i = 0; i < counted.size(); ++i) {
    if (counted[i] && sets.Root(static_cast<int>(i)) == static_cast<int>(i)) ++count;
  }
  return count;
}

}  // namespace

std::vector<int> WeldedParticles(const ClothMesh& mesh) {
  DisjointSets sets(mesh.rest_positions.size());
  for (const SeamPair& pair : mesh.seams) sets.Join(pair.a, pair.b);
  std::vector<int> welded(mesh.rest_positions.size());
  for (size_t i = 0; i < welded.size(); ++i) welded[i] = sets.Root(static_cast<int>(i));
  return welded;
}

ClothTopology ComputeWeldedTopology(const ClothMesh& mesh) {
  const std::vector<int> welded = WeldedParticles(mesh);
  const size_t count = welded.size();
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  DisjointSets pieces(count);
  std::vector<bool> used(count, false);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = welded[static_cast<size_t>(triangle[k])];
      const int b = welded[static_cast<size_t>(triangle[(k + 1) % 3])];
      edges.push_back(std::minmax(a, b));
      pieces.Join(a, b);
      used[static_cast<size_t>(a)] = true;
    }
  }
  std::sort(edges.begin(), edges.end());

  ClothTopology topology;
  topology.triangle_count = static_cast<int>(mesh.triangles.size());
  topology.particle_count = static_cast<int>(std::count(used.begin(), used.end(), true));
  topology.component_count = CountRoots(pieces, used);
  topology.is_manifold = true;
  DisjointSets loops(count);
  std::vector<size_t> boundary_ends;
  for (size_t i = 0; i < edges.size();) {
    size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    ++topology.edge_count;
    if (end - i > 2 || edges[i].first == edges[i].second) topology.is_manifold = false;
    if (end - i == 1) {
      loops.Join(edges[i].first, edges[i].second);
      boundary_ends.push_back(static_cast<size_t>(edges[i].first));
      boundary_ends.push_back(static_cast<size_t>(edges[i].second));
    }
    i = end;
  }
  std::sort(boundary_ends.begin(), boundary_ends.end());
  std::vector<bool> on_boundary(count, false);
  for (size_t i = 0; i < boundary_ends.size(); ++i) {
    on_boundary[boundary_ends[i]] = true;
    if (i >= 2 && boundary_ends[i] == boundary_ends[i - 2]) topology.is_manifold = false;
  }
  topology.boundary_loop_count = CountRoots(loops, on_boundary);
  return topology;
}

int ComputeEulerCharacteristic(const ClothMesh& mesh) { return ComputeWeldedTopology(mesh).euler_characteristic(); }

int OpeningCount(GarmentKind kind) {
  if (kind == GarmentKind::kSkirt) return 2;
  return HasLegs(kind) ? 3 : 4;
}

int ExpectedEulerCharacteristic(GarmentKind kind) { return 2 - OpeningCount(kind); }

}  // namespace fitroom
