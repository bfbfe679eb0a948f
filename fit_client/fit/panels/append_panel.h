#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/panels/outline_samples.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// Says which pixel shows a point of a panel (metres).
using PixelMap = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

// Appends one panel or piece to the cloth; returns the particle of each of its outline's samples. Without a `pixel_at`
// the pixels are ComputePanelPixels().
Result<std::vector<int>> AppendPanel(const PanelPattern& panel, GarmentKind kind, const OutlineSamples& outline,
                                     const MeshSize& size, const PixelMap& pixel_at, ClothMesh& mesh);

// Sorts the seams' pairs by their particles and drops those that two seams share, as an underarm.
void SortSeams(ClothMesh& mesh);

// Fails with INVALID_ARGUMENT PITCH_TOO_COARSE or PITCH_OUT_OF_RANGE if the sewn mesh would not have the openings of
// its kind, or the pitch is not between 2 and 50 mm.
Status CheckPitch(double pitch);
Status CheckSewn(const ClothMesh& mesh, GarmentKind kind);

}  // namespace fitroom::panels
