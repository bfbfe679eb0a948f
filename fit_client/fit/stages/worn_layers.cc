#include "fit_client/fit/stages/worn_layers.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "fit_client/fit/collision/body_repair.h"

namespace fitroom {
namespace {

std::string Named(GarmentKind kind) { return std::string(GarmentKindName(kind)); }

bool IsOnePiece(GarmentKind kind) { return kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece; }

}  // namespace

Result<WornGarment> MakeWornGarment(GarmentKind kind, const ClothMesh& cloth,
                                    std::span<const Eigen::Vector3d> positions) {
  if (positions.size() != cloth.rest_positions.size()) {
    return InvalidArgument("POSITIONS_SIZE_MISMATCH", "there must be one position a particle of the worn garment");
  }
  TriangleMesh sheet;
  sheet.vertices.assign(positions.begin(), positions.end());
  sheet.triangles = cloth.triangles;
  WornGarment worn;
  worn.kind = kind;
  FR_ASSIGN_OR_RETURN(worn.surface, RepairBody(sheet));
  return worn;
}

Status CheckLayerOrder(GarmentKind kind, std::span<const WornGarment> layers) {
  const auto worn = [&layers](auto&& test) {
    return std::any_of(layers.begin(), layers.end(), [&](const WornGarment& layer) { return test(layer.kind); });
  };
  if (kind == GarmentKind::kSkirt && worn([](GarmentKind k) { return k == GarmentKind::kSkirt; })) {
    return FailedPrecondition("LAYER_ORDER", "a skirt is worn already; take it off or choose another kind");
  }
  if (HasLegs(kind) && worn([](GarmentKind k) { return HasLegs(k); })) {
    return FailedPrecondition("LAYER_ORDER", Named(kind) + " cannot be pulled up over pants or shorts; take those off");
  }
  if (HasLegs(kind) && worn([](GarmentKind k) { return k == GarmentKind::kSkirt || IsOnePiece(k); })) {
    return FailedPrecondition(
        "LAYER_ORDER",
        Named(kind) + " cannot be pulled up over a skirt or a one-piece; put the " + Named(kind) + " on first");
  }
  if (IsOnePiece(kind) && worn([](GarmentKind k) { return IsOnePiece(k); })) {
    return FailedPrecondition("LAYER_ORDER", "a one-piece is worn already; take it off");
  }
  return Status();
}

Result<SignedDistanceField> BuildDressedField(const TriangleMesh& collider, std::span<const WornGarment> layers,
                                              const Eigen::AlignedBox3d& reach, double pitch, Executor& executor) {
  SignedDistanceFieldOptions options;
  options.pitch = pitch;
  options.region = reach;
  FR_ASSIGN_OR_RETURN(SignedDistanceField field, SignedDistanceField::Build(collider, options, executor));
  for (const WornGarment& layer : layers) {
    FR_ASSIGN_OR_RETURN(SignedDistanceField over, SignedDistanceField::Build(layer.surface, options, executor));
    field.Unite(std::move(over));
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& vertex : collider.vertices) lowest = std::min(lowest, vertex.y());
  field.LayFloor(lowest);
  return field;
}

}  // namespace fitroom
