#include "fit_client/fit/measure/cloth_strain.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace fitroom {
namespace {

constexpr double kPoissonRatio = 1.0 / 3.0;
constexpr double kSmallestArea = 1e-12;  // (unit: m^2)

// Axes in the plane of a triangle at rest: the first as level as the plane allows, the second upwards.
struct PlaneAxes {
  Eigen::Vector3d level;
  Eigen::Vector3d up;
};

PlaneAxes AxesOf(const Eigen::Vector3d& normal) {
  PlaneAxes axes;
  const Eigen::Vector3d level = Eigen::Vector3d::UnitY().cross(normal);
  axes.level = level.norm() > 1e-6 ? Eigen::Vector3d(level.normalized()) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  // Front and back panels face opposite ways; both are described as seen from the front.
  if (axes.level.x() < 0.0) axes.level = -axes.level;
  axes.up = normal.cross(axes.level);
  if (axes.up.y() < 0.0) axes.up = -axes.up;
  return axes;
}

}  // namespace

std::vector<TriangleStrain> ComputeStrain(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions) {
  std::vector<TriangleStrain> strains(cloth.triangles.size());
  if (positions.size() != cloth.rest_positions.size()) return strains;
  for (size_t index = 0; index < strains.size(); ++index) {
    const Eigen::Vector3i& t = cloth.triangles[index];
    const auto rest = [&](int corner) { return cloth.rest_positions[static_cast<size_t>(t[corner])]; };
    const auto worn = [&](int corner) { return positions[static_cast<size_t>(t[corner])]; };
    const Eigen::Vector3d rest_1 = rest(1) - rest(0);
    const Eigen::Vector3d rest_2 = rest(2) - rest(0);
    const Eigen::Vector3d twice_area = rest_1.cross(rest_2);
    TriangleStrain& strain = strains[index];
    if (!(0.5 * twice_area.norm() > kSmallestArea)) continue;
    Eigen::Matrix<double, 3, 2> worn_edges;
    worn_edges << worn(1) - worn(0), worn(2) - worn(0);
    if (!worn_edges.allFinite()) continue;
    strain.rest_area = 0.5 * twice_area.norm();
    const PlaneAxes axes = AxesOf(twice_area.normalized());
    Eigen::Matrix2d rest_edges;
    rest_edges << axes.level.dot(rest_1), axes.level.dot(rest_2), axes.up.dot(rest_1), axes.up.dot(rest_2);
    const Eigen::Matrix<double, 3, 2> gradient = worn_edges * rest_edges.inverse();
    const Eigen::Matrix2d metric = gradient.transpose() * gradient;
    // Eigenvalues of a symmetric 2 x 2 matrix in closed form.
    const double mean = 0.5 * metric.trace();
    const double half_difference = 0.5 * (metric(0, 0) - metric(1, 1));
    const double radius = std::hypot(half_difference, metric(0, 1));
    strain.largest = std::sqrt(std::max(0.0, mean + radius)) - 1.0;
    strain.smallest = std::sqrt(std::max(0.0, mean - radius)) - 1.0;
    strain.rest_angle = 0.5 * std::atan2(metric(0, 1), half_difference);
    const Eigen::Vector2d along(std::cos(strain.rest_angle), std::sin(strain.rest_angle));
    const Eigen::Vector3d largest = gradient * along;
    const Eigen::Vector3d smallest = gradient * Eigen::Vector2d(-along.y(), along.x());
    if (largest.norm() > 1e-9) strain.largest_direction = largest.normalized();
    if (smallest.norm() > 1e-9) strain.smallest_direction = smallest.normalized();
  }
  return strains;
}

PrincipalTension ComputeTension(const TriangleStrain& strain, double stretch_stiffness) {
  const double plane = stretch_stiffness / (1.0 - kPoissonRatio * kPoissonRatio);
  const double smallest = plane * (strain.smallest + kPoissonRatio * strain.largest);
  if (smallest > 0.0) return {plane * (strain.largest + kPoissonRatio * strain.smallest), smallest};
  return {stretch_stiffness * std::max(0.0, strain.largest), 0.0};
}

}  // namespace fitroom
