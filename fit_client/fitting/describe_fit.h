#pragma once

// How the outcome of a fit is put into its report. Private to fit_client/fitting.

#include "common/geometry/triangle_mesh.h"
#include "fit_client/fitting/fit_outfit.h"

namespace fitroom {

// Writes down what is fitted on what, and how it was cut.
void DescribeInputs(const BodyInput& body, const Garment& garment, const CutGarment& cut, FitReport& report);

// Writes down how dressing ended: reason, stages, residuals, seams, penetration, strain, warnings.
void DescribeOutcome(const Dressing& dressed, bool is_bottom, const DrapeOptions& options, FitReport& report);

// Writes down how a worn top was tucked in (TuckIn): the state in which it is drawn.
void DescribeTuck(const DrapeReport& tucked, FitReport& report);

// Measures the ease of the worn garment at bust, waist and hip. `body_surface` is the body without holes.
void DescribeEase(const BodyMeasurements& girths, const TriangleMesh& body_surface, FittedGarment& worn);

}  // namespace fitroom
