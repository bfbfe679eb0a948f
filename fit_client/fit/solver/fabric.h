#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom {

// What a garment is made of: the figures of one cloth out of its class. README.md of this folder says where each comes
// from and how far cloths of one name differ. Immutable values.
struct Fabric {
  std::string name;            // "jersey", "woven", "denim", "stretch".
  bool is_knit = false;        // Judged by the stretch that it declares; a woven by the bands of wovens.
  double areal_density = 0.0;  // (unit: kg/m^2)
  // Force per width and strain at wearing loads of some 50 to 100 N/m, the mean of length and width (unit: N/m).
  double stretch_stiffness = 0.0;
  double shear_stiffness = 0.0;    // Force per width and shear angle (unit: N/m per radian).
  double bending_stiffness = 0.0;  // Moment per width and curvature (unit: N m).
  // By how much it can be stretched in wear: of a knit what its maker declares, of a woven where it cannot be worn
  // (unit: 1).
  double largest_stretch = 0.0;

  // Strain above which a wearer calls the garment tight, and above which it cannot be worn (unit: 1). A knit with a
  // declared stretch s is tight from s/2 and ends at s; a woven is tight from 5 % and ends at 10 %.
  double tight_strain() const { return 0.5 * largest_stretch; }
  double limit_strain() const { return largest_stretch; }
};

// Returns the presets by name: jersey, woven, denim, stretch.
const std::vector<Fabric>& FabricPresets();

// Returns the preset of that name, or nullptr.
const Fabric* FindFabric(std::string_view name);

// Returns the fabric as the drape knows it. Softer than the fabric where the fabric is stiffer than what the drape is
// tuned on: a garment's shape is decided by its cut long before its threads stretch (README.md).
ClothMaterial DrapeMaterial(const Fabric& fabric);

}  // namespace fitroom
