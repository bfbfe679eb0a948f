#pragma once

#include "common/base/status.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {

// Welds the closed seams and lets the garment come to rest on the body: first it relaxes without gravity, then gravity
// acts (equations 5 and 10) until rest or the step limit. Leaves the positions, the outcome and what was measured in
// `run`. Fails like ClothModel::Create(), and with INTERNAL where the state stops being finite.
Status HangGarment(DrapeRun& run);

// The same for a garment that is worn already: no relaxing, no pulling up; what is attached is held where it is, and
// the cloth settles in short steps from the start.
Status SettleGarment(DrapeRun& run);

}  // namespace fitroom
