#pragma once

#include "fit_client/fit/fork/fork_curves.h"
#include "fit_client/fit/fork/fork_half.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::fork {

// The seams of one piece, laid as the wearer's left.
struct ForkSeams {
  CentreShape centre;
  Inseam inseam;
};

// Cuts one piece: the half panel with the fork's seams instead of its inner edge. Pixels of the new seams as
// ForkTexture shows them.
PanelPattern CutPiece(const PanelPattern& panel, const HalfPanel& half, bool left, const ForkSeams& seams);

}  // namespace fitroom::fork
