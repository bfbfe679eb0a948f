#pragma once

#include <array>
#include <span>
#include <vector>

#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom {

// Lists of numbers, one list an owner, in one piece of memory.
struct NumberLists {
  std::vector<int> begin;  // One an owner, plus one.
  std::vector<int> items;

  std::span<const int> Of(int owner) const {
    const size_t first = static_cast<size_t>(begin[static_cast<size_t>(owner)]);
    return {items.data() + first, static_cast<size_t>(begin[static_cast<size_t>(owner) + 1]) - first};
  }
};

// Returns the lists of `owner_count` owners from pairs (owner, item), each list in the order of the pairs.
NumberLists MakeNumberLists(int owner_count, std::span<const std::array<int, 2>> owned);

// Who neighbours whom in a cloth. Immutable.
struct SelfCollisionTopology {
  NumberLists triangles_of_particle;
  NumberLists edges_of_particle;
  NumberLists neighbours_of_particle;                 // Along edges, without the particle itself.
  std::vector<std::array<int, 2>> triangles_of_edge;  // -1 where there is none; of more than two the first two.
  double mean_edge_length = 0.0;                      // At rest (unit: metre).
};

SelfCollisionTopology MakeSelfCollisionTopology(const ClothModel& model);

}  // namespace fitroom
