#include "fit_client/fit/solver/self_collision_near.h"

#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace fitroom {
namespace {

constexpr int kParticlesPerTask = 1024;
constexpr float kCellsPerParticle = 64.0F;  // Bounds the memory of a cloth that has flown apart.

// Particles in the order of the cells they lie in, rows of cells along x one after the other.
class ParticleCells {
 public:
  ParticleCells(std::span<const Float4> positions, float smallest_cell);

  int row_count_y() const { return count_[1]; }
  int row_count_z() const { return count_[2]; }
  const std::vector<int>& particles() const { return particles_; }
  // The place of the sorted particle with this number.
  Float4 At(int place) const {
    const size_t index = static_cast<size_t>(place);
    return {sorted_[0][index], sorted_[1][index], sorted_[2][index], 0.0F};
  }
  // Returns which of the four sorted particles from `place` on lie nearer to `at` than the radius, one bit each. What
  // follows the last particle is infinitely far.
  int FourNear(int place, const Float4& at, float squared_radius) const {
    const size_t index = static_cast<size_t>(place);
    const __m128 x = _mm_sub_ps(_mm_loadu_ps(&sorted_[0][index]), _mm_set1_ps(at.x));
    const __m128 y = _mm_sub_ps(_mm_loadu_ps(&sorted_[1][index]), _mm_set1_ps(at.y));
    const __m128 z = _mm_sub_ps(_mm_loadu_ps(&sorted_[2][index]), _mm_set1_ps(at.z));
    const __m128 squared = _mm_add_ps(_mm_add_ps(_mm_mul_ps(x, x), _mm_mul_ps(y, y)), _mm_mul_ps(z, z));
    return _mm_movemask_ps(_mm_cmplt_ps(squared, _mm_set1_ps(squared_radius)));
  }
  std::array<int, 3> CellOf(const Float4& at) const { return {Axis(at.x, 0), Axis(at.y, 1), Axis(at.z, 2)}; }
  // Returns the range of sorted particles in the cells x - 1 to x + 1 of a row.
  std::array<int, 2> Row(int x, int y, int z) const {
    const int first = count_[0] * (y + count_[1] * z);
    return {begin_[static_cast<size_t>(first + std::max(0, x - 1))],
            begin_[static_cast<size_t>(first + std::min(count_[0] - 1, x + 1)) + 1]};
  }

 private:
  int Axis(float value, size_t axis) const {
    return std::clamp(static_cast<int>((value - low_[axis]) * per_cell_), 0, count_[axis] - 1);
  }

  std::array<float, 3> low_ = {};
  std::array<int, 3> count_ = {1, 1, 1};
  float per_cell_ = 1.0F;
  std::vector<int> begin_;
  std::vector<int> particles_;
  std::array<std::vector<float>, 3> sorted_;  // An axis each.
};

ParticleCells::ParticleCells(std::span<const Float4> positions, float smallest_cell) {
  constexpr float kFar = std::numeric_limits<float>::max();
  low_ = {kFar, kFar, kFar};
  std::array<float, 3> high = {-kFar, -kFar, -kFar};
  for (const Float4& at : positions) {
    const std::array<float, 3> place = {at.x, at.y, at.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }
  float volume = 1.0F;
  for (size_t axis = 0; axis < 3; ++axis) volume *= std::max(high[axis] - low_[axis], smallest_cell);
  const float cell =
      std::max(smallest_cell, std::cbrt(volume / (kCellsPerParticle * static_cast<float>(positions.size()))));
  per_cell_ = 1.0F / cell;
  for (size_t axis = 0; axis < 3; ++axis) count_[axis] = static_cast<int>((high[axis] - low_[axis]) * per_cell_) + 1;
  begin_.assign(static_cast<size_t>(count_[0]) * static_cast<size_t>(count_[1]) * static_cast<size_t>(count_[2]) + 1,
                0);
  std::vector<int> cells;
  cells.reserve(positions.size());
  for (const Float4& at : positions) {
    const std::array<int, 3> cell_of = CellOf(at);
    cells.push_back(cell_of[0] + count_[0] * (cell_of[1] + count_[1] * cell_of[2]));
    ++begin_[static_cast<size_t>(cells.back()) + 1];
  }
  for (size_t index = 1; index < begin_.size(); ++index) begin_[index] += begin_[index - 1];
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  particles_.resize(positions.size());
  for (std::vector<float>& axis : sorted_) axis.resize(positions.size() + 3, std::numeric_limits<float>::infinity());
  for (size_t particle = 0; particle < positions.size(); ++particle) {
    const size_t place = static_cast<size_t>(next[static_cast<size_t>(cells[particle])]++);
    particles_[place] = static_cast<int>(particle);
    sorted_[0][place] = positions[particle].x;
    sorted_[1][place] = positions[particle].y;
    sorted_[2][place] = positions[particle].z;
  }
}

// Appends the pairs of the sorted particle at `place` with those after it. `neighbour_of` holds for each particle the
// last one that it was found to neighbour in the mesh.
void AppendPairs(const ParticleCells& cells, const NumberLists& neighbours, int place, float squared_radius,
                 std::vector<int>& neighbour_of, std::vector<std::array<int, 2>>& pairs) {
  const Float4 at = cells.At(place);
  const int particle = cells.particles()[static_cast<size_t>(place)];
  for (const int other : neighbours.Of(particle)) neighbour_of[static_cast<size_t>(other)] = particle;
  const auto scan = [&](int begin, int end) {
    for (int four = begin; four < end; four += 4) {
      unsigned near = static_cast<unsigned>(cells.FourNear(four, at, squared_radius));
      if (end - four < 4) near &= (1U << static_cast<unsigned>(end - four)) - 1U;
      for (; near != 0; near &= near - 1U) {
        const int partner = cells.particles()[static_cast<size_t>(four + std::countr_zero(near))];
        if (neighbour_of[static_cast<size_t>(partner)] != particle) pairs.push_back({particle, partner});
      }
    }
  };
  const auto [x, y, z] = cells.CellOf(at);
  scan(place + 1, cells.Row(x, y, z)[1]);
  // The half of the surrounding rows that come later: then each pair is met once.
  constexpr std::array<std::array<int, 2>, 4> kLaterRows = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  for (const auto& [step_y, step_z] : kLaterRows) {
    const int row_y = y + step_y;
    const int row_z = z + step_z;
    if (row_y < 0 || row_y >= cells.row_count_y() || row_z >= cells.row_count_z()) continue;
    const auto [begin, end] = cells.Row(x, row_y, row_z);
    scan(begin, end);
  }
}

}  // namespace

NumberLists FindNearParticles(std::span<const Float4> positions, int particle_count, const NumberLists& neighbours,
                              float radius, int largest_pair_count, Executor& executor) {
  const ParticleCells cells(positions.first(static_cast<size_t>(particle_count)), radius);
  const int task_count = (particle_count + kParticlesPerTask - 1) / kParticlesPerTask;
  std::vector<std::vector<std::array<int, 2>>> found(static_cast<size_t>(task_count));
  executor.Run(task_count, [&](int task) {
    const int end = std::min((task + 1) * kParticlesPerTask, particle_count);
    std::vector<std::array<int, 2>>& pairs = found[static_cast<size_t>(task)];
    std::vector<int> neighbour_of(static_cast<size_t>(particle_count), -1);
    for (int place = task * kParticlesPerTask; place < end; ++place) {
      if (pairs.size() >= static_cast<size_t>(largest_pair_count)) break;
      AppendPairs(cells, neighbours, place, radius * radius, neighbour_of, pairs);
    }
  });
  std::vector<std::array<int, 2>> owned;
  int count = 0;
  for (const auto& pairs : found) {
    for (const auto& [a, b] : pairs) {
      if (++count > largest_pair_count) break;
      owned.push_back({a, b});
      owned.push_back({b, a});
    }
  }
  return MakeNumberLists(particle_count, owned);
}

}  // namespace fitroom
