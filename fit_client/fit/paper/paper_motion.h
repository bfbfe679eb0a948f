#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/paper/collision_rule.h"
#include "fit_client/fit/paper/friction.h"
#include "fit_client/fit/paper/integration.h"
#include "fit_client/fit/paper/paper_cloth.h"
#include "fit_client/fit/paper/pulling_up.h"
#include "fit_client/fit/paper/spring.h"
#include "fit_client/fit/paper/stage_forces.h"
#include "fit_client/fit/paper/stitching.h"

namespace fitroom::paper {

// How friction on colliding particles is read.
enum class FrictionLaw {
  kPrinted,  // Equation (4).
  kCoulomb,  // In the tangent plane, at most a coefficient times what the contact took.
};

// How a cloth moves, whatever the stage. The defaults are the method as printed.
struct PaperMotionOptions {
  SpringLaw spring = SpringLaw::kPrinted;
  IntegrationLaw integration = IntegrationLaw::kPrinted;
  FrictionLaw friction = FrictionLaw::kPrinted;
  FrictionAxes friction_axes = FrictionAxes::kFrontalPlane;
  double friction_factor = kPrintedFrictionFactor;  // mu of (4) (unit: N s/m a particle).
  double coulomb_coefficient = 0.35;                // Of FrictionLaw::kCoulomb (unit: 1).
  PullingUpLaw pulling_up = PullingUpLaw::kPrinted;
  StitchingOptions stitching;
  PaperFrame frame;
  double gravity = 9.81;  // Against the frame's up (unit: m/s^2).
  // Not in the method: rate at which all velocities decay (unit: 1/s). Without it a hem swings on for minutes, because
  // springs damp only along themselves.
  double air_drag = 0.0;
};

// The forces on every particle at one moment, by kind (unit: newton). Empty where the kind does not act.
struct ParticleForces {
  std::vector<Eigen::Vector3d> total;
  std::vector<Eigen::Vector3d> friction;  // f_f, part of the total; (7) needs it once more.
};

// Moves a cloth step by step. Owns the cloth; the collider must outlive it. Not thread-safe.
class PaperMotion {
 public:
  PaperMotion(PaperCloth cloth, const BodyCollider& collider, const PaperMotionOptions& options, double time_step);

  // Sets the pairs of vertices that the stitching force acts on.
  void SetStitches(std::vector<SeamPair> stitches) { stitches_ = std::move(stitches); }
  // Returns the forces of `stage` on the cloth as it is.
  ParticleForces ComputeForces(PaperStage stage);
  // Moves the cloth by one step of `stage`: forces, velocities by (2) or (7), the collision rule, places.
  void Step(PaperStage stage);
  // Says whether the particle touched the body in the last step.
  bool IsColliding(size_t particle) const { return colliding_[particle] != 0; }

  PaperCloth& cloth() { return cloth_; }
  const PaperCloth& cloth() const { return cloth_; }
  double time_step() const { return time_step_; }
  const ForceAudit& audit() const { return audit_; }

 private:
  void AddSprings(PaperStage stage, std::vector<Eigen::Vector3d>& total);
  void AddStitching(PaperStage stage, std::vector<Eigen::Vector3d>& total);
  void Count(PaperStage stage, PaperForce force, const Eigen::Vector3d& value) {
    if (!value.isZero(0.0)) ++audit_.At(stage, force);
  }
  void MoveParticle(size_t particle, const Eigen::Vector3d& next_velocity);

  PaperCloth cloth_;
  const BodyCollider& collider_;
  PaperMotionOptions options_;
  double time_step_;
  double mean_mass_ = 1.0;  // (unit: kg)
  std::vector<SeamPair> stitches_;
  std::vector<char> colliding_;
  ForceAudit audit_;
};

}  // namespace fitroom::paper
