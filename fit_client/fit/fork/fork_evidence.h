#pragma once

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/fork/fork.h"

namespace fitroom::fork {

// How far front and back reach beyond the centre line (unit: metre).
struct ForkExtensions {
  double front = 0.0;
  double back = 0.0;
};

// Returns the rule's extensions for a garment's hip girth (unit: metre).
ForkExtensions ExtensionsByRule(ForkRule rule, double garment_hip_girth);

// What a side-folded photograph shows.
struct SideFold {
  double thigh_girth = 0.0;   // Twice the way across from the fork's tip to the outseam (unit: metre).
  double curve_length = 0.0;  // From the waist's middle to the fork's tip, freed of the outline's jitter (unit: metre).
};

// Measures a side-folded photograph by its own scale. `outseam_length` is the pattern's (unit: metre). Fails with
// INVALID_ARGUMENT: POINT_MISSING, SIDE_FOLD_CONTRADICTS_LENGTH (the outseam disagrees by more than 15 %).
Result<SideFold> MeasureSideFold(const GarmentView& view, double outseam_length);

}  // namespace fitroom::fork
