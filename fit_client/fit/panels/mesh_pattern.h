#pragma once

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

inline constexpr double kNowhereTight = 1.0;  // Longer than any edge (unit: metre).

// Cuts a pattern into a cloth mesh with edges of about `pitch` (unit: metre, 0.002 to 0.05).
// Round tight places (README.md) edges are halved until they are no longer than `tight_pitch`; nowhere by default.
// Both panels have the same samples on every seam, paired one to one, corners included; corners and, where the pitch
// allows, all other named points carry a particle exactly; a named point that does not names its nearest neighbour on
// the section. Particles are ordered panel by panel in rows upwards, each row from the wearer's right to left, so that
// neighbours lie close in memory. The same pattern and pitch give the same bytes.
// Fails with INVALID_ARGUMENT: PITCH_OUT_OF_RANGE, PITCH_TOO_COARSE (sewn, it would not have its openings), or a reason
// of TriangulatePolygon() where the outline is degenerate.
Result<ClothMesh> MeshPattern(const GarmentPattern& pattern, double pitch, double tight_pitch = kNowhereTight);

}  // namespace fitroom
