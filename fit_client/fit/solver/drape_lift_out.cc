#include "fit_client/fit/solver/drape_lift_out.h"

#include <algorithm>
#include <array>
#include <limits>

namespace fitroom {
namespace {

// The way from a place that is closer to the body than kLiftedDistance to one that is not; zero where there is none to
// go.
Eigen::Vector3d WayOut(const SignedDistanceField& body, const Eigen::Vector3d& place) {
  if (body.Distance(place) > 0.5 * body.pitch()) return Eigen::Vector3d::Zero();
  const double distance = body.ExactDistance(place);
  if (distance >= kLiftedDistance) return Eigen::Vector3d::Zero();
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
  constexpr int kRounds = 12;
  std::vector<Eigen::Vector3d> best = places;
  double shortest = std::numeric_limits<double>::infinity();  // Of the longest ways that are left, over the rounds.
  std::vector<Eigen::Vector3d> ways(places.size());
  for (int round = 0; round < kRounds; ++round) {
    std::fill(ways.begin(), ways.end(), Eigen::Vector3d::Zero());
    double longest_left = 0.0;
    const auto lift = [&](const auto& corners) {
      Eigen::Vector3d sample = Eigen::Vector3d::Zero();
      for (const int corner : corners) sample += places[static_cast<size_t>(corner)];
      sample /= static_cast<double>(corners.size());
      const Eigen::Vector3d way = WayOut(body, sample);
      if (way.isZero()) return;
      longest_left = std::max(longest_left, way.norm());
      for (const int corner : corners) {
        Eigen::Vector3d& longest = ways[static_cast<size_t>(corner)];
        if (way.squaredNorm() > longest.squaredNorm()) longest = way;
      }
    };
    for (int particle = 0; particle < model.particle_count(); ++particle) lift(std::array<int, 1>{particle});
    for (const auto& edge : model.edges()) lift(edge);
    for (const auto& triangle : model.triangles()) lift(triangle);
    if (longest_left < shortest) {
      shortest = longest_left;
      best = places;
    }
    if (longest_left == 0.0) break;
    for (size_t particle = 0; particle < places.size(); ++particle) places[particle] += ways[particle];
  }
  return best;
}

}  // namespace fitroom
