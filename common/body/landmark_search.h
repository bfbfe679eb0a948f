#pragma once

#include "common/body/body.h"
#include "common/body/body_slices.h"
#include "common/body/plane_section.h"

namespace fitroom {

// What the searches below share: the indexed mesh and its slices, both in the canonical frame. Refers, does not own.
struct BodyShape {
  const HeightIndex& index;
  const BodySlices& slices;
};

// The left member of a pair of landmarks that stand next to each other in BodyLandmark, or the right one.
inline BodyLandmark OnSide(BodyLandmark left, Side side) {
  return static_cast<BodyLandmark>(static_cast<int>(left) + (side == Side::kRight ? 1 : 0));
}

// Each search fills the landmarks it names; one that cannot be found keeps confidence 0. README.md holds the
// definitions.

// Front neck, C7, side necks, acromions.
void FindNeckAndShoulders(const BodyShape& shape, BodyLandmarks& landmarks);

// Crown, armpits, crotch, bust points, waist, navel, hip sides, buttock; and the girths. Needs acromions.
void FindTrunk(const BodyShape& shape, BodyLandmarks& landmarks, BodyMeasurements& measurements);

// Elbows, wrists, knees, ankles, and the limbs' axes. Needs acromions, armpits and crotch.
struct LimbAxes {
  LimbAxis arm_left, arm_right, leg_left, leg_right;
};
LimbAxes FindLimbs(const BodyShape& shape, BodyLandmarks& landmarks);

}  // namespace fitroom
