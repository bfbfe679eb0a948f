#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_kernels.h"
#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom {

class SelfCollision;

// How the cloth moves during one stage. All rates are per second, so that nothing depends on the step.
struct MotionOptions {
  double time_step = 2.5e-4;                               // (unit: second)
  Eigen::Vector3d gravity = Eigen::Vector3d(0, -9.81, 0);  // (unit: m/s^2)
  double drag = 5.0;                                       // Rate at which a velocity decays to the wind (unit: 1/s).
  double friction_coefficient = 0.3;                       // Coulomb's, cloth on body (unit: 1).
  double contact_offset = 0.0035;                          // Particles stay this far outside the body (unit: metre).
  double largest_step = 0.002;                             // A particle moves no further in a step (unit: metre).
  double compression_factor = 1.0;  // Stiffness of a shortened spring over that of a stretched one.
  double attachment_speed = 0.6;    // At which attached particles walk to their targets (unit: m/s).
};

// The place in contact with a particle as of its last look at the distance field: signed distance = n . x - offset.
struct ContactPlane {
  Float4 normal;     // w: offset (unit: metre).
  Float4 reference;  // Where the field was looked at; w: squared way after which to look again (unit: m^2).
};

// A particle that nothing moves but its way to a target, where it stays: the belt's hold on a waist.
struct Attachment {
  int particle = 0;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // In the caller's frame (unit: metre).
};

// Positions and velocities of one cloth in motion, in single precision about a centre: the state of ClothSolver.
// Index: particle of the model; idle particles follow.
struct ClothState {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // What positions are relative to (unit: metre).
  std::vector<Float4> positions;                     // w: inverse mass (unit: 1/kg).
  std::vector<Float4> previous;                      // Positions before the step.
  std::vector<Float4> velocities;                    // (unit: m/s)
  std::vector<Float4> wind;                          // Velocity that drag pulls towards (unit: m/s); empty: still air.
  std::vector<ContactPlane> contacts;
  std::vector<float> extra_offset;  // Added to the contact offset (unit: metre).
  std::vector<Float4> targets;      // Where attached particles go; w is 1 for those. Empty: nothing is attached.
};

// Two particles that are being drawn together.
struct SeamPull {
  int a = 0;
  int b = 0;
  bool around_body = false;  // The straight way is blocked by the body: pull along the surface.
  // Above zero, a tie in place of a pull: at once no farther apart than this, and free when nearer (unit: metre).
  float tie_length = 0.0F;
};

// Moves a cloth by extended position-based dynamics with one sweep a substep (Macklin et al., "Small steps in physics
// simulation", 2019): springs and bending by Gauss-Seidel in a fixed order, then contact: a particle that ends closer
// to the body than its offset is put onto the offset surface, loses its normal velocity (inelastic), and loses as much
// of its tangential way as Coulomb's cone allows, mu times the normal correction, which is independent of mesh and
// step. Contacts are planes cut from the distance field, renewed when a particle has moved.
//
// The cloth is cut into chunks that are solved as parallel tasks; constraints between chunks follow in one task. The
// cut does not depend on the executor, so any number of threads gives the same bits.
// Owns nothing: model, field, executor and self-collision must outlive it. Not thread-safe.
class ClothSolver {
 public:
  ClothSolver(const ClothModel& model, const SignedDistanceField& body, Executor& executor);

  // Returns a state at rest at the given particle positions.
  ClothState MakeState(std::span<const Eigen::Vector3d> positions) const;
  // Sets the motion for the substeps that follow.
  void SetMotion(const MotionOptions& motion);
  // Attaches particles, in place of all earlier attachments: they get an infinite mass, walk straight to their targets
  // without regard to contact, and stay there.
  void Attach(ClothState& state, std::span<const Attachment> attachments);
  // Cloth against itself from now on, after the springs and before the body; null: not at all.
  void SetSelfCollision(SelfCollision* self_collision) { self_collision_ = self_collision; }
  // Advances by `substep_count` steps. `pulls` draw pairs together by at most `closing_speed` (unit: m/s).
  void Advance(ClothState& state, int substep_count, std::span<const SeamPull> pulls, double closing_speed);
  // Looks at edge middles and triangle centres near the body and raises the contact offset of the particles round those
  // that are closer than `clearance` (unit: metre). Returns the number of samples that were too close.
  int RaiseOffsets(ClothState& state, double clearance) const;

  // Returns particle positions in the caller's frame.
  static std::vector<Eigen::Vector3d> Positions(const ClothState& state, int particle_count);

 private:
  void Integrate(ClothState& state, const ClothChunk& chunk) const;
  void SolvePulls(ClothState& state, std::span<const SeamPull> pulls, double closing_speed) const;
  void SolveContacts(ClothState& state, const ClothChunk& chunk) const;
  void LookAtBody(ClothState& state, size_t particle) const;
  ChunkDenominators MakeDenominators(const ClothChunk& chunk) const;

  const ClothModel& model_;
  const SignedDistanceField& body_;
  Executor& executor_;
  SelfCollision* self_collision_ = nullptr;
  MotionOptions motion_;
  std::vector<float> inverse_masses_;
  std::vector<ChunkDenominators> denominators_;  // One a chunk, then the border.
};

}  // namespace fitroom
