#pragma once

#include <vector>

#include "fit_client/fit/panels/pattern.h"
#include "fit_client/fit/panels/photo_warp.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::fork {

// One side of a panel of trousers, laid as the wearer's left one whichever it is: x outwards, the outline
// counter-clockwise. Names and pixels are its own.
struct HalfPanel {
  OutlineSection waist;    // e1 to waist_centre
  OutlineSection inseam;   // crotch to hem_inner
  OutlineSection leg_hem;  // hem_inner to e2
  OutlineSection outseam;  // e2 to e1
};

// Cuts a panel of trousers in the middle. Sections as in OutlineLayout().
HalfPanel TakeHalf(const PanelPattern& panel, bool left);

// Makes a piece of sections laid as the wearer's left ones, turned over again if it is the right.
PanelPattern PieceOf(const PanelPattern& panel, bool left, std::vector<OutlineSection> sections);

// Returns the x of a chain that runs up or down at a height; beyond its ends that of the end.
double AcrossAt(const panels::Polyline& chain, double height);

// The photograph on a piece that reaches beyond the panel it shows: there the leg's own picture is mirrored at its
// inner edge (the centre line above the crotch, the photographed inseam below) and, where a waist was raised, at that,
// so that no background and no other leg appears.
class ForkTexture {
 public:
  ForkTexture(const PanelPattern& panel, const HalfPanel& half, bool left);

  // Returns the pixel of a point, laid as the wearer's left.
  Eigen::Vector2d PixelAt(const Eigen::Vector2d& point) const;

 private:
  PhotoWarp warp_;
  panels::Polyline waist_, inseam_, outseam_;
  double sign_;
};

}  // namespace fitroom::fork
