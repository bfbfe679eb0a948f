#include "fit_client/fit/paper/paper_motion.h"

#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "fit_client/fit/paper/weight.h"

namespace fitroom::paper {

PaperMotion::PaperMotion(PaperCloth cloth, const BodyCollider& collider, const PaperMotionOptions& options,
                         double time_step)
    : cloth_(std::move(cloth)), collider_(collider), options_(options), time_step_(time_step) {
  mean_mass_ =
      std::accumulate(cloth_.masses.begin(), cloth_.masses.end(), 0.0) / static_cast<double>(cloth_.masses.size());
  colliding_.assign(cloth_.positions.size(), 0);
}

void PaperMotion::AddSprings(PaperStage stage, std::vector<Eigen::Vector3d>& total) {
  for (const PaperSpring& spring : cloth_.springs) {
    const size_t a = static_cast<size_t>(spring.a);
    const size_t b = static_cast<size_t>(spring.b);
    const Eigen::Vector3d force =
        SpringForce(cloth_.positions[a] - cloth_.positions[b], cloth_.velocities[a] - cloth_.velocities[b],
                    spring.rest_length, spring.constants, options_.spring);
    total[a] += force;
    total[b] -= force;
    Count(stage, PaperForce::kSpring, force);
  }
}

void PaperMotion::AddStitching(PaperStage stage, std::vector<Eigen::Vector3d>& total) {
  for (const SeamPair& stitch : stitches_) {
    const size_t a = static_cast<size_t>(cloth_.particle_of_vertex[static_cast<size_t>(stitch.a)]);
    const size_t b = static_cast<size_t>(cloth_.particle_of_vertex[static_cast<size_t>(stitch.b)]);
    if (a == b) continue;
    const Eigen::Vector3d force =
        StitchingForce(cloth_.positions[a] - cloth_.positions[b], cloth_.velocities[a] - cloth_.velocities[b],
                       options_.stitching.pull * mean_mass_, options_.stitching);
    total[a] += force;
    total[b] -= force;
    Count(stage, PaperForce::kStitching, force);
  }
}

ParticleForces PaperMotion::ComputeForces(PaperStage stage) {
  const StageForces acting = ForcesOf(stage);
  const Eigen::Vector3d gravity = -options_.gravity * options_.frame.Up();
  ParticleForces forces;
  forces.total.assign(cloth_.positions.size(), Eigen::Vector3d::Zero());
  forces.friction.assign(cloth_.positions.size(), Eigen::Vector3d::Zero());
  if (acting.spring) AddSprings(stage, forces.total);
  if (acting.stitching) AddStitching(stage, forces.total);
  for (size_t particle = 0; particle < cloth_.positions.size(); ++particle) {
    if (!cloth_.IsFree(particle)) continue;
    if (acting.friction && colliding_[particle] != 0 && options_.friction == FrictionLaw::kPrinted) {
      forces.friction[particle] =
          FrictionForce(cloth_.velocities[particle], options_.friction_factor, options_.frame, options_.friction_axes);
      forces.total[particle] += forces.friction[particle];
      Count(stage, PaperForce::kFriction, forces.friction[particle]);
    }
    if (acting.gravity) {
      const Eigen::Vector3d weight = GravityForce(cloth_.masses[particle], gravity);
      forces.total[particle] += weight;
      Count(stage, PaperForce::kGravity, weight);
    }
    if (acting.antigravity) {
      const Eigen::Vector3d lift = AntigravityForce(cloth_.masses[particle], gravity);
      forces.total[particle] += lift;
      Count(stage, PaperForce::kAntigravity, lift);
    }
  }
  return forces;
}

void PaperMotion::MoveParticle(size_t particle, const Eigen::Vector3d& next_velocity) {
  const Eigen::Vector3d from = cloth_.positions[particle];
  const Eigen::Vector3d old_velocity = cloth_.velocities[particle];
  Eigen::Vector3d velocity = next_velocity;
  const std::optional<BodyContact> contact = collider_.FindContact(from, NextPosition(from, velocity, time_step_));
  colliding_[particle] = contact.has_value() ? 1 : 0;
  if (contact.has_value()) {
    const Eigen::Vector3d kept = InelasticVelocity(velocity, contact->normal);
    const double normal_speed = (kept - velocity).norm();
    const bool is_coulomb = options_.friction == FrictionLaw::kCoulomb;
    velocity = is_coulomb ? CoulombSlowed(kept, normal_speed, options_.coulomb_coefficient) : kept;
  }
  const bool is_printed = options_.integration == IntegrationLaw::kPrinted;
  cloth_.velocities[particle] = velocity;
  cloth_.positions[particle] = NextPosition(from, is_printed ? velocity : old_velocity, time_step_);
  if (contact.has_value() && collider_.contact_offset() > 0.0 && contact->distance < collider_.contact_offset()) {
    const double along_normal = (cloth_.positions[particle] - from).dot(contact->normal) -
                                (NextPosition(from, next_velocity, time_step_) - from).dot(contact->normal);
    const double distance = contact->distance + along_normal;  // After the rule took the normal velocity.
    if (distance < collider_.contact_offset()) {
      cloth_.positions[particle] += (collider_.contact_offset() - distance) * contact->normal;
    }
  }
}

void PaperMotion::Step(PaperStage stage) {
  const ParticleForces forces = ComputeForces(stage);
  const bool is_pulled_up = ForcesOf(stage).pulled_up;
  const double air = std::exp(-options_.air_drag * time_step_);
  for (size_t particle = 0; particle < cloth_.positions.size(); ++particle) {
    if (!cloth_.IsFree(particle)) continue;
    const Eigen::Vector3d& velocity = cloth_.velocities[particle];
    const double mass = cloth_.masses[particle];
    Eigen::Vector3d next_velocity = is_pulled_up
                                        ? PulledUpVelocity(velocity, forces.total[particle], forces.friction[particle],
                                                           mass, time_step_, options_.pulling_up)
                                        : NextVelocity(velocity, forces.total[particle], mass, time_step_);
    next_velocity *= air;
    MoveParticle(particle, next_velocity);
  }
}

}  // namespace fitroom::paper
