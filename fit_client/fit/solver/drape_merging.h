#pragma once

#include "common/base/status.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {

// Draws seam pairs together without gravity (equation 3) until every pair is closed, progress stops or the step limit
// is reached. Leaves the positions, the pairs that stayed open, and the report's gaps in `run`. Fails like
// ClothModel::Create(), and with INTERNAL where the state stops being finite.
Status MergeSeams(DrapeRun& run);

// Takes the seams as they are, closed or open, without drawing at them: the same of `run` is left.
void TakeSeams(DrapeRun& run);

}  // namespace fitroom
