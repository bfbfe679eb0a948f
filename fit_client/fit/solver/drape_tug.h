#pragma once

#include "common/base/status.h"
#include "fit_client/fit/solver/cloth_model.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {

// Lets a sewn garment whose girth does not close where it hangs find a place where it does, as its wearer helps it to:
// without gravity and nearly without friction, strongly damped, so that what is stretched round the widening hip slides
// up to where it is slack, and what is above lies in folds. Ends when no hoop is within a reserve of the fabric's
// limit, the garment's waist is as high as `DrapeOptions::tug` lets it, nothing rises any more, or at the step limit.
// `model`: as the garment is sewn. Leaves positions and the tug's part of the report in `run`; needs the run's hoops
// and the tug's options. INTERNAL where the state stops being finite.
Status TugUp(DrapeRun& run, const ClothModel& model);

}  // namespace fitroom
