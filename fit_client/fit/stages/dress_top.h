#pragma once

#include <functional>

#include "common/garment/garment.h"
#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// Puts a top or a one-piece on from the neck down (S40): places the panels apart with Cp before the front neck point,
// carries them onto the body along Z, sews them (equation 3), lets gravity act (equation 5) and ends by the finishing
// condition (6), every shoulder-sleeve point that rests on the shoulder lies on it, and the rest criterion. Fails like
// PlaceTop(), SignedDistanceField::Build() and Drape().
Result<Dressing> DressTop(const ClothMesh& cloth, GarmentKind kind, const DressedBody& wearer,
                          const DressingOptions& options, Executor& executor,
                          const std::function<void(double done)>& progress);

}  // namespace fitroom
