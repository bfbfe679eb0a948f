#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom {

// A garment that is worn already and does not move: a closed solid, its openings filled, so that the space between it
// and the body belongs to it and nothing worn over it can end on its inner side.
struct WornGarment {
  GarmentKind kind = GarmentKind::kTShirt;
  TriangleMesh surface;
};

// Closes a dressed garment (`positions`: one a particle of the cloth, at rest). Fails like RepairBody().
Result<WornGarment> MakeWornGarment(GarmentKind kind, const ClothMesh& cloth,
                                    std::span<const Eigen::Vector3d> positions);

// Says whether a garment of this kind can be put on over the layers, the innermost first. The order decides how they
// are worn: a top after a bottom hangs over it, a top before a bottom is tucked into it. FAILED_PRECONDITION
// (LAYER_ORDER) with a remedy for what nobody can wear.
Status CheckLayerOrder(GarmentKind kind, std::span<const WornGarment> layers);

// Builds the distance to the body, all layers and the floor under the soles together, anew, at `pitch` in `reach`.
// Fails like SignedDistanceField::Build().
Result<SignedDistanceField> BuildDressedField(const TriangleMesh& collider, std::span<const WornGarment> layers,
                                              const Eigen::AlignedBox3d& reach, double pitch, Executor& executor);

}  // namespace fitroom
