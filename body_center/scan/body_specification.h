#pragma once

#include <cstdint>
#include <optional>

#include "common/base/status.h"

namespace fitroom::body_center {

// The measurements that a body is made from. Lengths in metres; girths are those of a tape: the perimeter of the
// section's convex hull.
struct BodySpecification {
  double stature = 1.68;        // 1.40 to 1.95 (unit: metre).
  double bust = 0.88;           // 0.70 to 1.40 (unit: metre).
  double waist = 0.70;          // 0.50 to 1.30 (unit: metre).
  double hip = 0.95;            // 0.75 to 1.50 (unit: metre).
  std::optional<double> neck;   // 0.26 to 0.48 (unit: metre); absent: as goes with stature and bust.
  double arm_angle = 0.523599;  // Of the upper arms from the vertical, 15 to 60 degrees (unit: radian).
};

// Returns the neck girth that the specification asks for or implies (unit: metre).
double NeckGirth(const BodySpecification& specification);

// Checks every measurement and their proportions. INVALID_ARGUMENT with MEASUREMENT_OUT_OF_RANGE naming the
// command-line option and its range, or MEASUREMENTS_DO_NOT_GO_TOGETHER.
Status ValidateBodySpecification(const BodySpecification& specification);

}  // namespace fitroom::body_center
