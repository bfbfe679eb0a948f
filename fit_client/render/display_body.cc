#include <algorithm>
#include <cstdint>
#include <numeric>

#include <meshoptimizer.h>

#include "fit_client/render/scene.h"

namespace fitroom::render {
namespace {

// Floating islands below this part of all triangles are scanner noise.
constexpr double kIslandShare = 1e-3;
// How far simplification may move the surface (unit: metre). Cloth lies 1 to 3 mm off the body.
constexpr double kSimplificationError = 5e-4;
// Rounds of averaging a normal with its neighbours'. Two take the noise of a laser (0.3 mm at 2 mm spacing, about
// 8 degrees) out of the shading and leave collar bones and navels in.
constexpr int kNormalSmoothingRounds = 2;

// Vertices in groups that are connected by triangles.
class Components {
 public:
  explicit Components(size_t vertex_count) : parents_(vertex_count) { std::iota(parents_.begin(), parents_.end(), 0U); }
  void Join(uint32_t a, uint32_t b) {
    a = Root(a);
    b = Root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  uint32_t Root(uint32_t vertex) {
    while (parents_[vertex] != vertex) {
      parents_[vertex] = parents_[parents_[vertex]];
      vertex = parents_[vertex];
    }
    return vertex;
  }

 private:
  std::vector<uint32_t> parents_;
};

// Returns the corners of all triangles but those of small islands.
std::vector<uint32_t> IndicesWithoutIslands(const TriangleMesh& mesh) {
  Components components(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    components.Join(static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[1]));
    components.Join(static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[2]));
  }
  std::vector<uint32_t> triangle_counts(mesh.vertices.size(), 0);
  for (const Eigen::Vector3i& t : mesh.triangles) ++triangle_counts[components.Root(static_cast<uint32_t>(t[0]))];
  const double smallest = kIslandShare * static_cast<double>(mesh.triangles.size());
  std::vector<uint32_t> indices;
  indices.reserve(mesh.triangles.size() * 3);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (triangle_counts[components.Root(static_cast<uint32_t>(t[0]))] < smallest) continue;
    for (const int corner : t) indices.push_back(static_cast<uint32_t>(corner));
  }
  return indices;
}

// Reduces the triangles to about `triangle_count`, never moving the surface by more than kSimplificationError.
std::vector<uint32_t> Simplify(const TriangleMesh& mesh, const std::vector<uint32_t>& indices, int triangle_count) {
  std::vector<float> positions;
  positions.reserve(mesh.vertices.size() * 3);
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (const double coordinate : v) positions.push_back(static_cast<float>(coordinate));
  }
  const float scale = meshopt_simplifyScale(positions.data(), mesh.vertices.size(), 3 * sizeof(float));
  const float relative_error = static_cast<float>(kSimplificationError) / std::max(scale, 1e-6F);
  std::vector<uint32_t> simplified(indices.size());
  const size_t count =
      meshopt_simplify(simplified.data(), indices.data(), indices.size(), positions.data(), mesh.vertices.size(),
                       3 * sizeof(float), static_cast<size_t>(triangle_count) * 3, relative_error, 0, nullptr);
  simplified.resize(count);
  return simplified;
}

void SmoothNormals(const TriangleMesh& mesh, std::vector<Eigen::Vector3d>& normals) {
  for (int round = 0; round < kNormalSmoothingRounds; ++round) {
    std::vector<Eigen::Vector3d> sums = normals;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const Eigen::Vector3d sum =
          normals[static_cast<size_t>(t[0])] + normals[static_cast<size_t>(t[1])] + normals[static_cast<size_t>(t[2])];
      for (const int corner : t) sums[static_cast<size_t>(corner)] += 0.5 * sum;
    }
    for (size_t i = 0; i < sums.size(); ++i) {
      const double length = sums[i].norm();
      if (length > 0.0) normals[i] = sums[i] / length;
    }
  }
}

}  // namespace

DisplayBody PrepareBody(const TriangleMesh& body, int triangle_count) {
  std::vector<uint32_t> indices = IndicesWithoutIslands(body);
  if (indices.size() > static_cast<size_t>(triangle_count) * 3) indices = Simplify(body, indices, triangle_count);
  const std::vector<Eigen::Vector3d> full_normals = ComputeVertexNormals(body);

  DisplayBody display;
  std::vector<int> display_from_body(body.vertices.size(), -1);
  display.mesh.triangles.reserve(indices.size() / 3);
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    Eigen::Vector3i triangle;
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = indices[i + static_cast<size_t>(k)];
      int& index = display_from_body[vertex];
      if (index < 0) {
        index = static_cast<int>(display.mesh.vertices.size());
        display.mesh.vertices.push_back(body.vertices[vertex]);
        display.normals.push_back(full_normals[vertex]);
      }
      triangle[k] = index;
    }
    display.mesh.triangles.push_back(triangle);
  }
  SmoothNormals(display.mesh, display.normals);
  return display;
}

}  // namespace fitroom::render
