#pragma once

#include <functional>

#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// Puts a bottom on from below (S41): panels round the legs below the groin, merged, stitched (equation 3), pulled up
// under antigravity (7 to 9) until the crotch meets the groin or the waist its height, belted, let go (10), ended by
// condition (11) and rest. The way from below to just under its place is carried, not simulated: a waist is narrower
// than a hip, and no closure can be opened that the photographs do not show.
// Fails like LowerBody::Cut(), FindBottomOutline(), PlaceBottom(), LayBelt(), SignedDistanceField::Build() and Drape().
Result<Dressing> DressBottom(const ClothMesh& cloth, const DressedBody& wearer, const DressingOptions& options,
                             Executor& executor, const std::function<void(double done)>& progress);

}  // namespace fitroom
