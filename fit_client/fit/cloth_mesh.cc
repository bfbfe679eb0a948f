#include "fit_client/fit/cloth_mesh.h"

#include <algorithm>
#include <numeric>

namespace fitroom {

ClothPieces FindPieces(const ClothMesh& mesh) {
  std::vector<int> parent(mesh.rest_positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int particle) {
    while (parent[static_cast<size_t>(particle)] != particle) {
      parent[static_cast<size_t>(particle)] = parent[static_cast<size_t>(parent[static_cast<size_t>(particle)])];
      particle = parent[static_cast<size_t>(particle)];
    }
    return particle;
  };
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (const int other : {triangle[1], triangle[2]}) {
      const int a = root(triangle[0]);
      const int b = root(other);
      parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  ClothPieces pieces;
  pieces.piece_of_particle.reserve(parent.size());
  for (size_t particle = 0; particle < parent.size(); ++particle) {
    const int first = root(static_cast<int>(particle));  // The lowest one of the piece, seen before all others.
    pieces.piece_of_particle.push_back(
        first == static_cast<int>(particle) ? pieces.count++ : pieces.piece_of_particle[static_cast<size_t>(first)]);
  }
  return pieces;
}

double MeanEdgeLength(const ClothMesh& mesh) {
  double sum = 0.0;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      sum += (mesh.rest_positions[static_cast<size_t>(triangle[corner])] -
              mesh.rest_positions[static_cast<size_t>(triangle[(corner + 1) % 3])])
                 .norm();
    }
  }
  return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace fitroom
