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
// torso at that height). Sleeves are left out: of garments that name their underarm points only the cloth that lies
// between them at rest is cut, and where the plane passes through the armholes the curve is closed by straight lines.
GarmentGirth MeasureDrapedGirth(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions, double height,
                                const Eigen::Vector2d& axis);

}  // namespace fitroom
