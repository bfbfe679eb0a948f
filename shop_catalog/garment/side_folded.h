#pragma once

#include <optional>
#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/corner_chain.h"

namespace fitroom::shop_catalog {

// Finds the corners of a side-folded bottom on its outline, the crotch on the image's left: waist at the outseam, outer
// and inner hem, crotch, waist at the crotch seam.
std::optional<CornerMatch> FindSideFoldedCorners(const Polygon& outline, GarmentKind kind);

// Enters what a side-folded view shows of the hidden fork into a bottom's measures: the thigh's width at the crotch's
// height, and the rises along the crotch curve. The curve that is seen is the mean of front and back, so that only the
// sum of the rises is measured; it is divided by drafting a front extension of a sixteenth of the hip's girth. `view`
// has its scale.
void MeasureSideFolded(const GarmentView& view, std::vector<GarmentMeasure>& measures);

// Returns the length of a side-folded view in pixels, from the waist to the hem.
double SideFoldedLengthInPixels(const std::vector<OutlinePoint>& points);

}  // namespace fitroom::shop_catalog
