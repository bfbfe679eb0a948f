#pragma once

#include <cstdint>

namespace fitroom::panels {

// A point on the integer grid on which the predicates are exact. One step is 2^-24 m (60 nm); coordinates stay within
// ±2^28 (±16 m), so that every determinant below fits its integer type.
struct GridPoint {
  int64_t x = 0;
  int64_t y = 0;
};

constexpr double kGridStepsPerMetre = 16777216.0;      // 2^24.
constexpr int64_t kGridLimit = int64_t{1} << 28;       // Largest coordinate, for the enclosing triangle.
constexpr int64_t kGridInputLimit = int64_t{1} << 26;  // Largest coordinate of an input point (±4 m).

// Returns twice the signed area of the triangle a, b, c: positive if counter-clockwise. Exact.
inline int64_t Orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Says whether d lies strictly inside the circle through the counter-clockwise triangle a, b, c. Exact.
bool InCircle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

}  // namespace fitroom::panels
