#pragma once

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// Makes a watertight collider of a scan: joins vertices in the same place, drops degenerate and doubled triangles and
// parts that float beside the body, turns triangles to face one way, drops those that an edge has too many of, and
// fills every hole by clipping its shortest chords first. A surface that is closed already is returned as it is. The
// result is closed and oriented outwards; where fillings meet the skin it may cut itself slightly. INVALID_ARGUMENT for
// no triangles, non-finite coordinates, indices out of range, or nothing left to close.
Result<TriangleMesh> RepairBody(const TriangleMesh& scan);

}  // namespace fitroom
