#include "fit_client/fit/panels/exact_predicates.h"

#include <cmath>

namespace fitroom::panels {
namespace {

__extension__ using Int128 = __int128;

// Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997), bound A of the
// in-circle test: below it the sign of the rounded determinant is certain. The differences are exact here.
constexpr double kErrorBound = 1.2e-15;

}  // namespace

bool InCircle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const int64_t adx = a.x - d.x, ady = a.y - d.y;
  const int64_t bdx = b.x - d.x, bdy = b.y - d.y;
  const int64_t cdx = c.x - d.x, cdy = c.y - d.y;
  // The 2x2 minors are at most 2^60 and the squared lengths at most 2^61: both fit 64 bits.
  const int64_t bc = bdx * cdy - cdx * bdy;
  const int64_t ca = cdx * ady - adx * cdy;
  const int64_t ab = adx * bdy - bdx * ady;
  const int64_t a_squared = adx * adx + ady * ady;
  const int64_t b_squared = bdx * bdx + bdy * bdy;
  const int64_t c_squared = cdx * cdx + cdy * cdy;

  const double term_a = static_cast<double>(a_squared) * static_cast<double>(bc);
  const double term_b = static_cast<double>(b_squared) * static_cast<double>(ca);
  const double term_c = static_cast<double>(c_squared) * static_cast<double>(ab);
  const double determinant = term_a + term_b + term_c;
  const double certain = kErrorBound * (std::abs(term_a) + std::abs(term_b) + std::abs(term_c));
  if (determinant > certain) return true;
  if (determinant < -certain) return false;
  const Int128 exact =
      static_cast<Int128>(a_squared) * bc + static_cast<Int128>(b_squared) * ca + static_cast<Int128>(c_squared) * ab;
  return exact > 0;
}

}  // namespace fitroom::panels
