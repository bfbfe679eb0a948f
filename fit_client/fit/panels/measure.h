#pragma once

#include <string_view>
#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// Returns the garment's length as the shop measures its photographs to know their scale (unit: metre): from the upper
// corners straight down to the lower ones, mean of left and right. Tops and one-pieces: neck ends P1, P2 to hem
// corners; bottoms: waist ends e1, e3 to the hem's outer corners e2, e4. Both panels share these points.
double MeasureLength(const GarmentPattern& pattern);

// Measures a reconciled pattern as it lies flat: the measures of MeasureNames(pattern.kind), in that order (unit:
// metre). Widths are flat, half a girth, and left and right are averaged:
//   shoulder_width  between the shoulder tips;           neck_width      between the neck's ends P1 and P2;
//   chest_width     2.5 cm below the underarms;          sleeve_length   along the top edge from tip to sleeve end;
//   waist_width,    from side seam to side seam at the   sleeve_opening  between the sleeve end's corners;
//   hip_width       level of these points;               front_length,   of that panel from the highest point of the
//                                                        back_length     shoulders straight down to the hem;
//   hem_width       between the hem's corners, of trousers of one leg;
//   thigh_width     of one leg between outer and inner   inseam          along the seam from crotch to hem;
//                   point;                               length          MeasureLength();
//   knee_width      the same, square to the leg;
//   front_rise,     waist's centre straight down to the crotch.
//   back_rise
// Rises and thigh are of provenance unknown, because folding hides the fork that a chart's measures follow; all others
// are measured. A bottom's waist_width is the distance of the waist's ends.
std::vector<GarmentMeasure> MeasurePattern(const GarmentPattern& pattern);

// Returns the value of the measure of that name, or NaN where it is missing.
double MeasureValue(const std::vector<GarmentMeasure>& measures, std::string_view name);

}  // namespace fitroom
