#pragma once

#include <map>
#include <string>

#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// Measures by the names of size charts (MeasureNames()), flat (unit: metre).
using MeasureMap = std::map<std::string, double>;

// Returns what a size chart calls by these names, as the pattern has it; left and right are averaged:
//   widths between the pairs of points; shoulder_width between the shoulder tips, neck_width between P1 and P2;
//   sleeve_length along the top edge from the tip to the sleeve's end, sleeve_opening across its end;
//   front_length, back_length from the highest point of the shoulder straight down to the panel's hem;
//   length of a bottom from the waist corners down to the outer hem corners, upright; inseam along the seam;
//   front_rise, back_rise from the waist's centre straight to the crotch, thigh_width from the crotch to the outseam:
//   what the photographs show. A garment laid flat hides the fork, so that these three are less than a shop measures.
MeasureMap MeasureByName(const GarmentPattern& pattern);

}  // namespace fitroom::panels
