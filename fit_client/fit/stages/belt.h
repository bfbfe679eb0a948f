#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/stages/bottom_outline.h"
#include "fit_client/fit/stages/lower_body.h"
#include "fit_client/fit/stages/tape_curve.h"

namespace fitroom {

// What the belt found, before it held anything: the waist's size answer.
struct BeltMeasure {
  double height = 0.0;         // The mean height of the waist's edge (unit: metre).
  double garment_girth = 0.0;  // The edge at rest (unit: metre).
  double body_girth = 0.0;     // A tape round the body at that height (unit: metre).

  double ease() const { return garment_girth - body_girth; }
};

// Lays a belt round the body at the mean height of the waist's edge: the tape round the section there, `offset` away
// (unit: metre), the edge's particles on it by arc length from the centre front. A wide edge is gathered evenly, a
// narrow one stretched evenly. FAILED_PRECONDITION (BELT_HAS_NO_BODY) where there is no body at that height.
struct Belt {
  BeltMeasure measure;
  std::vector<Attachment> attachments;  // One a particle of the edge.
};
Result<Belt> LayBelt(const BottomOutline& outline, const LowerBody& body, std::span<const Eigen::Vector3d> positions,
                     double offset);

}  // namespace fitroom
