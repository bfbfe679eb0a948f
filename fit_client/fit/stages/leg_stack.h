#pragma once

#include <Eigen/Core>

namespace fitroom {

// How a trouser leg lies that is longer than the wearer's: straight down to `top`, and below it pushed together to
// `share` of its length, in folds that stand on the foot.
struct LegStack {
  double top = -1e9;   // Height where the folds begin (unit: metre).
  double share = 1.0;  // Of the cloth's length below, 0.3 to 1; 1: the leg is not too long.
};

// Stacks a leg that starts at height `start` and is `length` long, so that its hem ends at `lowest_hem`; shorter legs
// hang straight (unit: metre). Where a leg is so long that less than 0.3 of its length would be left, the hem ends
// lower. Folds take the lower leg up to the calf: pushed together all along, a leg folds where it has room, at the
// knee.
LegStack StackLeg(double start, double length, double lowest_hem);

// The height of the leg's cloth after `way` metres down from `start`.
double HeightDownLeg(const LegStack& stack, double start, double way);

// Where a fold carries cloth that lies at height `y`, `from_middle` of its leg, horizontally (unit: metre). Diamonds,
// as those of a thin tube that is pushed together: they leave its girth as it is. Without them the cloth would have no
// side to give way to, and stay shortened.
Eigen::Vector2d LegFold(const LegStack& stack, double y, const Eigen::Vector2d& from_middle);

}  // namespace fitroom
