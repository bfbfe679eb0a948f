#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// What is given at one particle.
struct GivenValue {
  int particle = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

// Extends values given at some particles of a panel (0 front, 1 back) over the whole of it: the solution of Laplace's
// equation on the panel's edges, free at openings. Returns one value a particle of the cloth; zero on the other panel.
// INVALID_ARGUMENT (PANEL_LOOSE) where a part of the panel has no given value.
Result<std::vector<Eigen::Vector3d>> ExtendHarmonically(const ClothMesh& cloth, int panel,
                                                        std::span<const GivenValue> given);

}  // namespace fitroom
