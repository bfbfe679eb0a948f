#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/stages/bottom_outline.h"

namespace fitroom {

// From the offset that keeps cloth off the body to the belt (unit: metre): what is held must not lie in contact.
inline constexpr double kBeltClearance = 0.001;

// What the belt found, before it held anything: the waist's size answer.
struct BeltMeasure {
  double height = 0.0;         // The mean height of the waist's edge (unit: metre).
  double garment_girth = 0.0;  // The edge at rest (unit: metre).
  double body_girth = 0.0;     // A tape round the body at that height (unit: metre).

  double ease() const { return garment_girth - body_girth; }
};

// Returns the mean height of the waist's edge (unit: metre); `positions` holds one place a particle of the cloth.
double MeanWaistHeight(const BottomOutline& outline, std::span<const Eigen::Vector3d> positions);

// A belt, and what it measured before it held anything.
struct Belt {
  BeltMeasure measure;
  std::vector<Attachment> attachments;  // One a particle of the waist's edge.
};

// Lays a belt round the body's `section` ((x, z), metres) at `height`: the tape round it, `offset` away, the edge's
// particles on it by arc length from the centre front, which lies at x = `middle`. A wide edge is gathered evenly, a
// narrow one stretched evenly. FAILED_PRECONDITION (BELT_HAS_NO_BODY) where the section is empty.
Result<Belt> LayBelt(const BottomOutline& outline, std::span<const Eigen::Vector2d> section, double height,
                     double middle, double offset);

}  // namespace fitroom
