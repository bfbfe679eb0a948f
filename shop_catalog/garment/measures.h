#pragma once

#include <vector>

#include "common/garment/garment.h"

namespace fitroom::shop_catalog {

// Measures a top as it lies flat, between its points and across its outline: shoulder_width, chest_width (2.5 cm below
// the underarms), waist_width, hip_width, hem_width, sleeve_length (mean of both), sleeve_opening (mean of both),
// neck_width, and front_length and back_length (neck ends to hem). Widths are of the flat garment, half a girth. Those
// of the front, except back_length. (unit: metre)
std::vector<GarmentMeasure> MeasureTop(const GarmentView& front, const GarmentView* back);

// Returns the width of the outline across the garment's own axis at a pixel (unit: pixel); 0 where it does not cross.
double WidthAt(const GarmentView& view, const Eigen::Vector2d& place);

}  // namespace fitroom::shop_catalog
