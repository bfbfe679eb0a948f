#pragma once

#include <vector>

#include "common/garment/garment.h"

namespace fitroom::shop_catalog {

// Measures a garment as it lies flat, between its points and across its outline: what MeasureNames(kind) lists. Widths
// are of the flat garment, half a girth; those of the front, except back_length, which is absent without a back view.
// The chest is measured 2.5 cm below the underarms; sleeves, knees (square to the leg) and leg hems are the mean of
// both sides; the inseam runs along the points from crotch to hem. What folding hides (rises, thigh) is unknown, with
// value 0. (unit: metre)
std::vector<GarmentMeasure> MeasureGarment(GarmentKind kind, const GarmentView& front, const GarmentView* back);

// Returns the width of the outline across the garment's own axis at a pixel (unit: pixel); 0 where it does not cross.
double WidthAt(GarmentKind kind, const GarmentView& view, const Eigen::Vector2d& place);

}  // namespace fitroom::shop_catalog
