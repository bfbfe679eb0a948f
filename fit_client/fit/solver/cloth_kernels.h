#pragma once

#include <span>
#include <vector>

#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom {

// Four floats in one register: a place, direction or velocity and one number that travels with it.
struct alignas(16) Float4 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  float w = 0.0F;
};

// What the constraints of one chunk need beside the model, for one step and one set of masses.
struct ChunkDenominators {
  std::vector<Float4> stretch;  // 1 / (w_a + w_b + compliance / dt^2), one a lane.
  std::vector<Float4> bend;     // c_i / m_i / (weight + compliance / dt^2), one a particle.
};

// Which registers the constraints are solved in. Both do the same operations in the same order for each constraint:
// the same bits.
enum class KernelWidth {
  kFour,   // 128 bits: any x86-64.
  kEight,  // 256 bits (AVX2, no fused operations): two neighbours of one colour at once.
};

// Returns the widest that this processor has.
KernelWidth WidestKernel();

// Solves the bends, then the springs of a chunk, each once and in the order of the chunk. `compression_factor`: the
// stiffness of a shortened spring over that of a stretched one. The positions' fourth numbers are inverse masses.
void SolveChunk(KernelWidth width, std::span<Float4> positions, const ClothChunk& chunk,
                const ChunkDenominators& denominators, float compression_factor);

}  // namespace fitroom
