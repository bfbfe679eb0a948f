#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/garment/garment.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// How a top is held up to the body before it is sewn.
struct StartPoseOptions {
  double clearance =
      0.006;  // From the body to the cloth; a wider tube shrinks onto the hip and climbs it (unit: metre).
  // The side seams start shorter than they are by this factor, because the panels' middles take the longer way over
  // bust, belly and seat: cloth that starts short falls into place, cloth that starts long is held by friction at the
  // hip and pulls at the neck.
  double side_scale = 0.95;
  double apart = 0.15;       // How far in front and behind the panels start (unit: metre).
  double map_pitch = 0.004;  // Of the frontal map of the body (unit: metre).
};

// Two positions for every particle, body frame, metres. From `apart` to `around` each particle moves along Z only, so
// that the panels close on the body from the front and from behind without being dragged across it.
struct StartPose {
  std::vector<Eigen::Vector3d> apart;   // In front of the body and behind it.
  std::vector<Eigen::Vector3d> around;  // Shaped round the torso and the arms, seams nearly meeting.
};

// Places a top or a one-piece: its neck's midpoint Cp over the body's front neck point, shoulder seams over the
// shoulders' ridges, underarms between arm and torso, sleeves, where it has any, round the arms, side seams beside the
// torso. `collider` is the body without holes, `body` its landmarks and arm axes.
//
// The outline is placed first; between its seams the panel follows by a harmonic displacement (the smoothest one, so
// that the rest shape is kept where nothing forces it), and its depth is the body's own, or a half ellipse as wide as
// the cloth, whichever is farther out.
//
// INVALID_ARGUMENT for a panel without the points of a top and for a body of more than 10 m, FAILED_PRECONDITION where
// the scan lacks a landmark.
Result<StartPose> PlaceTop(const ClothMesh& cloth, GarmentKind kind, const Body& body, const TriangleMesh& collider,
                           const StartPoseOptions& options);

}  // namespace fitroom
