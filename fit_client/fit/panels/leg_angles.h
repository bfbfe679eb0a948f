#pragma once

#include <vector>

#include "fit_client/fit/panels/view_samples.h"

namespace fitroom::panels {

// Returns the mean drop from the waist's ends to the hems' outer corners over all views: MeasureLength() before the
// legs are turned, which raises or lowers the corners (unit: metre).
double MeanTrouserLength(const std::vector<SectionLayout>& layout, const std::vector<const ViewSamples*>& views);

// Legs are laid at another angle in each photograph, or so close that nothing shows between them. Turns every leg of
// all views about the middle of its upper end (crotch level to crotch), smoothly over its upper third, to the mean
// angle of all of them; wide enough that the legs part by 6 % of the depth below the crotch. Lengths and widths along a
// leg are kept. The views are centred on their seams again.
void TurnLegsAlike(const std::vector<SectionLayout>& layout, const KnotIndices& knots,
                   const std::vector<ViewSamples*>& views);

// Moves what is left of inseams that touch or cross near the crotch apart, to 1 % of the depth below it on each side.
// `sections` are the garment's own, after smoothing.
void PartInseams(const std::vector<SectionLayout>& layout, std::vector<Polyline>& sections);

}  // namespace fitroom::panels
