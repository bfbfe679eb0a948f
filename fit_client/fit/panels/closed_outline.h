#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/garment/garment.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {

// A photograph's closed outline with its arc length, counter-clockwise in the wearer's frame.
struct ClosedOutline {
  Polyline closed;           // The first point repeated at the end.
  std::vector<double> arcs;  // From the first point (unit: pixel).
  double perimeter() const { return arcs.back(); }
};

struct OutlinePosition {
  double arc = 0.0;  // From the outline's first point (unit: pixel).
  double distance = std::numeric_limits<double>::infinity();
};

// Closes a view's outline. The view has at least two different points.
ClosedOutline CloseOutline(const GarmentView& view);

// Returns the place on the outline that is nearest to a point.
OutlinePosition NearestPosition(const ClosedOutline& outline, const Eigen::Vector2d& point);

// Returns the part of the outline between two arcs; `to` may lie beyond the perimeter.
Polyline CutChain(const ClosedOutline& outline, double from, double to);

// Places points on the outline in their order round it, where the nearest place of each would mix them up: across the
// narrow gap between two legs the wrong edge may be the nearer one. Each point goes to one of the places where it is
// locally nearest, at most `tolerance` away, so that the arcs ascend within one lap and the sum of squared distances is
// least (dynamic programming). Returns the arcs, or nothing if no such places exist.
std::optional<std::vector<double>> PlaceInOrder(const ClosedOutline& outline, const Polyline& points, double tolerance);

// Cuts notches out of a chain: slits, vents, and folds that gape. Where two places are near each other but far along
// the chain, they are joined straight. `mouth` is the widest gap that counts and `excess` the least detour (unit: as
// the points). Knots, as arcs along the chain, are carried along.
void BridgeNotches(double mouth, double excess, Polyline& chain, std::vector<double>& knot_arcs);

}  // namespace fitroom::panels
