#pragma once

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/garment/polygon.h"
#include "shop_catalog/garment/silhouette.h"

namespace fitroom::shop_catalog {

// Returns how little an outline looks like a kind: the lowest cost of its templates per corner. A one_piece may have
// sleeves or not.
double ShapeCostOf(const Polygon& outline, GarmentKind kind);

// Says whether a one_piece has sleeves; other kinds are returned as they are.
GarmentKind ResolveSleeves(const Polygon& outline, GarmentKind kind);

// Checks that a silhouette is that of a kind. `cost` is that of the corners found. FAILED_PRECONDITION WRONG_KIND,
// where known with what it looks like; LOW_CONFIDENCE, NO_GARMENT_FOUND.
Status CheckShape(const Silhouette& silhouette, GarmentKind kind, double cost);

}  // namespace fitroom::shop_catalog
