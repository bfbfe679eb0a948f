#include "fit_client/fit/stages/push_out.h"

#include <algorithm>
#include <cmath>

namespace fitroom {
namespace {

constexpr double kLongestWay = 0.03;   // A place is moved by no more (unit: metre).
constexpr double kLongestStep = 0.01;  // (unit: metre)
constexpr double kLeastGradient = 0.1;

}  // namespace

void PushOut(const SignedDistanceField& field, double clearance, std::vector<Eigen::Vector3d>& places) {
  constexpr int kSteps = 8;
  for (Eigen::Vector3d& place : places) {
    const Eigen::Vector3d before = place;
    for (int step = 0; step < kSteps; ++step) {
      const SignedDistanceField::Sample sample = field.Query(place);
      const double length = sample.gradient.norm();
      if (sample.distance >= clearance || length < kLeastGradient) break;
      place += sample.gradient / length * std::min(clearance - sample.distance + 1e-4, kLongestStep);
    }
    if ((place - before).norm() > kLongestWay) place = before + (place - before).normalized() * kLongestWay;
  }
}

Eigen::Vector3d PlaceAtDistance(const SignedDistanceField& field, Eigen::Vector3d place, double distance) {
  constexpr int kSteps = 16;
  for (int step = 0; step < kSteps; ++step) {
    const SignedDistanceField::Sample sample = field.Query(place);
    const double length = sample.gradient.norm();
    const double way = distance - sample.distance;
    if (std::abs(way) < 1e-4 || length < kLeastGradient) break;
    place += sample.gradient / length * std::clamp(way, -kLongestStep, kLongestStep);
  }
  return place;
}

}  // namespace fitroom
