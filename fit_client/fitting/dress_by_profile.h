#pragma once

// How a garment is put on, after the profile. Private to fit_client/fitting.

#include <functional>

#include "fit_client/fitting/fit_outfit.h"

namespace fitroom {

// Puts the garment on with the profile of `options`. `standard` is DressCoarseToFine(). `paper` runs the method as
// printed from the same start and knows no layers: FAILED_PRECONDITION (PAPER_HAS_NO_LAYERS).
Result<Dressing> DressByProfile(const CutGarment& cut, const DressedBody& wearer, const FitOptions& options,
                                const DressingOptions& dressing, Executor& executor,
                                const std::function<void(double done)>& progress);

}  // namespace fitroom
