#include "fit_client/fit/solver/drape_lift_out.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fitroom {
namespace {

// The way from a place that is closer to the body than kLiftedDistance to one that is not; zero where there is none to
// go. Nearest: straight off the next wall. Else off what the field sees from a cell away, which leads out of a crevice
// whose walls are nearer to each other than that.
Eigen::Vector3d WayOut(const SignedDistanceField& body, const Eigen::Vector3d& place, bool nearest) {
  if (body.Distance(place) > 0.5 * body.pitch()) return Eigen::Vector3d::Zero();
  const double distance = body.ExactDistance(place);
  if (distance >= kLiftedDistance) return Eigen::Vector3d::Zero();
  if (!nearest) {
    const Eigen::Vector3d outward = body.Query(place).gradient;
    if (outward.norm() < 0.1) return Eigen::Vector3d::Zero();
    return outward.normalized() * (2.0 * kLiftedDistance - distance);
  }
  // The interpolated gradient is rounded off where a surface is sharp, which is where this is needed.
  constexpr double kStep = 1e-4;
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (body.ExactDistance(place + step) - body.ExactDistance(place - step)) / (2.0 * kStep);
  }
  if (gradient.norm() < 0.1) return Eigen::Vector3d::Zero();
  return gradient.normalized() * (2.0 * kLiftedDistance - distance);
}

}  // namespace

std::vector<Eigen::Vector3d> LiftOut(const ClothModel& model, const SignedDistanceField& body,
                                     std::vector<Eigen::Vector3d> places) {
  constexpr int kNearestRounds = 12;
  constexpr int kRounds = 48;
  const auto for_each_sample = [&](const auto& visit) {
    for (int particle = 0; particle < model.particle_count(); ++particle) visit(std::array<int, 1>{particle});
    for (const auto& edge : model.edges()) visit(edge);
    for (const auto& triangle : model.triangles()) visit(triangle);
  };
  const auto way_of = [&](const auto& corners, bool nearest) -> Eigen::Vector3d {
    Eigen::Vector3d sample = Eigen::Vector3d::Zero();
    for (const int corner : corners) sample += places[static_cast<size_t>(corner)];
    return WayOut(body, sample / static_cast<double>(corners.size()), nearest);
  };
  std::vector<Eigen::Vector3d> best = places;
  double shortest = std::numeric_limits<double>::infinity();  // Of the longest ways that are left, over the rounds.
  for (int round = 0; round < kRounds; ++round) {
    double longest_left = 0.0;
    for_each_sample(
        [&](const auto& corners) { longest_left = std::max(longest_left, way_of(corners, /*nearest=*/true).norm()); });
    if (longest_left < shortest) {
      shortest = longest_left;
      best = places;
    }
    if (longest_left == 0.0) break;
    // One after the other, so that each sees where the last one went: together, the ways out of a crease's two walls
    // would throw the cloth to and fro between them.
    for_each_sample([&](const auto& corners) {
      const Eigen::Vector3d way = way_of(corners, round < kNearestRounds);
      for (const int corner : corners) places[static_cast<size_t>(corner)] += way;
    });
  }
  return best;
}

}  // namespace fitroom
