#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/corner_chain.h"
#include "shop_catalog/garment/neckline.h"
#include "shop_catalog/garment/top_corners.h"

namespace fitroom::shop_catalog {

// Returns the 22 points of a bottom in the order of OutlinePointNames(), on its outline. Corners are taken over; the
// others follow: a skirt's hip lies 20 cm below its waist, a trouser's at two thirds of the way to the crotch, thigh
// and knee at a quarter and half of the way from crotch to hem. `length` is the stated one (unit: metre).
std::vector<OutlinePoint> PlaceBottomPoints(GarmentKind kind, const Polygon& outline, const CornerMatch& match,
                                            GarmentSide side, double length);

// Returns the 22 points of a dress with or without sleeves, on an outline made by JoinNeckline(). The waist is where
// the dress is narrowest between 10 and 24 cm below the underarms, 16.5 cm where it does not narrow; the hip 20 cm
// below.
std::vector<OutlinePoint> PlaceDressPoints(GarmentKind kind, const Polygon& outline, const TopCorners& corners,
                                           const Neckline& neckline, GarmentSide side, double length);

// Returns the seven points of a side-folded photograph. Its corners are those of a polygon: see SideFoldedPointNames().
std::vector<OutlinePoint> PlaceSideFoldedPoints(const Polygon& outline, const CornerMatch& match);

}  // namespace fitroom::shop_catalog
