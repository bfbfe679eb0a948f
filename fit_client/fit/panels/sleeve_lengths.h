#pragma once

#include <vector>

#include "fit_client/fit/panels/view_samples.h"

namespace fitroom::panels {

// Gives the averaged sleeves the lengths that the photographs show. Sleeves are laid at a different angle each time,
// and the average of a turned sleeve is shorter than the sleeve. The sleeve's two end corners are moved until the
// chords between shoulder tip, end top, end bottom and underarm have the mean length of both views (and of both sides,
// unless `asymmetric`); the sections in between follow linearly. `shared` holds the averaged sections.
void KeepSleeveLengths(const std::vector<SectionLayout>& layout, const KnotIndices& knots,
                       const std::vector<const ViewSamples*>& views, bool asymmetric, std::vector<Polyline>& shared);

}  // namespace fitroom::panels
