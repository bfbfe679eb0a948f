#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// Tucks a worn top into the bottom that is put on next, so that this finds the room that it finds on a shopper. `worn`:
// where the top is, one place a particle; `wearer`: body and what lies below the top.
//
// Below the waistband the top is laid close to the body, its hem drawn up above the crotch, and held while the rest
// hangs until it is at rest again. Tucked cloth is gathered, not folded: its layers keep their order but not their
// length. Fails like LowerBody::Cut(), PlaceBottom(), SignedDistanceField::Build() and Drape().
Result<DrapeResult> TuckIn(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& worn, const ClothMesh& bottom,
                           const DressedBody& wearer, const DressingOptions& options, Executor& executor);

}  // namespace fitroom
