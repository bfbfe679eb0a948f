#pragma once

#include <optional>

#include <Eigen/Core>

#include "fit_client/fit/fork/fork_half.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::fork {

// Where a centre seam runs, laid as the wearer's left: straight down from the waist's middle, then a cubic out to the
// fork's tip beyond the centre line.
//
//        W waist           y up, x outwards (to the right here)
//        |
//        S start of the curve
//       /
//  T __/  C crotch on the photograph
struct CentreFrame {
  Eigen::Vector2d waist = Eigen::Vector2d::Zero();   // (unit: metre)
  Eigen::Vector2d crotch = Eigen::Vector2d::Zero();  // (unit: metre)
  double curve_height = 0.0;                         // S above C (unit: metre).
};

struct CentreShape {
  double extension = 0.0;  // C to T across (unit: metre).
  double drop = 0.0;       // T below C (unit: metre).
  double fullness = 0.55;  // Handles of the cubic as a share of its height and extension; a quarter ellipse: 0.55.
  double raise = 0.0;      // Of the waist's middle (unit: metre).
};

// Returns the frame of a half panel: the curve starts 47.5 % of the hip's depth above the crotch, but not above the
// hip, whose photographed width is the whole girth already.
CentreFrame FrameOf(const HalfPanel& half);

// Returns the seam from the waist down to the fork's tip.
panels::Polyline CentreSeam(const CentreFrame& frame, const CentreShape& shape);

// Returns the shape with fullness and raise such that the seam has the length `rise`. Fullness is used first, between
// 0.35 and 0.75; nothing if the waist would have to move by more than 6 cm.
std::optional<CentreShape> ShapeForRise(const CentreFrame& frame, CentreShape shape, double rise);

// How the inseams leave the fork. One value for both pieces.
struct InseamShape {
  double back_drop = 0.0;  // How much lower the back's tip lies (unit: metre); negative: higher.
  double share = 0.0;      // Of the difference between the extensions that is left where the photographed leg begins.
};

// An inseam from the fork's tip to the hem, and where the photographed leg begins in it.
struct Inseam {
  panels::Polyline points;
  double shift = 0.0;   // Inwards at the hem (unit: metre): shorts only.
  double length = 0.0;  // (unit: metre)
};

// Returns the inseam of one piece. `extension` is its own, `mean_extension` that of both; the leg's girth at every
// height is the mean's. `at_hem`: the photographed leg begins at the hem (shorts) instead of the knee.
Inseam InseamFor(const HalfPanel& half, double extension, double mean_extension, double drop, double share,
                 bool at_hem);

// Returns the shape at which front and back inseam have one length, with the least share of 0.4 to 1 for which the
// back's tip lies at most 2 cm lower; nothing if there is none.
std::optional<InseamShape> BalanceInseams(const HalfPanel& half, double front_extension, double back_extension,
                                          bool at_hem);

}  // namespace fitroom::fork
