#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/garment/garment.h"

namespace fitroom::shop_catalog {

// The measures of a T-shirt that is to be drawn, taken flat (unit: metre).
struct TShirtMeasures {
  double length = 0.68;  // From the neck ends to the hem, 0.45 to 0.95.
  double chest = 0.48;   // Width below the underarms, 0.34 to 0.80.
  double sleeve = 0.21;  // From the shoulder tip to the sleeve's end, 0.10 to 0.32.
};

// Checks the measures: INVALID_ARGUMENT MEASURE_OUT_OF_RANGE naming the command-line option and its range.
Status ValidateTShirtMeasures(const TShirtMeasures& measures);

// A curve on the flat garment (unit: centimetre; origin between the neck ends, x to the image's right, y down).
using FlatCurve = std::vector<Eigen::Vector2d>;

// The pattern of a T-shirt that lies flat, symmetric about x = 0, densely sampled.
struct TShirtShape {
  FlatCurve outline;         // Clockwise on the screen from the neck end on the left; along the back neckline.
  FlatCurve front_neckline;  // From the neck end on the left to the one on the right.
  FlatCurve back_neckline;   // The same way.
  FlatCurve armhole;         // On the right: from the shoulder tip to the underarm. The left mirrors it.
  FlatCurve sleeve_end;      // On the right: from its top to its bottom.
  FlatCurve hem;             // From left to right.
  Eigen::Vector2d sleeve_axis = Eigen::Vector2d::UnitX();  // On the right, outwards.
};

TShirtShape MakeTShirtShape(const TShirtMeasures& measures);

// Returns the 22 points in the order of OutlinePointNames() as the shape defines them, on the flat garment as the
// camera sees that side (unit: centimetre).
std::vector<std::pair<std::string, Eigen::Vector2d>> PointsOnShape(const TShirtShape& shape, GarmentSide side);

}  // namespace fitroom::shop_catalog
