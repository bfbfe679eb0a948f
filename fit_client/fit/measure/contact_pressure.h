#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/measure/cloth_strain.h"
#include "fit_client/fit/solver/fabric.h"

namespace fitroom {

// Returns for each particle the lowest particle that it is sewn onto (itself included): seam pairs closer than 2 mm are
// one place of the cloth.
std::vector<int> SewParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions);

// Pressure of the cloth on what lies under it by Laplace's law, P = T_h/r_h + T_v/r_v: the contraction of the sheet's
// tension with its curvature, so that the main directions need not agree. The curvature is that of a quadric fitted to
// the worn cloth within 2.5 cm of the particle. One a particle (unit: Pa); negative where the cloth bulges inwards, and
// then it is not the body that holds it.
std::vector<double> LaplacePressure(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                    std::span<const TriangleStrain> strains, double stretch_stiffness);

// The same pressure by another way: what the body has to push back with, along the cloth's normal, so that the net of
// springs (the solver's, with this fabric's stiffness) and the weight stay in balance, by the particle's area. One a
// particle (unit: Pa).
std::vector<double> ContactForcePressure(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions,
                                         const Fabric& fabric, const Eigen::Vector3d& gravity);

// The bands in which pressure is said (Anthropometry, Apparel Sizing and Design, table 13.5).
enum class PressureBand { kNegligible, kComfortable, kCritical, kMedical, kHarmful };
// Pressure in pascals: below 400, to 1300, to 2000, to 3300, above.
PressureBand PressureBandOf(double pressure);
// "negligible", "comfortable", "critical for casual wear", "as medical or shapewear", "too high to wear".
const char* PressureBandWords(PressureBand band);

}  // namespace fitroom
