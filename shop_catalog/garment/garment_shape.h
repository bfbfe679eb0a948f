#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/flat_curve.h"

namespace fitroom::shop_catalog {

// A garment that lies flat, symmetric about x = 0, densely sampled. Curves that a kind does not have are empty. "On the
// right" means the image's; the left mirrors it.
struct GarmentShape {
  GarmentKind kind = GarmentKind::kTShirt;
  double length = 0.0;       // Neck ends or waist to the hem corners (unit: centimetre).
  FlatCurve outline;         // The silhouette, clockwise on the screen from the upper left; along the back neckline.
  FlatCurve front_neckline;  // From the neck end on the left to the one on the right.
  FlatCurve back_neckline;   // The same way.
  FlatCurve waist;           // Of bottoms: the upper edge from left to right.
  FlatCurve armhole;         // On the right: from the shoulder tip to the underarm.
  FlatCurve sleeve_end;      // On the right: from its top to its bottom.
  FlatCurve side;            // On the right: from the underarm or the waist's corner to the hem corner.
  FlatCurve inseam;          // Of legs, on the right: from the crotch to the inner corner of the hem.
  FlatCurve hem;             // From left to right; of legs: of the right leg, from its inner to its outer corner.
  Eigen::Vector2d sleeve_axis = Eigen::Vector2d::UnitX();  // On the right, outwards.
  // The 22 points of a front view, by name.
  std::vector<std::pair<std::string, Eigen::Vector2d>> points;
};

// Lays out a garment of these flat measures (those of MeasureNames(kind), checked by ValidateDrawnMeasures()).
GarmentShape MakeGarmentShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

// Returns the 22 points in the order of OutlinePointNames(), as the camera sees that side (unit: centimetre).
std::vector<std::pair<std::string, Eigen::Vector2d>> PointsOnShape(const GarmentShape& shape, GarmentSide side);

// The parts of MakeGarmentShape(): shirts and dresses, skirts, trousers and shorts.
GarmentShape MakeTorsoShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures);
GarmentShape MakeSkirtShape(const std::vector<GarmentMeasure>& measures);
GarmentShape MakeTrouserShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

// Trousers with one leg laid over the other, the crotch standing out on the image's left. What is seen is one leg,
// folded at its outseam and inseam, its crotch curve half way between the front's and the back's. The points are those
// of SideFoldedPointNames(); of the curves only `outline`, `waist`, `armhole` (here the crotch curve, from the waist
// down), `side`, `inseam` and `hem` are set.
GarmentShape MakeSideFoldedShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

}  // namespace fitroom::shop_catalog
