#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// Where a vertex of one mesh lies on another mesh of the same panels, at rest: the corners of a triangle and their
// barycentric weights. Beside the other mesh, whose outline has longer chords, one weight or two are negative.
struct PlaceOnMesh {
  std::array<int, 3> vertices = {};
  std::array<double, 3> weights = {};  // Their sum is 1.
};

// Returns the place of each vertex of `fine` on `coarse`: in the triangle that holds it, or beside the nearest one of
// the same piece. Pieces, the connected parts, correspond by their order: the flat halves of trousers overlap.
// INVALID_ARGUMENT (MESHES_DIFFER) where the meshes do not have the same pieces.
Result<std::vector<PlaceOnMesh>> FindPlaces(const ClothMesh& coarse, const ClothMesh& fine);

// Returns positions at the places, from `positions`, one a vertex of the coarse mesh (unit: metre); nothing where there
// are no positions.
std::vector<Eigen::Vector3d> CarryOver(std::span<const PlaceOnMesh> places, std::span<const Eigen::Vector3d> positions);

}  // namespace fitroom
