#include "fit_client/fit/measure/contact_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace fitroom {
namespace {

constexpr double kSewnGap = 2e-3;        // (unit: metre)
constexpr double kFitRadius = 0.025;     // Of the quadric (unit: metre).
constexpr size_t kLargestFit = 120;      // Particles of a quadric; fine meshes need no more.
constexpr size_t kSmallestFit = 8;       // Below, five unknowns are not well known.
constexpr double kSteepestSlope = 0.35;  // Cosine between normals; beyond, a fold is not the same sheet.

// The sewn cloth: neighbours, unit normals and areas, one a particle, of which only the sewn roots are filled.
struct SewnCloth {
  std::vector<int> root;
  std::vector<std::vector<int>> neighbours;
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> rest_areas;  // A third of the triangles' (unit: m^2).
  std::vector<double> worn_areas;
};

SewnCloth Sew(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions) {
  SewnCloth sewn;
  sewn.root = SewParticles(cloth, positions);
  const size_t count = positions.size();
  sewn.neighbours.resize(count);
  sewn.normals.assign(count, Eigen::Vector3d::Zero());
  sewn.rest_areas.assign(count, 0.0);
  sewn.worn_areas.assign(count, 0.0);
  for (const Eigen::Vector3i& t : cloth.triangles) {
    std::array<size_t, 3> c = {};
    for (size_t k = 0; k < 3; ++k) {
      c[k] = static_cast<size_t>(sewn.root[static_cast<size_t>(t[static_cast<Eigen::Index>(k)])]);
    }
    const auto& rest = cloth.rest_positions;
    const Eigen::Vector3d rest_cross = (rest[static_cast<size_t>(t[1])] - rest[static_cast<size_t>(t[0])])
                                           .cross(rest[static_cast<size_t>(t[2])] - rest[static_cast<size_t>(t[0])]);
    const Eigen::Vector3d worn_cross = (positions[c[1]] - positions[c[0]]).cross(positions[c[2]] - positions[c[0]]);
    for (size_t k = 0; k < 3; ++k) {
      sewn.normals[c[k]] += worn_cross;
      sewn.rest_areas[c[k]] += rest_cross.norm() / 6.0;
      sewn.worn_areas[c[k]] += worn_cross.norm() / 6.0;
      sewn.neighbours[c[k]].push_back(static_cast<int>(c[(k + 1) % 3]));
      sewn.neighbours[c[k]].push_back(static_cast<int>(c[(k + 2) % 3]));
    }
  }
  for (size_t i = 0; i < count; ++i) {
    std::sort(sewn.neighbours[i].begin(), sewn.neighbours[i].end());
    sewn.neighbours[i].erase(std::unique(sewn.neighbours[i].begin(), sewn.neighbours[i].end()),
                             sewn.neighbours[i].end());
    const double length = sewn.normals[i].norm();
    if (length > 0.0) sewn.normals[i] /= length;
  }
  return sewn;
}

// The particles within the fit's radius that lie on the same side of folds, the nearest along the mesh first.
std::vector<int> Neighbourhood(const SewnCloth& sewn, const std::vector<Eigen::Vector3d>& positions, int centre,
                               std::vector<int>& visited_by) {
  std::vector<int> found = {centre};
  visited_by[static_cast<size_t>(centre)] = centre;
  for (size_t next = 0; next < found.size() && found.size() < kLargestFit; ++next) {
    for (const int other : sewn.neighbours[static_cast<size_t>(found[next])]) {
      const size_t o = static_cast<size_t>(other);
      if (visited_by[o] == centre) continue;
      visited_by[o] = centre;
      if ((positions[o] - positions[static_cast<size_t>(centre)]).norm() > kFitRadius) continue;
      if (sewn.normals[o].dot(sewn.normals[static_cast<size_t>(centre)]) < kSteepestSlope) continue;
      found.push_back(other);
    }
  }
  return found;
}

// The second derivatives of the height over the tangent plane, as a symmetric matrix in space: the quadric
// h = ax^2/2 + bxy + cy^2/2 + dx + ey fitted to the neighbourhood, curvatures corrected for its slope.
Eigen::Matrix3d FitCurvature(const std::vector<Eigen::Vector3d>& positions, std::span<const int> around,
                             const Eigen::Vector3d& normal) {
  if (around.size() < kSmallestFit) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const Eigen::Vector3d& origin = positions[static_cast<size_t>(around[0])];
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (const int particle : around) {
    const Eigen::Vector3d away = (positions[static_cast<size_t>(particle)] - origin) / kFitRadius;
    const double x = u.dot(away);
    const double y = v.dot(away);
    Eigen::Matrix<double, 6, 1> row;
    row << 0.5 * x * x, x * y, 0.5 * y * y, x, y, 1.0;
    squares += row * row.transpose();
    right += row * normal.dot(away);
  }
  squares.diagonal().array() += 1e-9;
  const Eigen::Matrix<double, 6, 1> fit = squares.ldlt().solve(right);
  // Normal curvature of a graph: second derivative over sqrt(1 + slope^2), to first order of the slope's square.
  const double scale = 1.0 / (kFitRadius * std::sqrt(1.0 + fit[3] * fit[3] + fit[4] * fit[4]));
  return scale *
         (fit[0] * u * u.transpose() + fit[1] * (u * v.transpose() + v * u.transpose()) + fit[2] * v * v.transpose());
}

}  // namespace

std::vector<int> SewParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions) {
  std::vector<int> sewn(positions.size());
  std::iota(sewn.begin(), sewn.end(), 0);
  const auto root = [&sewn](int i) {
    while (sewn[static_cast<size_t>(i)] != i) i = sewn[static_cast<size_t>(i)];
    return i;
  };
  for (const SeamPair& pair : cloth.seams) {
    if ((positions[static_cast<size_t>(pair.a)] - positions[static_cast<size_t>(pair.b)]).norm() > kSewnGap) continue;
    const int a = root(pair.a);
    const int b = root(pair.b);
    sewn[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (size_t i = 0; i < sewn.size(); ++i) sewn[i] = root(static_cast<int>(i));
  return sewn;
}

std::vector<double> LaplacePressure(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                    std::span<const TriangleStrain> strains, double stretch_stiffness) {
  std::vector<double> pressures(positions.size(), 0.0);
  if (positions.size() != cloth.rest_positions.size() || strains.size() != cloth.triangles.size()) return pressures;
  const SewnCloth sewn = Sew(cloth, positions);
  std::vector<Eigen::Matrix3d> tensions(positions.size(), Eigen::Matrix3d::Zero());
  for (size_t index = 0; index < strains.size(); ++index) {
    const TriangleStrain& strain = strains[index];
    const PrincipalTension tension = ComputeTension(strain, stretch_stiffness);
    // ComputeTension() is per width at rest; what presses is per width as worn. Where the sheet wrinkles across, that
    // is its natural contraction, a third of the stretch.
    const double narrower = std::max({1.0 + strain.smallest, 1.0 - strain.largest / 3.0, 0.5});
    const double wider = std::max(1.0 + strain.largest, 0.5);
    const Eigen::Matrix3d tensor =
        tension.largest / narrower * strain.largest_direction * strain.largest_direction.transpose() +
        tension.smallest / wider * strain.smallest_direction * strain.smallest_direction.transpose();
    for (const int corner : cloth.triangles[index]) {
      tensions[static_cast<size_t>(sewn.root[static_cast<size_t>(corner)])] += strain.rest_area / 3.0 * tensor;
    }
  }
  std::vector<int> visited_by(positions.size(), -1);
  for (size_t i = 0; i < positions.size(); ++i) {
    if (sewn.root[i] != static_cast<int>(i)) {
      pressures[i] = pressures[static_cast<size_t>(sewn.root[i])];  // The root is the lower one: done already.
      continue;
    }
    if (!(sewn.rest_areas[i] > 0.0)) continue;
    const std::vector<int> around = Neighbourhood(sewn, positions, static_cast<int>(i), visited_by);
    const Eigen::Matrix3d curvature = FitCurvature(positions, around, sewn.normals[i]);
    // Height falls away from the tangent plane where the sheet is wrapped round something: negative there.
    pressures[i] = -(tensions[i] / sewn.rest_areas[i]).cwiseProduct(curvature).sum();
  }
  return pressures;
}

std::vector<double> ContactForcePressure(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                         const Fabric& fabric, const Eigen::Vector3d& gravity) {
  std::vector<double> pressures(positions.size(), 0.0);
  if (positions.size() != cloth.rest_positions.size()) return pressures;
  const SewnCloth sewn = Sew(cloth, positions);
  struct Spring {
    double rest_length_sum = 0.0;
    double area = 0.0;
    int use_count = 0;
  };
  std::map<std::pair<int, int>, Spring> springs;
  for (const Eigen::Vector3i& t : cloth.triangles) {
    const auto rest = [&](int corner) { return cloth.rest_positions[static_cast<size_t>(t[corner])]; };
    const double area = 0.5 * (rest(1) - rest(0)).cross(rest(2) - rest(0)).norm();
    for (int k = 0; k < 3; ++k) {
      const int a = sewn.root[static_cast<size_t>(t[k])];
      const int b = sewn.root[static_cast<size_t>(t[(k + 1) % 3])];
      if (a == b) continue;
      Spring& spring = springs[std::minmax(a, b)];
      spring.rest_length_sum += (rest((k + 1) % 3) - rest(k)).norm();
      spring.area += area;
      ++spring.use_count;
    }
  }
  std::vector<Eigen::Vector3d> forces(positions.size(), Eigen::Vector3d::Zero());
  for (const auto& [ends, spring] : springs) {
    const double length = spring.rest_length_sum / spring.use_count;
    const size_t a = static_cast<size_t>(ends.first);
    const size_t b = static_cast<size_t>(ends.second);
    const Eigen::Vector3d way = positions[b] - positions[a];
    if (!(length > 0.0) || !(way.norm() > 0.0)) continue;
    const double stiffness = fabric.stretch_stiffness * spring.area / (length * length);
    const Eigen::Vector3d pull = stiffness * (way.norm() - length) * way.normalized();
    forces[a] += pull;
    forces[b] -= pull;
  }
  for (size_t i = 0; i < positions.size(); ++i) {
    const size_t root = static_cast<size_t>(sewn.root[i]);
    if (root != i) {
      pressures[i] = pressures[root];
      continue;
    }
    if (!(sewn.worn_areas[i] > 0.0)) continue;
    const Eigen::Vector3d force = forces[i] + fabric.areal_density * sewn.rest_areas[i] * gravity;
    pressures[i] = -sewn.normals[i].dot(force) / sewn.worn_areas[i];
  }
  return pressures;
}

PressureBand PressureBandOf(double pressure) {
  if (pressure < 400.0) return PressureBand::kNegligible;
  if (pressure < 1300.0) return PressureBand::kComfortable;
  if (pressure < 2000.0) return PressureBand::kCritical;
  if (pressure < 3300.0) return PressureBand::kMedical;
  return PressureBand::kHarmful;
}

const char* PressureBandWords(PressureBand band) {
  switch (band) {
    case PressureBand::kNegligible:
      return "negligible";
    case PressureBand::kComfortable:
      return "comfortable";
    case PressureBand::kCritical:
      return "critical for casual wear";
    case PressureBand::kMedical:
      return "as medical or shapewear";
    case PressureBand::kHarmful:
      return "too high to wear";
  }
  return "";
}

}  // namespace fitroom
