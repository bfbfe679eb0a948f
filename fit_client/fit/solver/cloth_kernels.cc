#include "fit_client/fit/solver/cloth_kernels.h"

#include <immintrin.h>

// Functions of 128 bits are compiled twice, the second time into the kernel of 256 bits, whose encoding they then take.
#define FITROOM_INLINE __attribute__((always_inline)) inline
#define FITROOM_AVX2 __attribute__((target("avx2")))
#define FITROOM_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline

namespace fitroom {
namespace {

constexpr float kTiny = 1e-12F;  // Keeps the length of a spring above zero (unit: m^2).

FITROOM_INLINE __m128 Load(const Float4& value) { return _mm_load_ps(&value.x); }
FITROOM_INLINE void Store(Float4& target, __m128 value) { _mm_store_ps(&target.x, value); }

template <int kLane>
FITROOM_INLINE __m128 Broadcast(__m128 v) {
  return _mm_shuffle_ps(v, v, _MM_SHUFFLE(kLane, kLane, kLane, kLane));
}

// Returns v with the fourth number set to zero.
FITROOM_INLINE __m128 Xyz(__m128 v) {
  const __m128 mask = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
  return _mm_and_ps(v, mask);
}

// Solves four springs that share no particle. `denominator` is 1 / (w_a + w_b + compliance / dt^2).
FITROOM_INLINE void SolveStretchBatch(Float4* positions, const StretchBatch& batch, const Float4& denominator,
                                      __m128 compression_factor) {
  __m128 p[4];
  __m128 q[4];
  __m128 d[4];
  for (int lane = 0; lane < 4; ++lane) {
    p[lane] = Load(positions[batch.a[static_cast<size_t>(lane)]]);
    q[lane] = Load(positions[batch.b[static_cast<size_t>(lane)]]);
    d[lane] = _mm_sub_ps(q[lane], p[lane]);
  }
  __m128 x = d[0];
  __m128 y = d[1];
  __m128 z = d[2];
  __m128 w = d[3];
  _MM_TRANSPOSE4_PS(x, y, z, w);
  const __m128 squared =
      _mm_add_ps(_mm_add_ps(_mm_mul_ps(x, x), _mm_mul_ps(y, y)), _mm_add_ps(_mm_mul_ps(z, z), _mm_set1_ps(kTiny)));
  const __m128 length = _mm_sqrt_ps(squared);
  __m128 excess = _mm_sub_ps(length, _mm_load_ps(batch.rest_length.data()));
  const __m128 shortened = _mm_cmplt_ps(excess, _mm_setzero_ps());
  const __m128 factor =
      _mm_or_ps(_mm_and_ps(shortened, compression_factor), _mm_andnot_ps(shortened, _mm_set1_ps(1.0F)));
  excess = _mm_mul_ps(excess, factor);
  const __m128 scale = _mm_div_ps(_mm_mul_ps(excess, Load(denominator)), length);
  const __m128 s[4] = {Broadcast<0>(scale), Broadcast<1>(scale), Broadcast<2>(scale), Broadcast<3>(scale)};
  for (int lane = 0; lane < 4; ++lane) {
    // The fourth number of d is the difference of inverse masses: cut it off, so that masses stay.
    const __m128 step = _mm_mul_ps(Xyz(d[lane]), s[lane]);
    Store(positions[batch.a[static_cast<size_t>(lane)]], _mm_add_ps(p[lane], _mm_mul_ps(step, Broadcast<3>(p[lane]))));
    Store(positions[batch.b[static_cast<size_t>(lane)]], _mm_sub_ps(q[lane], _mm_mul_ps(step, Broadcast<3>(q[lane]))));
  }
}

// Solves one bend. `moves` are c_i / m_i / (weight + compliance / dt^2).
FITROOM_INLINE void SolveBend(Float4* positions, const BendConstraint& bend, const Float4& moves) {
  Float4& a = positions[bend.particles[0]];
  Float4& b = positions[bend.particles[1]];
  Float4& c = positions[bend.particles[2]];
  Float4& d = positions[bend.particles[3]];
  const __m128 at_a = Load(a);
  const __m128 at_b = Load(b);
  const __m128 at_c = Load(c);
  const __m128 at_d = Load(d);
  const __m128 k = _mm_loadu_ps(bend.coefficients.data());
  const __m128 m = Load(moves);
  const __m128 sum = Xyz(_mm_add_ps(_mm_add_ps(_mm_mul_ps(at_a, Broadcast<0>(k)), _mm_mul_ps(at_b, Broadcast<1>(k))),
                                    _mm_add_ps(_mm_mul_ps(at_c, Broadcast<2>(k)), _mm_mul_ps(at_d, Broadcast<3>(k)))));
  Store(a, _mm_sub_ps(at_a, _mm_mul_ps(sum, Broadcast<0>(m))));
  Store(b, _mm_sub_ps(at_b, _mm_mul_ps(sum, Broadcast<1>(m))));
  Store(c, _mm_sub_ps(at_c, _mm_mul_ps(sum, Broadcast<2>(m))));
  Store(d, _mm_sub_ps(at_d, _mm_mul_ps(sum, Broadcast<3>(m))));
}

void SolveInFour(Float4* positions, const ClothChunk& chunk, const ChunkDenominators& denominators,
                 float compression_factor) {
  const __m128 compression = _mm_set1_ps(compression_factor);
  for (size_t index = 0; index < chunk.bend.size(); ++index) {
    SolveBend(positions, chunk.bend[index], denominators.bend[index]);
  }
  for (size_t index = 0; index < chunk.stretch.size(); ++index) {
    SolveStretchBatch(positions, chunk.stretch[index], denominators.stretch[index], compression);
  }
}

// The first of two neighbours lies in the lower half of a register, the second in the upper.
FITROOM_AVX2_INLINE __m256 LoadTwo(const Float4& low, const Float4& high) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(Load(low)), Load(high), 1);
}
FITROOM_AVX2_INLINE void StoreTwo(Float4& low, Float4& high, __m256 value) {
  Store(low, _mm256_castps256_ps128(value));
  Store(high, _mm256_extractf128_ps(value, 1));
}
template <int kLane>
FITROOM_AVX2_INLINE __m256 BroadcastTwo(__m256 v) {
  return _mm256_shuffle_ps(v, v, _MM_SHUFFLE(kLane, kLane, kLane, kLane));
}
FITROOM_AVX2_INLINE __m256 XyzTwo(__m256 v) { return _mm256_blend_ps(v, _mm256_setzero_ps(), 0x88); }

// Two batches of one colour: SolveStretchBatch() in both halves.
FITROOM_AVX2_INLINE void SolveTwoBatches(Float4* positions, const StretchBatch* batches, const Float4* denominators,
                                         __m256 compression_factor) {
  __m256 p[4];
  __m256 q[4];
  __m256 d[4];
  for (size_t lane = 0; lane < 4; ++lane) {
    p[lane] = LoadTwo(positions[batches[0].a[lane]], positions[batches[1].a[lane]]);
    q[lane] = LoadTwo(positions[batches[0].b[lane]], positions[batches[1].b[lane]]);
    d[lane] = _mm256_sub_ps(q[lane], p[lane]);
  }
  // Columns from rows, in each half; the fourth column is not needed.
  const __m256 xy_01 = _mm256_unpacklo_ps(d[0], d[1]);
  const __m256 xy_23 = _mm256_unpacklo_ps(d[2], d[3]);
  const __m256 zw_01 = _mm256_unpackhi_ps(d[0], d[1]);
  const __m256 zw_23 = _mm256_unpackhi_ps(d[2], d[3]);
  const __m256 x = _mm256_shuffle_ps(xy_01, xy_23, _MM_SHUFFLE(1, 0, 1, 0));
  const __m256 y = _mm256_shuffle_ps(xy_01, xy_23, _MM_SHUFFLE(3, 2, 3, 2));
  const __m256 z = _mm256_shuffle_ps(zw_01, zw_23, _MM_SHUFFLE(1, 0, 1, 0));
  const __m256 squared = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)),
                                       _mm256_add_ps(_mm256_mul_ps(z, z), _mm256_set1_ps(kTiny)));
  const __m256 length = _mm256_sqrt_ps(squared);
  const __m256 rest = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(batches[0].rest_length.data())),
                                           _mm_load_ps(batches[1].rest_length.data()), 1);
  __m256 excess = _mm256_sub_ps(length, rest);
  const __m256 shortened = _mm256_cmp_ps(excess, _mm256_setzero_ps(), _CMP_LT_OS);
  excess = _mm256_mul_ps(excess, _mm256_blendv_ps(_mm256_set1_ps(1.0F), compression_factor, shortened));
  const __m256 scale = _mm256_div_ps(_mm256_mul_ps(excess, LoadTwo(denominators[0], denominators[1])), length);
  const __m256 s[4] = {BroadcastTwo<0>(scale), BroadcastTwo<1>(scale), BroadcastTwo<2>(scale), BroadcastTwo<3>(scale)};
  for (size_t lane = 0; lane < 4; ++lane) {
    const __m256 step = _mm256_mul_ps(XyzTwo(d[lane]), s[lane]);
    StoreTwo(positions[batches[0].a[lane]], positions[batches[1].a[lane]],
             _mm256_add_ps(p[lane], _mm256_mul_ps(step, BroadcastTwo<3>(p[lane]))));
    StoreTwo(positions[batches[0].b[lane]], positions[batches[1].b[lane]],
             _mm256_sub_ps(q[lane], _mm256_mul_ps(step, BroadcastTwo<3>(q[lane]))));
  }
}

// Two bends of one colour: SolveBend() in both halves.
FITROOM_AVX2_INLINE void SolveTwoBends(Float4* positions, const BendConstraint* bends, const Float4* moves) {
  __m256 at[4];
  for (size_t corner = 0; corner < 4; ++corner) {
    at[corner] = LoadTwo(positions[bends[0].particles[corner]], positions[bends[1].particles[corner]]);
  }
  const __m256 k = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(bends[0].coefficients.data())),
                                        _mm_loadu_ps(bends[1].coefficients.data()), 1);
  const __m256 m = LoadTwo(moves[0], moves[1]);
  const __m256 sum = XyzTwo(
      _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(at[0], BroadcastTwo<0>(k)), _mm256_mul_ps(at[1], BroadcastTwo<1>(k))),
                    _mm256_add_ps(_mm256_mul_ps(at[2], BroadcastTwo<2>(k)), _mm256_mul_ps(at[3], BroadcastTwo<3>(k)))));
  const __m256 moved[4] = {_mm256_mul_ps(sum, BroadcastTwo<0>(m)), _mm256_mul_ps(sum, BroadcastTwo<1>(m)),
                           _mm256_mul_ps(sum, BroadcastTwo<2>(m)), _mm256_mul_ps(sum, BroadcastTwo<3>(m))};
  for (size_t corner = 0; corner < 4; ++corner) {
    StoreTwo(positions[bends[0].particles[corner]], positions[bends[1].particles[corner]],
             _mm256_sub_ps(at[corner], moved[corner]));
  }
}

FITROOM_AVX2 void SolveInEight(Float4* positions, const ClothChunk& chunk, const ChunkDenominators& denominators,
                               float compression_factor) {
  size_t index = 0;
  for (const int end_of_colour : chunk.bend_colour_ends) {
    const size_t end = static_cast<size_t>(end_of_colour);
    for (; index + 1 < end; index += 2) SolveTwoBends(positions, &chunk.bend[index], &denominators.bend[index]);
    for (; index < end; ++index) SolveBend(positions, chunk.bend[index], denominators.bend[index]);
  }
  const __m256 compression = _mm256_set1_ps(compression_factor);
  index = 0;
  for (const int end_of_colour : chunk.stretch_colour_ends) {
    const size_t end = static_cast<size_t>(end_of_colour);
    for (; index + 1 < end; index += 2) {
      SolveTwoBatches(positions, &chunk.stretch[index], &denominators.stretch[index], compression);
    }
    for (; index < end; ++index) {
      SolveStretchBatch(positions, chunk.stretch[index], denominators.stretch[index],
                        _mm256_castps256_ps128(compression));
    }
  }
}

}  // namespace

KernelWidth WidestKernel() {
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? KernelWidth::kEight : KernelWidth::kFour;
}

void SolveChunk(KernelWidth width, std::span<Float4> positions, const ClothChunk& chunk,
                const ChunkDenominators& denominators, float compression_factor) {
  if (width == KernelWidth::kEight) {
    SolveInEight(positions.data(), chunk, denominators, compression_factor);
  } else {
    SolveInFour(positions.data(), chunk, denominators, compression_factor);
  }
}

}  // namespace fitroom
