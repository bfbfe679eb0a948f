#pragma once

#include "common/garment/garment.h"

namespace fitroom::testing {

// A T-shirt of 68 cm drawn by hand in straight lines, front and back, 800 x 800 pixels at 1 mm a pixel: every point on
// its outline, everything valid. The view is symmetric about x = 400; the back's neckline is shallower.
Garment MakeSampleTShirt();

// Trousers of 100 cm drawn in the same way, front, back and side-folded, 800 x 1200 pixels; the fork's measures are
// stated by tape, and a chart of three sizes (S, M, L; M is the photographed one) goes with them.
Garment MakeSampleTrousers();

}  // namespace fitroom::testing
