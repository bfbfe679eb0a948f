#pragma once

#include <cstdint>

#include "common/body/body.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom::body_center {

// Makes a clean mesh look like what a laser scanner delivers: 0.3 mm of noise, holes where no laser reaches (armpits,
// crotch, crown, soles), small dropouts, and two floating islands. `landmarks` and `mesh` are of one body (canonical
// frame, metres). The same seed gives the same scan. Unused vertices are dropped.
TriangleMesh AddScanDefects(const TriangleMesh& mesh, const BodyLandmarks& landmarks, uint64_t seed);

}  // namespace fitroom::body_center
