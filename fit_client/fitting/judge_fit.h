#pragma once

// How a fit is judged. Private to fit_client/fitting.

#include <span>

#include "common/body/body.h"
#include "fit_client/fit/measure/assess_fit.h"
#include "fit_client/fitting/fit_outfit.h"

namespace fitroom {

// Returns the preset that the garment names, or jersey where nobody knows the name.
const Fabric& FabricOf(const Garment& garment);

// Measures how the worn garment fits zone by zone and judges its size; the zones, the verdict and the maps go into
// `fitted`. `layers` is what is worn below it, `facts` what dressing found out.
void JudgeWorn(const Body& body, std::span<const WornGarment> layers, const DressingFacts& facts,
               FittedGarment& fitted);

// Judges every size of the garment's chart by its flat measures, the worn one by how it was worn, and says which to
// take. Nothing for a garment without a chart.
void JudgeChart(const Body& body, FittedGarment& fitted);

}  // namespace fitroom
