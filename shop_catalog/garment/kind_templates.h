#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/corner_chain.h"

namespace fitroom::shop_catalog {

// Returns the templates of a kind's silhouette, one for each way in which it is laid down. Their corners, clockwise:
//   tops and dresses with sleeves: TopCorner; sleeveless dresses: hem, underarm, shoulder tip, neck end, and back;
//   skirts: waist right, hem right, hem left, waist left;
//   legs: waist right, outer and inner hem right, crotch, inner and outer hem left, waist left.
const std::vector<CornerTemplate>& TemplatesOf(GarmentKind kind);

// Returns the lowest MatchCost() of a kind's templates.
double KindCost(const Polygon& outline, GarmentKind kind);

}  // namespace fitroom::shop_catalog
