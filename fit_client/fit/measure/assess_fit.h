#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/body/body.h"
#include "common/garment/garment.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/measure/zone_fit.h"
#include "fit_client/fit/solver/fabric.h"

namespace fitroom {

// What is to be assessed. Views of what the caller owns, for the call only.
struct AssessInput {
  GarmentKind kind = GarmentKind::kTShirt;
  const Fabric* fabric = nullptr;
  const ClothMesh* cloth = nullptr;
  const std::vector<Eigen::Vector3d>* positions = nullptr;  // As worn, one a particle (unit: metre).
  const Body* body = nullptr;
  // What is worn below it, closed surfaces; the body is all it lies on where there are none.
  std::vector<const TriangleMesh*> layers;
  std::vector<GarmentMeasure> measures;                        // For the provenance of zones.
  Eigen::Vector3d gravity = Eigen::Vector3d(0.0, -9.81, 0.0);  // (unit: m/s^2)
};

// Numbers all over the garment, for maps.
struct FitMaps {
  std::vector<double> strain;    // Largest principal strain, one a triangle (unit: 1).
  std::vector<double> pressure;  // By Laplace; 0 where the cloth does not lie on the body; one a particle (unit: Pa).
  std::vector<double> gap;  // From body and layers to the cloth, one a particle, at most kLargestGap (unit: metre).
                            // Empty where it could not be measured.
};

struct FitAssessment {
  std::vector<ZoneFit> zones;  // In the order of ZonesOf().
  FitMaps maps;
};

// Cloth that lies closer to the body than this touches it: the solver keeps 3 mm, and edge middles come no closer than
// one (unit: metre).
inline constexpr double kContactGap = 0.006;

// Measures how a worn garment fits: girths by the garment's own lines, strain from the deformation gradient, pressure
// by Laplace's law and by the balance of forces. A zone that cannot be measured says why in its note. Positions must be
// one a particle (FR_CHECK); the cost is that of a few passes over the mesh.
FitAssessment AssessFit(const AssessInput& input);

}  // namespace fitroom
