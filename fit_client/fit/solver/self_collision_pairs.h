#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/executor.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/self_collision_topology.h"

namespace fitroom {

// Two places of the cloth that must stay apart along a direction, as of the last look at them: a vertex and a point of
// a triangle, or a point of each of two edges.
//
//          v               c
//          | gap            `.   .b
//      c   |                  `:'   gap between the lines
//      |`. |                 .' `.
//      |__`.                a     d
//      a    b
//
// gap = normal . sum_i weights_i x_i, with weights (1, -wa, -wb, -wc) or (1 - s, s, t - 1, -t).
struct alignas(16) ClothContact {
  std::array<int32_t, 4> particles = {};
  std::array<float, 4> weights = {};
  Float4 normal;        // Unit length, so that the gap is positive on the right side; w: gap to keep (unit: metre).
  uint64_t key = 0;     // Names the pair; ordered.
  float scale = 0.0F;   // 1 / sum_i weights_i^2 / m_i (unit: kg)
  int16_t side = 1;     // Whether `normal` is that of the triangle or edge pair (1) or its opposite (-1).
  int16_t strikes = 0;  // How many looks on end have found it on the wrong side.
};

// An edge that passes through a triangle, and the way out: the edge goes along `way`, the triangle against it.
struct ClothCrossing {
  int edge = 0;
  int triangle = 0;
  std::array<float, 2> edge_weights = {};      // Of the place that is common to both,
  std::array<float, 3> triangle_weights = {};  // by barycentric coordinates.
  Float4 normal;                               // Of the triangle, on the side of the edge's second end (unit: 1).
  Float4 way;                                  // Length at most 1 (unit: 1).
};

// What a look at the cloth found, each list ordered: contacts by key, crossings by edge and triangle.
struct ClothEncounters {
  std::vector<ClothContact> contacts;
  std::vector<ClothCrossing> crossings;
};

// Narrow phase: returns the pairs whose gap is below `reach` (unit: metre) and the crossings among particles that are
// near each other. Sides are those of the places as they are. Ways out are those that make the line shorter along which
// the two pieces of cloth cut each other (Volino and Magnenat-Thalmann, "Resolving surface collisions through
// intersection contour minimization", 2006). The same for any executor.
ClothEncounters FindEncounters(const ClothModel& model, const SelfCollisionTopology& topology, const NumberLists& near,
                               std::span<const Float4> positions, float reach, Executor& executor);

// Where the cut parts a piece of cloth from the rest, the smaller part is on the wrong side, and the way out of its
// edges is straight back through the triangle: a straight cut across a strip would not become shorter any way.
void TurnPartedPiecesBack(const ClothModel& model, std::span<ClothCrossing> crossings);

}  // namespace fitroom
