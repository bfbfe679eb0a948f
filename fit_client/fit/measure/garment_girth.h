#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// The curve in which a horizontal plane cuts the draped cloth round the torso.
struct GarmentGirth {
  bool found = false;       // False: the cloth does not go round the axis at this height; the lengths are zero.
  double girth = 0.0;       // Length of the curve, folds and bridges included (unit: metre).
  double hull_girth = 0.0;  // Length of its convex hull: a tape laid over the folds (unit: metre).
  double bridged_length =
      0.0;  // Part of `girth` that is no cloth: straight across armholes and open seams (unit: metre).
};

// Measures the draped garment at `height` (canonical frame, unit: metre) round `axis` (x and z of a point inside the
// torso at that height). Cloth whose sleeve weight is above a half is left out; where the plane passes through the
// armholes or open seams the curve is closed by straight lines. Where it meets a hem or neckline the garment does not
// go round, and nothing is found.
GarmentGirth MeasureDrapedGirth(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions, double height,
                                const Eigen::Vector2d& axis);

}  // namespace fitroom
