#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/stages/dressing.h"

namespace fitroom {

// A garment as it is worn. Refers to both.
struct WornCloth {
  const ClothMesh& cloth;
  const std::vector<Eigen::Vector3d>& places;  // One a particle (unit: metre).
};

// Says whether a garment yields to what is put on over it: tops and one-pieces are thin and are pressed to the body,
// bottoms stay as they are.
bool YieldsToWhatIsOver(GarmentKind kind);

// Returns where the particles of a worn garment lie once `over` is worn over it: what stands farther out than the cloth
// over it is pressed just under that, and not into the body (`wearer`: without the garment itself); the rest stays.
// Cloth is over a particle where it is near and faces the same way. Fails like SignedDistanceField::Build().
Result<std::vector<Eigen::Vector3d>> PressUnder(const WornCloth& worn, const WornCloth& over, const DressedBody& wearer,
                                                double field_pitch, Executor& executor);

}  // namespace fitroom
