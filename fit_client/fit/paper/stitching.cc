#include "fit_client/fit/paper/stitching.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace fitroom::paper {
namespace {

// The axis along which the front panel is thinnest.
int ThinAxis(const ClothMesh& mesh) {
  Eigen::AlignedBox3d bounds;
  for (size_t vertex = 0; vertex < mesh.rest_positions.size(); ++vertex) {
    if (mesh.panel_of_particle[vertex] == 0) bounds.extend(mesh.rest_positions[vertex]);
  }
  int axis = 0;
  bounds.sizes().minCoeff(&axis);
  return axis;
}

int NearestOnBack(const ClothMesh& mesh, size_t front, int thin_axis) {
  int nearest = -1;
  double nearest_squared = std::numeric_limits<double>::infinity();
  for (size_t back = 0; back < mesh.rest_positions.size(); ++back) {
    if (mesh.panel_of_particle[back] != 1) continue;
    Eigen::Vector3d across = mesh.rest_positions[front] - mesh.rest_positions[back];
    across[thin_axis] = 0.0;
    if (across.squaredNorm() < nearest_squared) {
      nearest_squared = across.squaredNorm();
      nearest = static_cast<int>(back);
    }
  }
  return nearest;
}

}  // namespace

Result<std::vector<SeamPair>> FindPartners(const ClothMesh& mesh) {
  const size_t vertex_count = mesh.rest_positions.size();
  const bool has_front = std::count(mesh.panel_of_particle.begin(), mesh.panel_of_particle.end(), 0) > 0;
  const bool has_back = std::count(mesh.panel_of_particle.begin(), mesh.panel_of_particle.end(), 1) > 0;
  if (mesh.panel_of_particle.size() != vertex_count || !has_front || !has_back) {
    return InvalidArgument("PANELS_UNKNOWN",
                           "stitching needs a front and a back panel: the mesh must say for every particle which "
                           "panel it belongs to (0 front, 1 back)");
  }
  const int axis = ThinAxis(mesh);
  std::vector<int> sewn_to(vertex_count, -1);
  for (const SeamPair& pair : mesh.seams) sewn_to[static_cast<size_t>(pair.a)] = pair.b;
  std::vector<SeamPair> pairs;
  for (size_t front = 0; front < vertex_count; ++front) {
    if (mesh.panel_of_particle[front] != 0) continue;
    const int partner = sewn_to[front] >= 0 ? sewn_to[front] : NearestOnBack(mesh, front, axis);
    pairs.push_back({static_cast<int>(front), partner});
  }
  return pairs;
}

Eigen::Vector3d StitchingForce(const Eigen::Vector3d& dp, const Eigen::Vector3d& dv, double force,
                               const StitchingOptions& options) {
  const double distance = dp.norm();
  if (distance == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d direction = dp / distance;
  const double approach_speed = -dv.dot(direction);
  if (options.law == StitchingLaw::kSeamsOnly && approach_speed >= options.closing_speed) {
    return Eigen::Vector3d::Zero();
  }
  return -force * direction;
}

bool Met(const Eigen::Vector3d& dp_before, const Eigen::Vector3d& dp_after, double gap) {
  const Eigen::Vector3d way = dp_after - dp_before;
  const double length_squared = way.squaredNorm();
  const double t = length_squared > 0.0 ? std::clamp(-dp_before.dot(way) / length_squared, 0.0, 1.0) : 0.0;
  return (dp_before + t * way).norm() < gap;
}

}  // namespace fitroom::paper
