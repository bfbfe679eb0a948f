#pragma once

#include <string_view>
#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// Returns the garment's length (unit: metre), mean of front and back. Tops and one-pieces: from the highest point of
// the shoulder straight down to the hem. Bottoms: from the waist's centre straight down to the level of the hem's
// middle, of trousers the mean level of both legs' hem_mid. A shop measures a photograph the same way.
double MeasureLength(const GarmentPattern& pattern);

// Returns the same of one panel.
double MeasureLength(const PanelPattern& panel, GarmentKind kind);

// Measures a reconciled pattern as it lies flat: the measures of MeasureNames(pattern.kind), in that order (unit:
// metre). Widths are flat, half a girth, and left and right are averaged:
//   shoulder_width  between the shoulder tips;           neck_width      between the neck's ends P1 and P2;
//   chest_width     2.5 cm below the underarms;          sleeve_length   along the top edge from tip to sleeve end;
//   waist_width,    from side seam to side seam at the   sleeve_opening  between the sleeve end's corners;
//   hip_width       level of these points;               front_length,   length of that panel;
//                                                        back_length
//   hem_width       between the hem's corners, of trousers of one leg;
//   thigh_width,    of one leg between outer and inner   inseam          along the seam from crotch to hem;
//   knee_width      point;                               length          MeasureLength();
//   front_rise,     waist's centre straight down to the crotch. Of provenance unknown: folding hides the curve that
//   back_rise       a chart's rise follows.
// All others are of provenance measured. A bottom's waist_width is the distance of the waist's ends.
std::vector<GarmentMeasure> MeasurePattern(const GarmentPattern& pattern);

// Returns the value of the measure of that name, or NaN where it is missing.
double MeasureValue(const std::vector<GarmentMeasure>& measures, std::string_view name);

}  // namespace fitroom
