#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// How one triangle of the cloth is stretched in its own plane, from its deformation gradient F against the rest shape:
// the principal stretches are the roots of the eigenvalues of F^T F.
struct TriangleStrain {
  double largest = 0.0;   // Principal strain, stretch - 1 (unit: 1).
  double smallest = 0.0;  // (unit: 1)
  // Of the largest stretch in the flat garment: 0 runs round the body, 90 degrees along it; -90 to 90 (unit: radian).
  double rest_angle = 0.0;
  // Of the largest and the smallest stretch on the worn garment; unit length, zero for a triangle without area.
  Eigen::Vector3d largest_direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d smallest_direction = Eigen::Vector3d::Zero();
  double rest_area = 0.0;  // (unit: m^2)
};

// Returns one strain a triangle. A triangle without area at rest, or with a corner that is not finite, has zeros.
std::vector<TriangleStrain> ComputeStrain(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions);

// Principal tensions of a sheet, force per width (unit: N/m). Never negative: cloth that is pushed together wrinkles.
struct PrincipalTension {
  double largest = 0.0;
  double smallest = 0.0;
};

// Tension of an isotropic elastic sheet of `stretch_stiffness` (Young's modulus times thickness, unit: N/m), Poisson's
// ratio a third as in the solver's net. Where the smaller tension would be compression the sheet is slack that way and
// pulls with its uniaxial stiffness the other way, or not at all: tension field theory (Pipkin, "The relaxed energy
// density for isotropic elastic membranes", 1986).
PrincipalTension ComputeTension(const TriangleStrain& strain, double stretch_stiffness);

}  // namespace fitroom
