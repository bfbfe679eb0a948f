#pragma once

#include <span>
#include <vector>

#include "common/base/executor.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/self_collision_pairs.h"
#include "fit_client/fit/solver/self_collision_topology.h"

namespace fitroom {

// Returns the particles of the crossings and those that are at most `ring_count` edges away, ascending.
std::vector<int> ParticlesAround(const ClothModel& model, const SelfCollisionTopology& topology,
                                 std::span<const ClothCrossing> crossings, int ring_count);

struct IroningOptions {
  double search_radius = 0.014;   // Crossings are looked for among particles that are closer (unit: metre).
  double contact_offset = 0.003;  // Of the solver (unit: metre);
  double kept_offset = 0.003;     // what is ironed keeps this, because two layers need room between arm and trunk.
  int largest_round_count = 24;   // Looks for crossings (unit: 1).
  int largest_pair_count = 0;     // Of near particles (unit: 1).
};

// Irons cloth that passes through itself: particles round the crossings are drawn to the middle of their neighbours,
// and out of the body, until nothing crosses; round by round a wider piece. A membrane over a border that is not
// tangled is not tangled either, and the cloth may fold anew from it, each layer on its side. What was ironed is at
// rest. Returns the number of crossings that are left. The same for any executor.
int IronTangles(const ClothModel& model, const SelfCollisionTopology& topology, const SignedDistanceField& body,
                const IroningOptions& options, ClothState& state, Executor& executor);

}  // namespace fitroom
