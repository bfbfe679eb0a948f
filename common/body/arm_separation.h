#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/body/plane_section.h"

namespace fitroom {

// An outline of trunk and arm together, cut in two where it is narrowest. The cut runs from the fold in front of the
// arm to the fold behind it.
struct ArmSeparation {
  SectionLoop trunk;
  SectionLoop arm;
  Eigen::Vector2d cut_middle = Eigen::Vector2d::Zero();
  // Length of the cut by the root of the arm's area: 0 where trunk and arm just touch, above 1 where the arm is part of
  // the shoulder. (A circle cut off at its diameter has 1.6, half of an ellipse of a trunk's shape 1.3.)
  double neck_ratio = 0.0;
};

struct ArmSeparationOptions {
  double sign = 1.0;             // +1: the arm on the side of +X; -1: the other.
  double max_neck_ratio = 1.0;   // Wider necks are no contact between an arm and a trunk.
  double min_arm_area = 1.5e-3;  // (unit: square metre)
  double max_arm_area = 2.0e-2;  // (unit: square metre)
};

// Finds the arm that lies against the trunk in one outline. Nothing where the outline has no such neck.
std::optional<ArmSeparation> SeparateArm(const SectionLoop& joined, const ArmSeparationOptions& options);

}  // namespace fitroom
