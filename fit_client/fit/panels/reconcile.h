#pragma once

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// Makes one garment of a front and a back photograph that were taken apart: tilted, scaled and crumpled differently,
// and never symmetric. Each view is stood upright by its own points, mirrored into the wearer's frame and scaled; legs
// are turned to their mean angle; seams get one shape and one length from both views and both sides; necks, waists and
// armholes stay each view's own, and hems where they differ by more than 3 cm; all become smooth curves; the whole is
// scaled to the garment's length (MeasureLength(); of trousers, whose legs were turned, that of the photographs).
// Without a back photograph the front's serves for both, mirrored so that it reads from behind, with a shallow neck or
// waist. Fails with INVALID_ARGUMENT: BAD_OUTLINE, BAD_SCALE, POINT_MISSING, POINT_OFF_OUTLINE, POINTS_OUT_OF_ORDER,
// SCALE_CONTRADICTS_LENGTH (a view's scale and the length differ by more than 15 %), OPENING_TOO_NARROW (a neck, waist,
// sleeve, armhole or hem of less than 4 cm), OUTLINE_NOT_A_GARMENT (the reconciled outline crosses itself).
Result<GarmentPattern> ReconcileViews(const Garment& garment);

}  // namespace fitroom
