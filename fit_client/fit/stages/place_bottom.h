#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/stages/bottom_outline.h"
#include "fit_client/fit/stages/lower_body.h"

namespace fitroom {

// How a bottom is held to the body before it is sewn.
struct BottomPoseOptions {
  double clearance = 0.006;    // From the body to the cloth (unit: metre).
  double below_groin = 0.012;  // How far below its contact the crotch starts to be pulled up (unit: metre).
  double below_waist = 0.015;  // The same for the waist's edge of a skirt (unit: metre).
  double lowest_hem = 0.06;    // Longer legs start pushed together above this height: the foot (unit: metre).
  double apart = 0.15;         // How far in front and behind the panels start (unit: metre).
  double drop = 0.25;          // How much lower the start's waist lies (unit: metre).
};

// Positions for every particle, body frame, metres. From `apart` over `round_legs` to `around` each particle is carried
// along a way that touches nothing: together along Z, then up.
struct BottomPose {
  std::vector<Eigen::Vector3d> apart;       // Round the legs below the groin, front and back apart.
  std::vector<Eigen::Vector3d> round_legs;  // Together, crotch below the groin.
  std::vector<Eigen::Vector3d> around;      // Almost up: crotch or waist just below its place.
};

// Places a bottom. Each level of the garment becomes a tube: the tape round the body's section there, farther out where
// the garment is wider. Along the tape panels lie as at rest (their part of the level's width); the height follows the
// outseams' length. Near the crotch the trunk's tube goes over into those of the legs along the body's midline.
// INVALID_ARGUMENT for panels that are not a bottom's.
Result<BottomPose> PlaceBottom(const ClothMesh& cloth, const BottomOutline& outline, const LowerBody& body,
                               const BottomPoseOptions& options);

}  // namespace fitroom
