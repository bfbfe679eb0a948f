#include "fit_client/fit/collision/brick_filler.h"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fitroom {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::infinity();

// A function that is linear along a row of samples.
struct Linear {
  float start = 0.0F;
  float slope = 0.0F;
};

__m128 At(const Linear& line, __m128 x) {
  return _mm_add_ps(_mm_set1_ps(line.start), _mm_mul_ps(_mm_set1_ps(line.slope), x));
}

// What the squared distance to one triangle needs, for a row of samples that runs along x. The distance is that to the
// plane where the sample projects into the triangle, and that to the closest of three segments elsewhere.
class TriangleRow {
 public:
  TriangleRow(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) : corners_{a, b, c} {
    normal_ = (b - a).cross(c - a);
    const float squared = normal_.squaredNorm();
    per_squared_normal_ = squared > 0.0F ? 1.0F / squared : 0.0F;
    for (size_t edge = 0; edge < 3; ++edge) {
      edges_[edge] = corners_[(edge + 1) % 3] - corners_[edge];
      inward_[edge] = normal_.cross(edges_[edge]);
      const float length = edges_[edge].squaredNorm();
      per_squared_edge_[edge] = length > 0.0F ? 1.0F / length : 0.0F;
    }
  }

  // Puts the row's start at `origin`; samples are at origin + (x, 0, 0).
  void Start(const Eigen::Vector3f& origin) {
    for (size_t edge = 0; edge < 3; ++edge) {
      const Eigen::Vector3f way = origin - corners_[edge];
      side_[edge] = {inward_[edge].dot(way), inward_[edge].x()};
      along_[edge] = {edges_[edge].dot(way) * per_squared_edge_[edge], edges_[edge].x() * per_squared_edge_[edge]};
      ways_[edge] = way;
    }
    height_ = {normal_.dot(ways_[0]), normal_.x()};
  }

  // Squared distances of four samples.
  __m128 SquaredDistance(__m128 x) const {
    const __m128 zero = _mm_setzero_ps();
    const __m128 one = _mm_set1_ps(1.0F);
    __m128 inside = _mm_cmpge_ps(At(side_[0], x), zero);
    inside = _mm_and_ps(inside, _mm_cmpge_ps(At(side_[1], x), zero));
    inside = _mm_and_ps(inside, _mm_cmpge_ps(At(side_[2], x), zero));
    __m128 nearest = _mm_set1_ps(kUnknown);
    for (size_t edge = 0; edge < 3; ++edge) {
      const __m128 t = _mm_min_ps(_mm_max_ps(At(along_[edge], x), zero), one);
      const __m128 dx = _mm_sub_ps(_mm_add_ps(_mm_set1_ps(ways_[edge].x()), x), _mm_mul_ps(t, Set(edges_[edge].x())));
      const __m128 dy = _mm_sub_ps(Set(ways_[edge].y()), _mm_mul_ps(t, Set(edges_[edge].y())));
      const __m128 dz = _mm_sub_ps(Set(ways_[edge].z()), _mm_mul_ps(t, Set(edges_[edge].z())));
      const __m128 squared = _mm_add_ps(_mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy)), _mm_mul_ps(dz, dz));
      nearest = _mm_min_ps(nearest, squared);
    }
    const __m128 height = At(height_, x);
    const __m128 plane = _mm_mul_ps(_mm_mul_ps(height, height), Set(per_squared_normal_));
    // A triangle without an area has no plane: its sides are all zero and would look inside.
    inside = _mm_and_ps(inside, _mm_cmpgt_ps(Set(per_squared_normal_), zero));
    return _mm_or_ps(_mm_and_ps(inside, plane), _mm_andnot_ps(inside, nearest));
  }

 private:
  static __m128 Set(float value) { return _mm_set1_ps(value); }

  std::array<Eigen::Vector3f, 3> corners_;
  std::array<Eigen::Vector3f, 3> edges_;
  std::array<Eigen::Vector3f, 3> inward_;
  std::array<Eigen::Vector3f, 3> ways_;
  std::array<float, 3> per_squared_edge_ = {};
  std::array<Linear, 3> side_;
  std::array<Linear, 3> along_;
  Eigen::Vector3f normal_;
  Linear height_;
  float per_squared_normal_ = 0.0F;
};

}  // namespace

BrickFiller::BrickFiller(const SurfaceTriangles& surface, float pitch) : surface_(surface), pitch_(pitch) {}

void BrickFiller::Fill(const Eigen::Vector3i& first_node, std::span<const uint32_t> near,
                       std::span<const int32_t, 27> hints) {
  first_node_ = first_node;
  const float reach = kNearCells * pitch_;
  squared_.fill(reach * reach);
  triangle_.fill(-1);
  for (const uint32_t triangle : near) Splat(triangle);
  bool any_near = false;
  for (int z = 0; z < kNodes; ++z) {
    for (int y = 0; y < kNodes; ++y) {
      for (int x = 0; x < kNodes; ++x) {
        const size_t index = Index(x, y, z);
        is_near_[index] = triangle_[index] >= 0;
        side_[index] = 0;
        any_near = any_near || is_near_[index];
        if (is_near_[index]) {
          const SurfaceTriangles::Offset offset =
              surface_.OffsetFrom(static_cast<size_t>(triangle_[index]), Place(x, y, z));
          squared_[index] = offset.squared_distance;
          side_[index] = offset.is_inside ? -1 : 1;
        } else {
          squared_[index] = kUnknown;
        }
      }
    }
  }
  TakeHints(hints);
  if (!any_near) {  // The surface only comes near, so there are few triangles: let each be tried from its corner on.
    for (const uint32_t triangle : near) {
      const Eigen::Vector3i node =
          ((surface_.Corner(triangle, 0) / pitch_).array().round().cast<int>().matrix() - first_node_)
              .cwiseMax(0)
              .cwiseMin(kNodes - 1);
      Consider(static_cast<int32_t>(triangle), node.x(), node.y(), node.z());
    }
  }
  SpreadTriangles();
  if (!any_near) {  // All on one side: the closest sample is the surest.
    size_t closest = Index(0, 0, 0);
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    for (int z = 0; z < kNodes; ++z) {
      for (int y = 0; y < kNodes; ++y) {
        for (int x = 0; x < kNodes; ++x) {
          if (!(squared_[Index(x, y, z)] < squared_[closest])) continue;
          closest = Index(x, y, z);
          at = {x, y, z};
        }
      }
    }
    const SurfaceTriangles::Offset offset =
        surface_.OffsetFrom(static_cast<size_t>(triangle_[closest]), Place(at.x(), at.y(), at.z()));
    side_[closest] = offset.is_inside ? -1 : 1;
  }
  SpreadSigns();
}

// Lowers the squared distances of the samples near a triangle, four at a time.
void BrickFiller::Splat(uint32_t triangle) {
  const Eigen::Vector3f& a = surface_.Corner(triangle, 0);
  const Eigen::Vector3f& b = surface_.Corner(triangle, 1);
  const Eigen::Vector3f& c = surface_.Corner(triangle, 2);
  const float reach = kNearCells * pitch_;
  const Eigen::Array3f low = (a.cwiseMin(b).cwiseMin(c).array() - reach) / pitch_;
  const Eigen::Array3f high = (a.cwiseMax(b).cwiseMax(c).array() + reach) / pitch_;
  const Eigen::Vector3i from = (low.ceil().cast<int>().matrix() - first_node_).cwiseMax(0);
  const Eigen::Vector3i to = (high.floor().cast<int>().matrix() - first_node_).cwiseMin(kNodes - 1);
  if ((from.array() > to.array()).any()) return;
  TriangleRow row(a, b, c);
  const __m128i id = _mm_set1_epi32(static_cast<int32_t>(triangle));
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      row.Start(Place(0, y, z));
      for (int x = from.x() & ~3; x <= to.x(); x += 4) {
        const float first = static_cast<float>(x) * pitch_;
        const __m128 xs = _mm_set_ps(first + 3 * pitch_, first + 2 * pitch_, first + pitch_, first);
        const __m128 squared = row.SquaredDistance(xs);
        float* const known = &squared_[Index(x, y, z)];
        __m128i* const ids = reinterpret_cast<__m128i*>(&triangle_[Index(x, y, z)]);
        const __m128 old = _mm_load_ps(known);
        const __m128 closer = _mm_cmplt_ps(squared, old);
        _mm_store_ps(known, _mm_min_ps(squared, old));
        const __m128i mask = _mm_castps_si128(closer);
        _mm_store_si128(ids, _mm_or_si128(_mm_and_si128(mask, id), _mm_andnot_si128(mask, _mm_load_si128(ids))));
      }
    }
  }
}

void BrickFiller::Consider(int32_t triangle, int x, int y, int z) {
  const size_t index = Index(x, y, z);
  if (triangle < 0 || triangle == triangle_[index] || is_near_[index]) return;
  const float limit = triangle_[index] < 0 ? kUnknown : std::sqrt(squared_[index]);
  const float squared = surface_.SquaredDistance(static_cast<size_t>(triangle), Place(x, y, z), limit);
  if (!(squared < squared_[index])) return;
  squared_[index] = squared;
  triangle_[index] = triangle;
}

void BrickFiller::TakeHints(std::span<const int32_t, 27> hints) {
  for (int z = 0; z < kNodes; ++z) {
    for (int y = 0; y < kNodes; ++y) {
      for (int x = 0; x < kNodes; ++x) {
        Consider(hints[static_cast<size_t>((x + 2) / 4 + 3 * ((y + 2) / 4 + 3 * ((z + 2) / 4)))], x, y, z);
      }
    }
  }
}

// Hands nearest triangles on, forth and back.
void BrickFiller::SpreadTriangles() {
  for (int z = 0; z < kNodes; ++z) {
    for (int y = 0; y < kNodes; ++y) {
      for (int x = 0; x < kNodes; ++x) {
        if (is_near_[Index(x, y, z)]) continue;
        if (x > 0) Consider(triangle_[Index(x - 1, y, z)], x, y, z);
        if (y > 0) Consider(triangle_[Index(x, y - 1, z)], x, y, z);
        if (z > 0) Consider(triangle_[Index(x, y, z - 1)], x, y, z);
      }
    }
  }
  for (int z = kNodes - 1; z >= 0; --z) {
    for (int y = kNodes - 1; y >= 0; --y) {
      for (int x = kNodes - 1; x >= 0; --x) {
        if (is_near_[Index(x, y, z)]) continue;
        if (x + 1 < kNodes) Consider(triangle_[Index(x + 1, y, z)], x, y, z);
        if (y + 1 < kNodes) Consider(triangle_[Index(x, y + 1, z)], x, y, z);
        if (z + 1 < kNodes) Consider(triangle_[Index(x, y, z + 1)], x, y, z);
      }
    }
  }
}

// Samples that are not near are further than a pitch from the surface, so they lie on the side of their neighbours.
// Every pass reaches further; a brick needs one or two.
void BrickFiller::SpreadSigns() {
  bool all_known = false;
  for (int round = 0; round < kSampleCount && !all_known; ++round) {
    all_known = true;
    const auto visit = [&](int x, int y, int z) {
      int8_t& side = side_[Index(x, y, z)];
      if (side == 0 && x > 0) side = side_[Index(x - 1, y, z)];
      if (side == 0 && y > 0) side = side_[Index(x, y - 1, z)];
      if (side == 0 && z > 0) side = side_[Index(x, y, z - 1)];
      if (side == 0 && x + 1 < kNodes) side = side_[Index(x + 1, y, z)];
      if (side == 0 && y + 1 < kNodes) side = side_[Index(x, y + 1, z)];
      if (side == 0 && z + 1 < kNodes) side = side_[Index(x, y, z + 1)];
      all_known = all_known && side != 0;
    };
    for (int z = 0; z < kNodes; ++z) {
      for (int y = 0; y < kNodes; ++y) {
        for (int x = 0; x < kNodes; ++x) visit(x, y, z);
      }
    }
    if (all_known) break;
    all_known = true;
    for (int z = kNodes - 1; z >= 0; --z) {
      for (int y = kNodes - 1; y >= 0; --y) {
        for (int x = kNodes - 1; x >= 0; --x) visit(x, y, z);
      }
    }
  }
}

}  // namespace fitroom
