#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/neckline.h"
#include "shop_catalog/garment/top_corners.h"

namespace fitroom::shop_catalog {

// Returns the view's outline: the silhouette, with the part between the neck ends replaced by the neckline. Empty if
// the two do not make a simple polygon.
Polygon JoinNeckline(const Polygon& silhouette, const TopCorners& corners, const Neckline& neckline);

// Where the armhole seam meets the shoulder: part of the underarm's distance from the middle.
inline constexpr double kShirtArmhole = 0.9;
inline constexpr double kDressArmhole = 0.79;

// Returns the 22 points of a top in the order of OutlinePointNames(), on an outline made by JoinNeckline(). Corners are
// taken over; the points between them follow from the outline: shoulder tips where it bends over the armhole, waist and
// hip at their usual part of the side, hem centre and neck drop in the middle.
std::vector<OutlinePoint> PlaceTopPoints(const Polygon& outline, const TopCorners& corners, const Neckline& neckline,
                                         GarmentSide side, double armhole_part = kShirtArmhole);

// Returns the corners that a complete set of points implies (the reverse of PlaceTopPoints()).
TopCorners CornersOfPoints(const std::vector<OutlinePoint>& points, GarmentSide side);

// Returns the garment's length in pixels: from the neck ends down the garment's own axis to the hem, mean of both
// sides.
double LengthInPixels(const TopCorners& corners);

}  // namespace fitroom::shop_catalog
