#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// Seam partners closer than this are one point of the surface (unit: metre).
inline constexpr double kWeldedGap = 3e-3;

// Checks that the parts of a garment fit each other: counts, indices, finite numbers.
// INVALID_ARGUMENT [BAD_GARMENT_SHAPE] names what does not.
Status CheckGarmentShape(const GarmentShape& garment);

// Returns one unit normal a particle. Particles that are sewn onto each other share one, so that a closed seam is
// drawn as smooth as the cloth beside it.
std::vector<Eigen::Vector3d> ComputeGarmentNormals(const ClothMesh& cloth,
                                                   const std::vector<Eigen::Vector3d>& positions);

// Returns for each particle the smallest index among the particles it is welded to, itself included.
std::vector<int> WeldParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions);

// Returns the colour most of a panel's cloth has: the median of the texture at the panel's particles, each channel on
// its own. A print does not move it. Grey where there is no texture or no particle.
Colour ComputePanelColour(const ClothMesh& cloth, int panel, const Image* texture);

}  // namespace fitroom::render
