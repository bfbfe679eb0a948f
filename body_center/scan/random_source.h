#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace fitroom::body_center {

// A stream of numbers that depends on the seed alone, on every platform (SplitMix64, Steele et al. 2014). Not for
// secrets.
class RandomSource {
 public:
  explicit RandomSource(uint64_t seed) : state_(seed) {}

  // Returns an even number in [0, 1).
  double Uniform() {
    state_ += 0x9E3779B97F4A7C15u;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1.0p-53;
  }
  // Returns a normal number of mean 0 and deviation 1 (Box and Muller 1958).
  double Normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace fitroom::body_center
