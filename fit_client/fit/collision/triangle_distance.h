#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fitroom {

// The part of a triangle on which the point closest to a query lies.
//
//            2
//           / \.          edge 0: 0-1, edge 1: 1-2, edge 2: 2-0
//      e2  /   \  e1
//         /     \.
//        0-------1
//            e0
enum class TriangleFeature { kVertex0, kVertex1, kVertex2, kEdge0, kEdge1, kEdge2, kFace };

template <typename Scalar>
struct ClosestPoint {
  Eigen::Matrix<Scalar, 3, 1> point;
  TriangleFeature feature = TriangleFeature::kFace;
};

// Returns the point of triangle (a, b, c) closest to `p` (Ericson, Real-Time Collision Detection, section 5.1.5).
// A degenerate triangle yields the closest point of one of its edges or vertices.
template <typename Scalar>
ClosestPoint<Scalar> ClosestPointOnTriangle(const Eigen::Matrix<Scalar, 3, 1>& p, const Eigen::Matrix<Scalar, 3, 1>& a,
                                            const Eigen::Matrix<Scalar, 3, 1>& b,
                                            const Eigen::Matrix<Scalar, 3, 1>& c) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector ab = b - a;
  const Vector ac = c - a;
  const Vector ap = p - a;
  const Scalar d1 = ab.dot(ap);
  const Scalar d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, TriangleFeature::kVertex0};
  const Vector bp = p - b;
  const Scalar d3 = ab.dot(bp);
  const Scalar d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, TriangleFeature::kVertex1};
  const Scalar vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + ab * (d1 / (d1 - d3)), TriangleFeature::kEdge0};
  const Vector cp = p - c;
  const Scalar d5 = ab.dot(cp);
  const Scalar d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, TriangleFeature::kVertex2};
  const Scalar vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + ac * (d2 / (d2 - d6)), TriangleFeature::kEdge2};
  const Scalar va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return {b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), TriangleFeature::kEdge1};
  }
  const Scalar scale = 1 / (va + vb + vc);
  return {a + ab * (vb * scale) + ac * (vc * scale), TriangleFeature::kFace};
}

// Says whether the segment p-q meets triangle (a, b, c). A segment in the triangle's plane does not count.
bool SegmentCrossesTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace fitroom
