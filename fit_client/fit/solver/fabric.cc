#include "fit_client/fit/solver/fabric.h"

#include <algorithm>

namespace fitroom {
namespace {

// Above this the drape of a tube that is narrower than the hip stacks folds (see JerseyDrapeOptions) and a substep's
// sweep leaves springs unsolved anyway (unit: N/m).
constexpr double kStiffestDrape = 1500.0;

}  // namespace

const std::vector<Fabric>& FabricPresets() {
  static const std::vector<Fabric> kPresets = {
      // name, knit, kg/m^2, stretch N/m, shear N/m, bending N m, largest stretch
      {"jersey", true, 0.18, 200.0, 25.0, 1e-5, 0.30},
      {"woven", false, 0.15, 3000.0, 45.0, 1.5e-5, 0.10},
      {"denim", false, 0.40, 6000.0, 150.0, 5e-5, 0.10},
      {"stretch", true, 0.24, 120.0, 30.0, 1e-5, 0.60},
  };
  return kPresets;
}

const Fabric* FindFabric(std::string_view name) {
  for (const Fabric& fabric : FabricPresets()) {
    if (fabric.name == name) return &fabric;
  }
  return nullptr;
}

ClothMaterial DrapeMaterial(const Fabric& fabric) {
  ClothMaterial material;
  material.areal_density = fabric.areal_density;
  material.stretch_stiffness = std::min(fabric.stretch_stiffness, kStiffestDrape);
  material.bending_stiffness = fabric.bending_stiffness;
  return material;
}

}  // namespace fitroom
