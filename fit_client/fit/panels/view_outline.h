#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {

// One photograph's outline, cut at the named points: chains[section][interval] runs from knot to knot of
// OutlineLayout(), in that order, in pixels.
struct ViewOutline {
  GarmentSide side = GarmentSide::kFront;
  int image_width = 0;   // (unit: pixel)
  int image_height = 0;  // (unit: pixel)
  double metre_per_pixel = 0.0;
  std::vector<std::vector<Polyline>> chains;
};

// Cuts a view's outline at its points. Each point is moved onto the outline. A neck drop that lies inside the outline
// (most front photographs show the inside of the back neck above it) gives the neck a half ellipse through it instead.
// `length` is the garment's (unit: metre). Fails with INVALID_ARGUMENT and a reason: BAD_OUTLINE, BAD_SCALE,
// POINT_MISSING, POINT_OFF_OUTLINE, POINTS_OUT_OF_ORDER.
Result<ViewOutline> SplitOutline(const GarmentView& view, GarmentKind kind, double length);

// Returns `count` + 1 points of a chain of pixels from knot to knot, its ends kept: the jitter of the pixels smoothed
// away, and spaced by the arc length of the chain without its crumples, so that a crease does not shift the rest.
// `length_in_pixels` is the garment's.
Polyline SampleChain(const Polyline& chain, int count, double length_in_pixels);

}  // namespace fitroom::panels
