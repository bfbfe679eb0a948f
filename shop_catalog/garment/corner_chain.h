#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/garment/polygon.h"

// Finding the corners of a garment's silhouette by a template of its kind: a chain of corners, clockwise on the screen,
// symmetric about a middle line. Which corner is which is decided for all together, as the chain of least cost over the
// outline (dynamic programming); where each lies is decided locally, at the sharpest turn near by.
namespace fitroom::shop_catalog {

// A value that is expected, and how far off it costs one unit. Costs grow with the square up to a cap, so that one torn
// or folded corner does not drag the others along.
struct Expected {
  double mean;
  double deviation;
  double Cost(double value, double cap = 9.0) const {
    const double d = (value - mean) / deviation;
    return std::min(cap, d * d);
  }
};

// What a corner on the image's left looks like; the right one is its mirror image. Lengths are parts of the garment's
// height, `across` from the middle line, `down` from the highest point.
struct CornerModel {
  Expected turn_deg;  // Positive at a convex corner.
  Expected across;
  Expected down;
  double snap_window = 0.025;  // Where the sharpest turn is looked for, and over what length it is seen, parts of the
  double snap_arm = 0.035;     // height.
  double sharp_deg = 60.0;     // A turn that is certain.
};

// What the outline does from one corner to the next, on the image's left.
struct PieceModel {
  Expected direction_deg;  // 0 right, 90 down.
  Expected length;         // Of the chord, as part of the garment's height.
  Expected winding;        // Arc length over chord; less than expected costs nothing.
};

struct CornerTemplate {
  std::string name;  // Of the pose, for logs.
  std::vector<CornerModel> corners;
  std::vector<PieceModel> pieces;           // One less than corners.
  bool starts_at_top = false;               // The chain begins after the top of the middle line, else after its bottom.
  Expected closing_winding = {1.06, 0.10};  // Arc length over chord from the last corner to the first.
};

// Makes the whole chain from the left half, in the order in which the outline passes it from the bottom up;
// `across_middle` joins it to its mirror image at the top.
CornerTemplate FromBottom(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces,
                          const PieceModel& across_middle);
// The same for a chain that begins at the top and whose first corner on the left, at the bottom, lies on the middle
// line.
CornerTemplate FromTop(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces);
// The same without a corner in the middle; `across_middle` runs from the right half to the left one.
CornerTemplate FromTop(std::string name, const std::vector<CornerModel>& left, const std::vector<PieceModel>& pieces,
                       const PieceModel& across_middle);

struct CornerMatch {
  std::vector<Eigen::Vector2d> pixel;  // In the template's order.
  std::vector<double> confidence;      // 0 to 1.
  double tilt = 0.0;                   // Under which the chain is cheapest, positive clockwise (unit: radian).
  double height = 0.0;                 // Of the silhouette along that axis (unit: pixel).
  double cost = 0.0;                   // Per corner.
};

// Finds the corners on an outline (clockwise, upright within 40 degrees). Nothing if the outline is too short or there
// is no such chain.
std::optional<CornerMatch> MatchCorners(const Polygon& outline, const CornerTemplate& corner_template);

// Returns the cost of the best chain alone, per corner, from a coarser search. Infinite if there is none.
double MatchCost(const Polygon& outline, const CornerTemplate& corner_template);

// Returns the height of an outline along an axis of that tilt (unit: pixel).
double HeightAlong(const Polygon& outline, double tilt);

}  // namespace fitroom::shop_catalog
