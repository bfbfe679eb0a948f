#include "common/body/scan_cleaning.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace fitroom {
namespace {

// A piece with less than this part of the whole area is an island: a head has 8 %, the islands of a laser scan well
// below 0.1 %.
constexpr double kIslandAreaFraction = 0.01;
// Coordinates beyond this cannot be a body's in any unit, and their squares would overflow.
constexpr double kMaxCoordinate = 1e9;

uint64_t Mix(uint64_t h) {
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ h >> 33;
}

uint64_t HashOf(const Eigen::Vector3d& p) {
  // Adding zero makes -0 the same as 0.
  uint64_t h = Mix(std::bit_cast<uint64_t>(p.x() + 0.0));
  h = Mix(h ^ std::bit_cast<uint64_t>(p.y() + 0.0));
  return Mix(h ^ std::bit_cast<uint64_t>(p.z() + 0.0));
}

bool Usable(const Eigen::Vector3d& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate; }

// For each vertex the first vertex at the same place; -1 for one that is not a number.
std::vector<int> FirstAtSamePlace(const std::vector<Eigen::Vector3d>& vertices) {
  const size_t capacity = std::bit_ceil(2 * vertices.size() + 1);
  std::vector<int> table(capacity, -1);
  std::vector<int> first(vertices.size(), -1);
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (!Usable(vertices[i])) continue;
    size_t slot = HashOf(vertices[i]) & (capacity - 1);
    while (table[slot] >= 0 && vertices[static_cast<size_t>(table[slot])] != vertices[i]) {
      slot = (slot + 1) & (capacity - 1);
    }
    if (table[slot] < 0) table[slot] = static_cast<int>(i);
    first[i] = table[slot];
  }
  return first;
}

double AreaOf(const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3i& t) {
  const Eigen::Vector3d& a = vertices[static_cast<size_t>(t[0])];
  const Eigen::Vector3d& b = vertices[static_cast<size_t>(t[1])];
  const Eigen::Vector3d& c = vertices[static_cast<size_t>(t[2])];
  return 0.5 * (b - a).cross(c - a).norm();
}

// Drops all but the first of triangles with the same three vertices, in whatever order.
int RemoveDuplicates(std::vector<Eigen::Vector3i>& triangles) {
  const size_t capacity = std::bit_ceil(2 * triangles.size() + 1);
  std::vector<int> table(capacity, -1);
  const auto sorted = [](Eigen::Vector3i t) {
    std::sort(t.data(), t.data() + 3);
    return t;
  };
  size_t kept = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Eigen::Vector3i key = sorted(triangles[i]);
    uint64_t h = Mix(static_cast<uint64_t>(key[0]));
    h = Mix(h ^ static_cast<uint64_t>(key[1]));
    h = Mix(h ^ static_cast<uint64_t>(key[2]));
    size_t slot = h & (capacity - 1);
    while (table[slot] >= 0 && sorted(triangles[static_cast<size_t>(table[slot])]) != key) {
      slot = (slot + 1) & (capacity - 1);
    }
    if (table[slot] >= 0) continue;
    triangles[kept] = triangles[i];
    table[slot] = static_cast<int>(kept++);
  }
  const int dropped = static_cast<int>(triangles.size() - kept);
  triangles.resize(kept);
  return dropped;
}

int RootOf(std::vector<int>& parent, int i) {
  while (parent[static_cast<size_t>(i)] != i) {
    parent[static_cast<size_t>(i)] = parent[static_cast<size_t>(parent[static_cast<size_t>(i)])];
    i = parent[static_cast<size_t>(i)];
  }
  return i;
}

// Drops the pieces whose area is a negligible part of the whole.
int RemoveIslands(const std::vector<Eigen::Vector3d>& vertices, std::vector<Eigen::Vector3i>& triangles) {
  std::vector<int> parent(vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Eigen::Vector3i& t : triangles) {
    const int root = RootOf(parent, t[0]);
    parent[static_cast<size_t>(RootOf(parent, t[1]))] = root;
    parent[static_cast<size_t>(RootOf(parent, t[2]))] = root;
  }
  std::vector<double> area(vertices.size(), 0.0);
  double whole = 0.0;
  for (const Eigen::Vector3i& t : triangles) {
    const double a = AreaOf(vertices, t);
    area[static_cast<size_t>(RootOf(parent, t[0]))] += a;
    whole += a;
  }
  int islands = 0;
  for (const double a : area) islands += a > 0.0 && a < kIslandAreaFraction * whole ? 1 : 0;
  std::erase_if(triangles, [&](const Eigen::Vector3i& t) {
    return area[static_cast<size_t>(RootOf(parent, t[0]))] < kIslandAreaFraction * whole;
  });
  return islands;
}

// Keeps the vertices that a triangle uses, in their order, and renumbers the triangles.
void RemoveUnusedVertices(TriangleMesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) number[static_cast<size_t>(t[i])] = 0;
  }
  size_t kept = 0;
  for (size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    mesh.vertices[kept] = mesh.vertices[i];
    number[i] = static_cast<int>(kept++);
  }
  mesh.vertices.resize(kept);
  for (Eigen::Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) t[i] = number[static_cast<size_t>(t[i])];
  }
}

// Six times the enclosed volume, from the mesh's own middle so that holes weigh little.
double SignedVolume(const TriangleMesh& mesh) {
  const Eigen::Vector3d middle = ComputeBounds(mesh).center();
  double volume = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[static_cast<size_t>(t[0])] - middle;
    const Eigen::Vector3d b = mesh.vertices[static_cast<size_t>(t[1])] - middle;
    const Eigen::Vector3d c = mesh.vertices[static_cast<size_t>(t[2])] - middle;
    volume += a.dot(b.cross(c));
  }
  return volume;
}

}  // namespace

Result<CleanedScan> CleanScan(const TriangleMesh& raw) {
  const auto vertex_count = static_cast<int>(raw.vertices.size());
  CleanedScan cleaned;
  const std::vector<int> first = FirstAtSamePlace(raw.vertices);
  for (size_t i = 0; i < first.size(); ++i) {
    if (first[i] >= 0 && first[i] != static_cast<int>(i)) ++cleaned.counts.merged_vertices;
  }
  cleaned.mesh.triangles.reserve(raw.triangles.size());
  for (size_t i = 0; i < raw.triangles.size(); ++i) {
    const Eigen::Vector3i& t = raw.triangles[i];
    if (t.minCoeff() < 0 || t.maxCoeff() >= vertex_count) {
      return InvalidArgument("INDEX_OUT_OF_RANGE", "triangle " + std::to_string(i) + " names a vertex outside 0.." +
                                                       std::to_string(vertex_count - 1) + "; export the scan again");
    }
    const Eigen::Vector3i merged(first[static_cast<size_t>(t[0])], first[static_cast<size_t>(t[1])],
                                 first[static_cast<size_t>(t[2])]);
    if (merged.minCoeff() < 0 || !(AreaOf(raw.vertices, merged) > 0.0)) {
      ++cleaned.counts.degenerate_triangles;
    } else {
      cleaned.mesh.triangles.push_back(merged);
    }
  }
  cleaned.counts.duplicate_triangles = RemoveDuplicates(cleaned.mesh.triangles);
  cleaned.counts.islands = RemoveIslands(raw.vertices, cleaned.mesh.triangles);
  if (cleaned.mesh.triangles.empty()) {
    return InvalidArgument("NO_SURFACE", "the mesh has no triangle with an area; export the scan as a polygon mesh");
  }
  cleaned.mesh.vertices = raw.vertices;
  RemoveUnusedVertices(cleaned.mesh);
  cleaned.counts.unused_vertices =
      vertex_count - static_cast<int>(cleaned.mesh.vertices.size()) - cleaned.counts.merged_vertices;
  if (SignedVolume(cleaned.mesh) < 0.0) {
    cleaned.counts.turned_inside_out = true;
    for (Eigen::Vector3i& t : cleaned.mesh.triangles) std::swap(t[1], t[2]);
  }
  return cleaned;
}

}  // namespace fitroom
