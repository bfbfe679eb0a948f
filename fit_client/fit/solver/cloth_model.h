#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// What a fabric is made of, as far as the solver knows. Isotropic; Poisson's ratio is a third, which is what a
// triangulated net of springs has.
struct ClothMaterial {
  // Mass per area (unit: kg/m^2). T-shirt jersey: 0.14 ... 0.22.
  double areal_density = 0.18;
  // Young's modulus times thickness (unit: N/m). A strip of width w and length l pulled by F is longer by F l / (w Y).
  double stretch_stiffness = 1500.0;
  // Moment per curvature and width (unit: N m). Jersey: 1e-6 ... 1e-5, shirting: up to 1e-4.
  double bending_stiffness = 1e-5;
};

// Four springs that share no particle, solved side by side; one cache line. A place that is not used names an idle
// particle of infinite mass at both ends; idle particles follow the real ones, one a chunk and one for the border.
struct alignas(64) StretchBatch {
  std::array<int32_t, 4> a = {};
  std::array<int32_t, 4> b = {};
  std::array<float, 4> rest_length = {};  // (unit: metre)
  std::array<float, 4> compliance = {};   // (unit: m/N)
};

// Keeps two triangles that share an edge flat, by the quadratic energy of Bergou et al., "A quadratic bending model for
// inextensible surfaces", 2006: E = k/2 |sum_i c_i x_i|^2.
//
//         x2
//        /  \.
//      x0----x1      shared edge x0-x1
//        \  /
//         x3
struct BendConstraint {
  std::array<int32_t, 4> particles = {};
  std::array<float, 4> coefficients = {};  // (unit: 1)
  float weight = 0.0F;                     // sum_i c_i^2 / m_i (unit: 1/kg)
  float compliance = 0.0F;                 // 1/k (unit: m/N)
};

// A range of particles that one task works on, and the constraints that touch no other particle.
struct ClothChunk {
  int first_particle = 0;
  int particle_count = 0;
  std::vector<StretchBatch> stretch;
  std::vector<BendConstraint> bend;
  // Where each colour ends in the order of the constraints: those of one colour share no particle but idle ones.
  std::vector<int> stretch_colour_ends;
  std::vector<int> bend_colour_ends;
};

// The rest shape as the solver wants it: masses and constraints, immutable, shared by any number of runs.
// Vertices of the mesh that are sewn onto each other are one particle. Particles are numbered by place, so that those
// that share constraints lie near each other in memory; `particle_of_vertex` leads from the mesh to them. The cut into
// chunks depends on the mesh alone.
class ClothModel {
 public:
  // Builds the model with the pairs in `welds` merged. The mass of a particle is the areal density times a third of the
  // area of its triangles. A spring's stiffness is Y (A1 + A2) / l^2, with the areas of the triangles on both sides, so
  // that a finer mesh is the same sheet.
  // INVALID_ARGUMENT for non-finite positions, indices out of range, particles without area or no triangles.
  static Result<ClothModel> Create(const ClothMesh& mesh, const ClothMaterial& material,
                                   std::span<const SeamPair> welds);

  int particle_count() const { return static_cast<int>(masses_.size()); }
  int idle_particle_count() const { return static_cast<int>(chunks_.size()) + 1; }
  // One a vertex of the mesh.
  std::span<const int> particle_of_vertex() const { return particle_of_vertex_; }
  // (unit: kg)
  std::span<const double> masses() const { return masses_; }
  std::span<const ClothChunk> chunks() const { return chunks_; }
  // Constraints that reach over two chunks, solved after all chunks.
  const ClothChunk& border() const { return border_; }
  // Each edge of the merged mesh once, lower particle first, and the triangles, as particles.
  std::span<const std::array<int, 2>> edges() const { return edges_; }
  std::span<const std::array<int, 3>> triangles() const { return triangles_; }

 private:
  friend class ClothModelBuilder;
  ClothModel() = default;

  std::vector<int> particle_of_vertex_;
  std::vector<double> masses_;
  std::vector<ClothChunk> chunks_;
  ClothChunk border_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace fitroom
