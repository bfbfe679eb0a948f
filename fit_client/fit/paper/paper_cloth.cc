#include "fit_client/fit/paper/paper_cloth.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace fitroom::paper {
namespace {

// Area of the triangles on both sides of each edge; lower vertex first.
std::map<std::array<int, 2>, double> EdgeAreas(const ClothMesh& mesh) {
  std::map<std::array<int, 2>, double> areas;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Eigen::Vector3d& p = mesh.rest_positions[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3d& q = mesh.rest_positions[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3d& r = mesh.rest_positions[static_cast<size_t>(triangle[2])];
    const double area = 0.5 * (q - p).cross(r - p).norm();
    for (int corner = 0; corner < 3; ++corner) {
      const auto [low, high] = std::minmax(triangle[corner], triangle[(corner + 1) % 3]);
      areas[{low, high}] += area;
    }
  }
  return areas;
}

}  // namespace

Result<PaperCloth> MakePaperCloth(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                                  const ClothMaterial& material, MassLaw masses, StiffnessLaw stiffness) {
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(mesh, material, {}));
  const size_t vertex_count = mesh.rest_positions.size();
  PaperCloth cloth;
  cloth.positions.assign(start_positions.begin(), start_positions.end());
  cloth.velocities.assign(vertex_count, Eigen::Vector3d::Zero());
  cloth.pinned.assign(vertex_count, 0);
  cloth.particle_of_vertex.resize(vertex_count);
  std::iota(cloth.particle_of_vertex.begin(), cloth.particle_of_vertex.end(), 0);
  for (const int particle : model.particle_of_vertex()) {
    cloth.masses.push_back(model.masses()[static_cast<size_t>(particle)]);
  }
  for (const auto& [edge, area] : EdgeAreas(mesh)) {
    const double rest_length =
        (mesh.rest_positions[static_cast<size_t>(edge[0])] - mesh.rest_positions[static_cast<size_t>(edge[1])]).norm();
    if (rest_length == 0.0) continue;
    const double k = material.stretch_stiffness * area / (rest_length * rest_length);
    cloth.springs.push_back({edge[0], edge[1], rest_length, {k, 0.0}});
  }
  if (stiffness == StiffnessLaw::kOneForAll) {
    double sum = 0.0;
    for (const PaperSpring& spring : cloth.springs) sum += spring.constants.stiffness;
    for (PaperSpring& spring : cloth.springs) {
      spring.constants.stiffness = sum / static_cast<double>(cloth.springs.size());
    }
  }
  if (masses == MassLaw::kUnit) {
    const double mean =
        std::accumulate(cloth.masses.begin(), cloth.masses.end(), 0.0) / static_cast<double>(vertex_count);
    for (PaperSpring& spring : cloth.springs) spring.constants.stiffness /= mean;
    cloth.masses.assign(vertex_count, 1.0);
  }
  return cloth;
}

void SetDamping(PaperCloth& cloth, double damping_time) {
  for (PaperSpring& spring : cloth.springs) spring.constants.damping = damping_time * spring.constants.stiffness;
}

void Weld(PaperCloth& cloth, int vertex_a, int vertex_b) {
  const int kept = cloth.particle_of_vertex[static_cast<size_t>(vertex_a)];
  const int merged = cloth.particle_of_vertex[static_cast<size_t>(vertex_b)];
  if (kept == merged) return;
  const size_t a = static_cast<size_t>(kept);
  const size_t b = static_cast<size_t>(merged);
  const double mass = cloth.masses[a] + cloth.masses[b];
  cloth.positions[a] = (cloth.masses[a] * cloth.positions[a] + cloth.masses[b] * cloth.positions[b]) / mass;
  cloth.velocities[a] = (cloth.masses[a] * cloth.velocities[a] + cloth.masses[b] * cloth.velocities[b]) / mass;
  cloth.masses[a] = mass;
  cloth.masses[b] = 0.0;
  cloth.velocities[b].setZero();
  std::replace(cloth.particle_of_vertex.begin(), cloth.particle_of_vertex.end(), merged, kept);
  for (PaperSpring& spring : cloth.springs) {
    if (spring.a == merged) spring.a = kept;
    if (spring.b == merged) spring.b = kept;
  }
  std::erase_if(cloth.springs, [](const PaperSpring& spring) { return spring.a == spring.b; });
}

std::vector<Eigen::Vector3d> VertexPositions(const PaperCloth& cloth) {
  std::vector<Eigen::Vector3d> places;
  places.reserve(cloth.particle_of_vertex.size());
  for (const int particle : cloth.particle_of_vertex) places.push_back(cloth.positions[static_cast<size_t>(particle)]);
  return places;
}

std::vector<Eigen::Vector3d> AlivePositions(const PaperCloth& cloth) {
  std::vector<Eigen::Vector3d> places;
  for (size_t particle = 0; particle < cloth.positions.size(); ++particle) {
    if (cloth.IsAlive(particle)) places.push_back(cloth.positions[particle]);
  }
  return places;
}

}  // namespace fitroom::paper
