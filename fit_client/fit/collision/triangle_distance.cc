#include "fit_client/fit/collision/triangle_distance.h"

#include <cmath>

namespace fitroom {

// Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997, with the ray cut to the segment.
bool SegmentCrossesTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d direction = q - p;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d h = direction.cross(ac);
  const double determinant = ab.dot(h);
  if (std::abs(determinant) < 1e-18) return false;
  const Eigen::Vector3d s = p - a;
  const double u = s.dot(h) / determinant;
  if (u < 0.0 || u > 1.0) return false;
  const Eigen::Vector3d k = s.cross(ab);
  const double v = direction.dot(k) / determinant;
  if (v < 0.0 || u + v > 1.0) return false;
  const double t = ac.dot(k) / determinant;
  return t >= 0.0 && t <= 1.0;
}

}  // namespace fitroom
