#pragma once

#include <span>
#include <vector>

#include "fit_client/fit/solver/drape.h"
#include "fit_client/fit/solver/drape_hoops.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {

// Seams that give way. A hoop of the garment (drape_hoops.h) of rest length R that lies on a body with cloth length L
// and a gap g is stretched no further than its fabric allows, s: what is missing of the girth is
//   lack = L + g - R (1 + s),
// the mean over three centimetres of seam to either side. Where it is more than a centimetre over three centimetres of
// seam, the seam is not closed: ties hold its two sides as far apart as makes L = R (1 + s) all round the hoop.

// Returns, one a pair of the mesh's seams, how far its ties have to let the two sides apart: those of `run` already,
// and those that give way at the run's positions (unit: metre). 0: sewn.
std::vector<double> FindOpenings(const DrapeRun& run);

// Returns the girth that the run's hoops lack, where most is missing; negative where all have some to spare (unit:
// metre). Minus infinity without hoops.
double LargestLack(const DrapeRun& run);

// Moves the lengths of ties half of the way towards those that leave every hoop stretched to the fabric's limit; unless
// they may be shortened too, only where a hoop is stretched beyond. Returns the largest way of all (unit: metre).
double AdjustTies(DrapeRun& run, bool may_shorten);

// Says whether every tied seam is as far open as its ties let it, but for a few millimetres.
bool HasOpened(const DrapeRun& run);

// Returns the run's belt with a gap as wide as the tie where the waist's edge is open, its other vertices closer
// together round the same tape. Attachments are those of a closed edge, in order round it.
std::vector<Attachment> WidenBelt(const DrapeRun& run);

// Describes every stretch of open seam of the run's positions, the one that lacks most first.
std::vector<SeamOpening> MeasureOpenings(const DrapeRun& run);

}  // namespace fitroom
