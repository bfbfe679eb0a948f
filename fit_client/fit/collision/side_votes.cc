#include "fit_client/fit/collision/side_votes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace fitroom {
namespace {

constexpr float kSafety = 1.02F;  // Distances are rounded; a touch more than the pitch rules a surface out.

int32_t Root(std::vector<int32_t>& parent, int32_t node) {
  while (parent[static_cast<size_t>(node)] != node) {
    parent[static_cast<size_t>(node)] = parent[static_cast<size_t>(parent[static_cast<size_t>(node)])];
    node = parent[static_cast<size_t>(node)];
  }
  return node;
}

// Lower numbers become roots, so that the result does not depend on the order of joining.
void Join(std::vector<int32_t>& parent, int32_t a, int32_t b) {
  a = Root(parent, a);
  b = Root(parent, b);
  if (a == b) return;
  parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
}

// The connected parts within one brick: part_of_sample gets numbers from 0; returns how many there are.
int FindParts(std::span<const float> distances, int nodes, float pitch, std::span<uint16_t> part_of_sample) {
  std::vector<int32_t> parent(distances.size());
  std::iota(parent.begin(), parent.end(), 0);
  const int strides[3] = {1, nodes, nodes * nodes};
  for (int z = 0; z < nodes; ++z) {
    for (int y = 0; y < nodes; ++y) {
      for (int x = 0; x < nodes; ++x) {
        const int at = x + nodes * (y + nodes * z);
        const int place[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
          if (place[axis] + 1 >= nodes) continue;
          const int other = at + strides[axis];
          const float sum =
              std::abs(distances[static_cast<size_t>(at)]) + std::abs(distances[static_cast<size_t>(other)]);
          if (sum > kSafety * pitch) Join(parent, at, other);
        }
      }
    }
  }
  int count = 0;
  for (size_t at = 0; at < parent.size(); ++at) {
    const int32_t root = Root(parent, static_cast<int32_t>(at));
    part_of_sample[at] =
        root == static_cast<int32_t>(at) ? static_cast<uint16_t>(count++) : part_of_sample[static_cast<size_t>(root)];
  }
  return count;
}

}  // namespace

void SettleSides(const BrickSamples& samples, Executor& executor) {
  const int nodes = samples.nodes;
  const size_t brick_size = static_cast<size_t>(nodes) * static_cast<size_t>(nodes) * static_cast<size_t>(nodes);
  const size_t slot_count = samples.brick_of_slot.size();
  std::vector<uint16_t> parts(samples.distances.size());
  std::vector<int32_t> first_part(slot_count + 1, 0);
  constexpr size_t kSlotsPerTask = 64;
  const auto task_count = static_cast<int>((slot_count + kSlotsPerTask - 1) / kSlotsPerTask);
  executor.Run(task_count, [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kSlotsPerTask;
    for (size_t slot = begin; slot < std::min(begin + kSlotsPerTask, slot_count); ++slot) {
      first_part[slot + 1] = FindParts(samples.distances.subspan(slot * brick_size, brick_size), nodes, samples.pitch,
                                       std::span(parts).subspan(slot * brick_size, brick_size));
    }
  });
  for (size_t slot = 0; slot < slot_count; ++slot) first_part[slot + 1] += first_part[slot];

  // Samples on the border of two bricks are one place.
  std::vector<int32_t> parent(static_cast<size_t>(first_part.back()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto part_at = [&](size_t slot, int x, int y, int z) {
    return first_part[slot] + parts[slot * brick_size + static_cast<size_t>(x + nodes * (y + nodes * z))];
  };
  const int last = nodes - 1;
  for (size_t slot = 0; slot < slot_count; ++slot) {
    for (int axis = 0; axis < 3; ++axis) {
      const int neighbour = samples.slot_at(samples.brick_of_slot[slot] + Eigen::Vector3i::Unit(axis));
      if (neighbour < 0) continue;
      for (int v = 0; v < nodes; ++v) {
        for (int u = 0; u < nodes; ++u) {
          const Eigen::Vector3i here = axis == 0   ? Eigen::Vector3i(last, u, v)
                                       : axis == 1 ? Eigen::Vector3i(u, last, v)
                                                   : Eigen::Vector3i(u, v, last);
          Eigen::Vector3i there = here;
          there[axis] = 0;
          Join(parent, part_at(slot, here.x(), here.y(), here.z()),
               part_at(static_cast<size_t>(neighbour), there.x(), there.y(), there.z()));
        }
      }
    }
  }

  std::vector<int64_t> votes(parent.size(), 0);
  for (size_t slot = 0; slot < slot_count; ++slot) {
    for (size_t i = slot * brick_size; i < (slot + 1) * brick_size; ++i) {
      votes[static_cast<size_t>(first_part[slot] + parts[i])] += std::signbit(samples.distances[i]) ? -1 : 1;
    }
  }
  for (size_t part = 0; part < parent.size(); ++part) {
    const auto root = static_cast<size_t>(Root(parent, static_cast<int32_t>(part)));
    if (root != part) votes[root] += votes[part];
  }
  for (size_t slot = 0; slot < slot_count; ++slot) {
    for (size_t i = slot * brick_size; i < (slot + 1) * brick_size; ++i) {
      const auto root = static_cast<size_t>(Root(parent, first_part[slot] + parts[i]));
      if (votes[root] == 0) continue;
      const float distance = std::abs(samples.distances[i]);
      samples.distances[i] = votes[root] < 0 ? -distance : distance;
    }
  }
}

}  // namespace fitroom
