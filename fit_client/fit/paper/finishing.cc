#include "fit_client/fit/paper/finishing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "common/base/check.h"
#include "fit_client/fit/collision/triangle_distance.h"

namespace fitroom::paper {

FootOfNormal FindFootOfNormal(const TriangleMesh& body, const Eigen::Vector3d& point) {
  FR_CHECK(!body.triangles.empty());
  FootOfNormal nearest;
  double nearest_distance = std::numeric_limits<double>::infinity();
  double largest_plane_distance = 0.0;
  for (const Eigen::Vector3i& triangle : body.triangles) {
    const Eigen::Vector3d& a = body.vertices[static_cast<size_t>(triangle[0])];
    const Eigen::Vector3d& b = body.vertices[static_cast<size_t>(triangle[1])];
    const Eigen::Vector3d& c = body.vertices[static_cast<size_t>(triangle[2])];
    const Eigen::Vector3d foot = ClosestPointOnTriangle<double>(point, a, b, c).point;
    const double distance = (point - foot).norm();
    if (distance > nearest_distance + 1e-9) continue;
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    const double plane_distance = normal.dot(point - a);
    // Of triangles that share the nearest edge or corner the one that faces the point most has the sign.
    if (distance < nearest_distance - 1e-9 || std::abs(plane_distance) > largest_plane_distance) {
      nearest_distance = std::min(nearest_distance, distance);
      largest_plane_distance = std::abs(plane_distance);
      nearest = {foot, std::copysign(distance, plane_distance)};
    }
  }
  return nearest;
}

bool TopIsDone(std::span<const double> signed_distances, double epsilon) {
  return std::all_of(signed_distances.begin(), signed_distances.end(),
                     [&](double distance) { return distance < epsilon; });
}

double DistanceToTheLetter(const Eigen::Vector3d& unit_normal, const Eigen::Vector3d& point) {
  return (unit_normal - point).norm();
}

double ChainLength(std::span<const Eigen::Vector3d> chain) {
  double length = 0.0;
  for (size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  return length;
}

bool BottomIsDone(const std::array<double, 2>& rest_lengths, const std::array<double, 2>& lengths, double epsilon) {
  return std::abs(rest_lengths[0] - lengths[0]) + std::abs(rest_lengths[1] - lengths[1]) < epsilon;
}

std::vector<double> MeanSpeeds(std::span<const Eigen::Vector3d> before, std::span<const Eigen::Vector3d> after,
                               double seconds) {
  FR_CHECK(before.size() == after.size());
  std::vector<double> speeds;
  speeds.reserve(after.size());
  for (size_t i = 0; i < after.size(); ++i) speeds.push_back((after[i] - before[i]).norm() / seconds);
  return speeds;
}

double ShareAtRest(std::span<const double> speeds, double rest_speed) {
  if (speeds.empty()) return 1.0;
  const auto slow = std::count_if(speeds.begin(), speeds.end(), [&](double speed) { return speed < rest_speed; });
  return static_cast<double>(slow) / static_cast<double>(speeds.size());
}

}  // namespace fitroom::paper
