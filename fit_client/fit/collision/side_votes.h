#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"

namespace fitroom {

// Samples of a signed distance on bricks of nodes x nodes x nodes, borders stored twice.
struct BrickSamples {
  std::span<float> distances;                                // Slot by slot, x fastest (unit: metre).
  std::span<const Eigen::Vector3i> brick_of_slot;            // Place of each stored brick.
  std::function<int(const Eigen::Vector3i& brick)> slot_at;  // -1: not stored, or outside.
  int nodes = 0;                                             // Samples along a brick's edge.
  float pitch = 0.0F;                                        // Between neighbouring samples (unit: metre).
};

// Makes the signs of the samples agree with each other and leaves the distances alone. Two neighbours whose distances
// add up to more than the pitch have no surface between them, so they lie on one side, whatever their nearest triangles
// say. Samples connected that way vote, and the majority's sign holds for all. A scanned surface that folds or cuts
// itself, as holes that were filled may, turns single pseudonormals round; what is left of that after the vote reaches
// no further than half a pitch from the surface. The same signs for any executor.
void SettleSides(const BrickSamples& samples, Executor& executor);

}  // namespace fitroom
