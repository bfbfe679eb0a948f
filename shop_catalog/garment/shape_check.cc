#include "shop_catalog/garment/shape_check.h"

#include <algorithm>
#include <string>

#include "shop_catalog/garment/kind_templates.h"

namespace fitroom::shop_catalog {
namespace {

// Costs of the corner chain, per corner, tuned on the external test photographs.
constexpr double kDoubtfulShape = 2.6;
constexpr double kWrongShape = 3.6;
// Another kind is preferred to the stated one where its cost is less than this part of it, and it is good by itself.
constexpr double kClearlyBetter = 0.6;
constexpr double kGoodEnough = 0.9;  // Below this cost the stated kind is not doubted.

constexpr GarmentKind kKinds[] = {GarmentKind::kTShirt,          GarmentKind::kLongSleeve, GarmentKind::kOnePiece,
                                  GarmentKind::kSleevedOnePiece, GarmentKind::kSkirt,      GarmentKind::kPants,
                                  GarmentKind::kShorts};

// Kinds that pass for each other: the cut decides, not the outline.
bool PassFor(GarmentKind a, GarmentKind b) {
  const auto is_dress = [](GarmentKind kind) {
    return kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece;
  };
  return a == b || (is_dress(a) && is_dress(b)) || (HasLegs(a) && HasLegs(b));
}

struct Likeness {
  GarmentKind kind;
  double cost;
};

Likeness BestOther(const Polygon& outline, GarmentKind stated) {
  Likeness best{stated, 1e9};
  for (const GarmentKind kind : kKinds) {
    if (PassFor(kind, stated)) continue;
    const double cost = KindCost(outline, kind);
    if (cost < best.cost) best = {kind, cost};
  }
  return best;
}

}  // namespace

double ShapeCostOf(const Polygon& outline, GarmentKind kind) {
  const double cost = KindCost(outline, kind);
  return kind == GarmentKind::kOnePiece ? std::min(cost, KindCost(outline, GarmentKind::kSleevedOnePiece)) : cost;
}

GarmentKind ResolveSleeves(const Polygon& outline, GarmentKind kind) {
  if (kind != GarmentKind::kOnePiece) return kind;
  return KindCost(outline, GarmentKind::kSleevedOnePiece) < KindCost(outline, GarmentKind::kOnePiece)
             ? GarmentKind::kSleevedOnePiece
             : GarmentKind::kOnePiece;
}

Status CheckShape(const Silhouette& silhouette, GarmentKind kind, double cost) {
  if (cost < kGoodEnough) return {};
  const Likeness other = BestOther(silhouette.outline, kind);
  const bool is_other = other.cost < kDoubtfulShape && other.cost < kClearlyBetter * cost;
  if (cost < kDoubtfulShape && !is_other) return {};
  const std::string name(GarmentKindName(kind));
  if (silhouette.confidence < kLeastMaskConfidence) {
    return FailedPrecondition("NO_GARMENT_FOUND", "nothing with the shape of a " + name +
                                                      " stands out from the background; photograph it flat on a plain "
                                                      "ground of another colour");
  }
  if (is_other) {
    return FailedPrecondition("WRONG_KIND", "what is photographed does not have the outline of a " + name +
                                                " but looks like " + std::string(GarmentKindName(other.kind)) +
                                                "; state its kind, or give the points as an annotation");
  }
  if (cost < kWrongShape) {
    return FailedPrecondition("LOW_CONFIDENCE", "the outline is only partly that of a " + name +
                                                    "; spread it flat, or give the points as an annotation");
  }
  return FailedPrecondition("WRONG_KIND", "what is photographed does not have the outline of a " + name +
                                              "; state its kind, or give the points as an annotation");
}

}  // namespace fitroom::shop_catalog
