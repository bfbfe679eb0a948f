#include "fit_client/fit/solver/self_collision_iron.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/solver/self_collision_near.h"
#include "fit_client/fit/solver/self_collision_pairs.h"

namespace fitroom {
namespace {

using Eigen::Vector3f;

constexpr int kSweepsPerRound = 8;
constexpr int kRoundsPerRing = 4;  // After so many rounds in vain a ring more is ironed.
constexpr float kShare = 0.6F;     // Of the way to the middle of the neighbours, a sweep.

Vector3f ToVector(const Float4& at) { return {at.x, at.y, at.z}; }

// Draws the particles once towards the middle of their neighbours, and then out of the body.
void Sweep(const SelfCollisionTopology& topology, const SignedDistanceField& body, double offset,
           std::span<const int> particles, ClothState& state) {
  std::vector<Vector3f> places;
  for (const int particle : particles) {
    const std::span<const int> ring = topology.neighbours_of_particle.Of(particle);
    const Vector3f at = ToVector(state.positions[static_cast<size_t>(particle)]);
    Vector3f sum = Vector3f::Zero();
    for (const int neighbour : ring) sum += ToVector(state.positions[static_cast<size_t>(neighbour)]);
    places.emplace_back(at + kShare * (sum / static_cast<float>(ring.size()) - at));
  }
  for (size_t index = 0; index < particles.size(); ++index) {
    Float4& target = state.positions[static_cast<size_t>(particles[index])];
    if (!(target.w > 0.0F)) continue;  // Attached.
    const Eigen::Vector3d place = places[index].cast<double>() + state.centre;
    const SignedDistanceField::Sample sample = body.Query(place);
    const double length = sample.gradient.norm();
    if (sample.distance < offset && length > 0.1) {
      places[index] += (sample.gradient * ((offset - sample.distance) / length)).cast<float>();
    }
    target = {places[index].x(), places[index].y(), places[index].z(), target.w};
  }
}

}  // namespace

std::vector<int> ParticlesAround(const ClothModel& model, const SelfCollisionTopology& topology,
                                 std::span<const ClothCrossing> crossings, int ring_count) {
  std::vector<int> around;
  for (const ClothCrossing& crossing : crossings) {
    for (const int particle : model.edges()[static_cast<size_t>(crossing.edge)]) around.push_back(particle);
    for (const int particle : model.triangles()[static_cast<size_t>(crossing.triangle)]) around.push_back(particle);
  }
  for (int ring = 0; ring <= ring_count; ++ring) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    if (ring == ring_count) break;
    const size_t count = around.size();
    for (size_t index = 0; index < count; ++index) {
      const std::span<const int> neighbours = topology.neighbours_of_particle.Of(around[index]);
      around.insert(around.end(), neighbours.begin(), neighbours.end());
    }
  }
  return around;
}

int IronTangles(const ClothModel& model, const SelfCollisionTopology& topology, const SignedDistanceField& body,
                const IroningOptions& options, ClothState& state, Executor& executor) {
  for (int round = 0;; ++round) {
    const NumberLists near =
        FindNearParticles(state.positions, model.particle_count(), topology.neighbours_of_particle,
                          static_cast<float>(options.search_radius), options.largest_pair_count, executor);
    const std::vector<ClothCrossing> crossings =
        FindEncounters(model, topology, near, state.positions, 0.0F, executor).crossings;
    if (crossings.empty() || round >= options.largest_round_count) return static_cast<int>(crossings.size());
    const std::vector<int> particles = ParticlesAround(model, topology, crossings, 1 + round / kRoundsPerRing);
    const double offset = options.kept_offset;
    for (int sweep = 0; sweep < kSweepsPerRound; ++sweep) Sweep(topology, body, offset, particles, state);
    for (const int particle : particles) {
      float& extra_offset = state.extra_offset[static_cast<size_t>(particle)];
      extra_offset = std::min(extra_offset, static_cast<float>(offset - options.contact_offset));
      state.previous[static_cast<size_t>(particle)] = state.positions[static_cast<size_t>(particle)];
      state.velocities[static_cast<size_t>(particle)] = Float4();
    }
  }
}

}  // namespace fitroom
