#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/paper/spring.h"
#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom::paper {

// What a particle weighs.
enum class MassLaw {
  kUnit,    // 1 kg each, as printed. Stiffness is scaled alike, so that cloth stretches under its weight as it should.
  kLumped,  // Areal density times a third of the incident triangles' area.
};

// How stiff a spring is. The method prints one k without a value.
enum class StiffnessLaw {
  kOneForAll,  // The mean of the springs of this fabric on this mesh.
  kPerEdge,    // Y (A1 + A2) / l^2, so that the net is the same sheet whatever its triangles.
};

struct PaperSpring {
  int a = 0;
  int b = 0;
  double rest_length = 0.0;  // (unit: metre)
  SpringConstants constants;
};

// A cloth of particles and springs in double precision, as the method describes it: one particle a vertex, one spring
// an edge. When two particles are sewn the second is merged into the first and stays behind without mass.
struct PaperCloth {
  std::vector<Eigen::Vector3d> positions;   // (unit: metre)
  std::vector<Eigen::Vector3d> velocities;  // (unit: m/s)
  std::vector<double> masses;               // 0: merged into another particle (unit: kg).
  std::vector<char> pinned;                 // Held where they are, by the belt.
  std::vector<PaperSpring> springs;
  std::vector<int> particle_of_vertex;

  bool IsAlive(size_t particle) const { return masses[particle] > 0.0; }
  bool IsFree(size_t particle) const { return IsAlive(particle) && pinned[particle] == 0; }
};

// Builds a cloth at rest at `start_positions`. A damper gets `damping_time` times the stiffness of its spring (unit:
// second). With unit masses all stiffnesses are divided by the mean lumped mass (unit: N/m a kg of particle).
// Fails like ClothModel::Create(), which measures areas and stiffnesses.
Result<PaperCloth> MakePaperCloth(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                                  const ClothMaterial& material, MassLaw masses, StiffnessLaw stiffness);

// Sets every damper to `damping_time` (unit: second) times the stiffness of its spring.
void SetDamping(PaperCloth& cloth, double damping_time);

// Sews: merges the particle of vertex `b` into that of vertex `a`. Masses are added, place and velocity are those of
// the common centre of mass, so that momentum is kept. Springs between the two are dropped. Nothing happens where both
// are one particle already.
void Weld(PaperCloth& cloth, int vertex_a, int vertex_b);

// Returns positions, one a vertex of the mesh.
std::vector<Eigen::Vector3d> VertexPositions(const PaperCloth& cloth);
// Returns the positions of the particles that are not merged into others.
std::vector<Eigen::Vector3d> AlivePositions(const PaperCloth& cloth);

}  // namespace fitroom::paper
