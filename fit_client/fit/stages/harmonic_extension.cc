#include "fit_client/fit/stages/harmonic_extension.h"

#include <algorithm>
#include <set>
#include <utility>

#include <Eigen/SparseCholesky>

namespace fitroom {

using Eigen::Vector3d;

Result<std::vector<Vector3d>> ExtendHarmonically(const ClothMesh& cloth, int panel, std::span<const GivenValue> given) {
  const size_t count = cloth.rest_positions.size();
  std::vector<int> unknown(count, -1);
  std::vector<Vector3d> values(count, Vector3d::Zero());
  std::vector<bool> is_given(count, false);
  for (const GivenValue& entry : given) {
    is_given[static_cast<size_t>(entry.particle)] = true;
    values[static_cast<size_t>(entry.particle)] = entry.value;
  }
  int unknown_count = 0;
  for (size_t i = 0; i < count; ++i) {
    if (cloth.panel_of_particle[i] == panel && !is_given[i]) unknown[i] = unknown_count++;
  }
  std::set<std::pair<int, int>> edges;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    if (cloth.panel_of_particle[static_cast<size_t>(triangle[0])] != panel) continue;
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(unknown_count, 3);
  for (const auto& [first, second] : edges) {
    for (const auto& [i, j] : {std::pair(first, second), std::pair(second, first)}) {
      const int row = unknown[static_cast<size_t>(i)];
      if (row < 0) continue;
      entries.emplace_back(row, row, 1.0);
      const int column = unknown[static_cast<size_t>(j)];
      if (column >= 0)
        entries.emplace_back(row, column, -1.0);
      else
        right.row(row) += values[static_cast<size_t>(j)].transpose();
    }
  }
  Eigen::SparseMatrix<double> laplacian(unknown_count, unknown_count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  const Eigen::VectorXd diagonal = unknown_count > 0 ? Eigen::VectorXd(solver.vectorD()) : Eigen::VectorXd::Ones(1);
  if (solver.info() != Eigen::Success || diagonal.minCoeff() < 1e-9) {
    return InvalidArgument("PANEL_LOOSE", "a part of the panel hangs on no seam; check the outline points");
  }
  const Eigen::MatrixX3d solution = solver.solve(right);
  for (size_t i = 0; i < count; ++i) {
    if (unknown[i] >= 0) values[i] = solution.row(unknown[i]).transpose();
  }
  return values;
}

}  // namespace fitroom
