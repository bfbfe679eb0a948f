#pragma once

#include "body_center/scan/body_specification.h"
#include "body_center/scan/figure.h"
#include "common/base/status.h"
#include "common/body/body.h"

namespace fitroom::body_center {

// A figure whose girths have been brought to a specification, and the truth about it as constructed.
struct SolvedFigure {
  Figure figure;       // Of the reference stature.
  double scale = 1.0;  // Specified stature by reference stature: metres of the body by metres of the figure.
  FigureShape shape;
  // In the body's canonical frame and metres. Landmarks that the construction does not define have confidence 0.
  BodyLandmarks landmarks;
  BodyMeasurements measurements;
};

// Shapes the reference figure until the tape's girths at bust, waist, hip and neck are those asked for within 1 mm.
// The waist is the smallest girth between bust and hip, the hip the largest between waist and crotch, the bust is
// taken at the level of the breasts, without the arms. INVALID_ARGUMENT as ValidateBodySpecification() returns it, and
// MEASUREMENTS_DO_NOT_GO_TOGETHER where no such figure is found.
Result<SolvedFigure> SolveFigure(const BodySpecification& specification);

// Returns the tape's girth of the section at `height` that surrounds the axis of `solid` (unit: metre).
double TorsoGirth(const ImplicitSolid& solid, double height);

// Returns the first point of the surface on the way from `inside` along `direction`; at most 0.4 m away.
Eigen::Vector3d SurfacePoint(const ImplicitSolid& solid, const Eigen::Vector3d& inside,
                             const Eigen::Vector3d& direction);

// Finds the landmarks of a figure from its construction, in the figure's own size.
BodyLandmarks FindConstructedLandmarks(const Figure& figure, const FigureShape& shape,
                                       const BodyMeasurements& measurements);

}  // namespace fitroom::body_center
