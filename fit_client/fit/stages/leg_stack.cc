#include "fit_client/fit/stages/leg_stack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fitroom {
namespace {

constexpr double kStackHeight = 0.30;  // What is too long is folded over this height: from the foot to the calf,
constexpr double kFoldHeight = 0.055;  // in waves of this height (unit: metre).
constexpr double kLeastShare = 0.3;

}  // namespace

LegStack StackLeg(double start, double length, double lowest_hem) {
  const double room = start - lowest_hem;
  if (!(length > room)) return {};
  const double folded = std::min(length - room + kStackHeight, length);
  const double straight = length - folded;
  return {start - straight, std::clamp((room - straight) / folded, kLeastShare, 1.0)};
}

double HeightDownLeg(const LegStack& stack, double start, double way) {
  const double straight = std::min(way, start - stack.top);
  return start - straight - stack.share * (way - straight);
}

Eigen::Vector2d LegFold(const LegStack& stack, double y, const Eigen::Vector2d& from_middle) {
  const double radius = from_middle.norm();
  if (!(y < stack.top) || !(stack.share < 1.0) || !(radius > 0.0)) return Eigen::Vector2d::Zero();
  // A sine of this depth is 1 / share times as long as it is high, to second order.
  const double depth = kFoldHeight / std::numbers::pi * std::sqrt(1.0 / stack.share - 1.0);
  const double turn = std::atan2(from_middle.y(), from_middle.x());
  const double phase = 2.0 * std::numbers::pi * (stack.top - y) / kFoldHeight;
  return depth * std::sin(phase) * std::cos(2.0 * turn) / radius * from_middle;
}

}  // namespace fitroom
