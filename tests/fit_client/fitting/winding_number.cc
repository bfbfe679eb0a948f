#include "tests/fit_client/fitting/winding_number.h"

#include <cmath>
#include <numbers>

namespace fitroom::testing {

double WindingNumber(const TriangleMesh& closed, const Eigen::Vector3d& point) {
  double solid_angle = 0.0;
  for (const Eigen::Vector3i& triangle : closed.triangles) {
    const Eigen::Vector3d a = closed.vertices[static_cast<size_t>(triangle[0])] - point;
    const Eigen::Vector3d b = closed.vertices[static_cast<size_t>(triangle[1])] - point;
    const Eigen::Vector3d c = closed.vertices[static_cast<size_t>(triangle[2])] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double numerator = a.dot(b.cross(c));
    const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    solid_angle += 2.0 * std::atan2(numerator, denominator);
  }
  return solid_angle / (4.0 * std::numbers::pi);
}

}  // namespace fitroom::testing
