#pragma once

#include <functional>
#include <span>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// Puts a garment on in its coarsest mesh (DressGarment()), and carries what is worn from mesh to mesh: each finer one
// starts where the one before came to rest, sewn and held by the belt as that one was, and settles there. The garment
// ends where the coarse one ends, with the folds that the fine mesh can have, in a fraction of the time.
// A garment whose seams do not close is put on in the last mesh instead.
// `meshes` are of the same panels, in the order in which they are worn, at least one; the last may also be coarser.
// Stages are those of the coarse mesh, carried over; substeps and seconds of the report are sums over all meshes, the
// rest of it is of the last one. Fails like DressGarment(), FindPlaces() and Settle(). The same result for any
// executor. `progress` may be empty.
Result<Dressing> DressCoarseToFine(std::span<const ClothMesh* const> meshes, GarmentKind kind,
                                   const DressedBody& wearer, const DressingOptions& options, Executor& executor,
                                   const std::function<void(double done)>& progress);

}  // namespace fitroom
