#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/panel_mesher.h"

namespace fitroom::panels {

// Turns over again what the warp folded, as creases of the photograph's outline at the underarm make it fold.
// `pixels` holds a pixel for each point of the mesh, the first `outline_count` of them fixed. Round every triangle
// whose image is turned over or squeezed to a tenth, each point inside is moved to where the worst of its triangles is
// best; after Freitag and Plassmann, "Local optimization-based simplicial mesh untangling and improvement" (2000).
// Elsewhere nothing is changed. Returns the number of triangles that are still turned over: 0 unless the outline itself
// folds.
int UnfoldTexture(const PanelMesh& mesh, int outline_count, std::vector<Eigen::Vector2d>& pixels);

}  // namespace fitroom::panels
