#pragma once

#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// Puts a garment of any kind on a body, over what is worn already: tops and one-pieces from the neck down (S40),
// bottoms from below (S41). The layers are part of the collider, made anew, and do not move (S42); their order decides
// how they are worn (CheckLayerOrder). The same result for any executor. `progress` gets 0 to 1 and may be empty.
//
// A garment that does not fit is no failure: the report and the bottom's outcome say how it ended. FAILED_PRECONDITION:
// LAYER_ORDER, LANDMARK_MISSING and others where the scan lacks what the kind needs. INVALID_ARGUMENT where the panels
// are not those of the kind. Else fails like SignedDistanceField::Build() and Drape().
Result<Dressing> DressGarment(const ClothMesh& cloth, GarmentKind kind, const DressedBody& wearer,
                              const DressingOptions& options, Executor& executor,
                              const std::function<void(double done)>& progress);

}  // namespace fitroom
