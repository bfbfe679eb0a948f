#pragma once

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/panels/mesh_pattern.h"

namespace fitroom {

// Cuts trousers with their fork into a cloth mesh, as MeshPattern() does the two panels: four pieces that are not
// joined, front left, front right, back left, back right, in the pattern's frame, where the forks of left and right
// overlap. Seams: outseams and inseams (a front, b back), centre front and centre back (a left, b right), sampled one
// to one. panel_of_particle is the photograph that a piece shows, 0 front, 1 back. A named point that both pieces of a
// photograph have (waist_centre, crotch) names the left piece's particle.
// Fails as MeshPattern().
Result<ClothMesh> MeshFork(const ForkedPattern& forked, double pitch, double tight_pitch = kNowhereTight);

}  // namespace fitroom
