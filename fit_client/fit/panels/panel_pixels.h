#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/outline_samples.h"
#include "fit_client/fit/panels/panel_mesher.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// Returns which pixel of the panel's photograph each point of its mesh shows: the outline's samples their own, points
// inside by PhotoWarp, and where that folds, by UnfoldTexture(). Where even that leaves triangles turned over (a sleeve
// that was photographed lying on the torso), the texture of a mesh of twice the pitch, which is easier to unfold, is
// refined instead, and so on up to 8 cm.
std::vector<Eigen::Vector2d> ComputePanelPixels(const PanelPattern& panel, const OutlineSamples& outline,
                                                const PanelMesh& mesh, double pitch);

}  // namespace fitroom::panels
