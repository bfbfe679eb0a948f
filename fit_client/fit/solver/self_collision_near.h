#pragma once

#include <span>

#include "common/base/executor.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/self_collision_topology.h"

namespace fitroom {

// Broad phase: returns for each particle those that are closer than `radius` (unit: metre) and no neighbours of it.
// `positions` must be finite; those after `particle_count` are not looked at. At most `largest_pair_count` pairs are
// returned, the first in the order of the cells. The same for any executor.
NumberLists FindNearParticles(std::span<const Float4> positions, int particle_count, const NumberLists& neighbours,
                              float radius, int largest_pair_count, Executor& executor);

}  // namespace fitroom
