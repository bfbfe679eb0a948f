#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/body/body.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// The seams of one sleeve, by panel (0 front, 1 back), each running towards the sleeve's end.
struct SleeveSeams {
  std::array<std::vector<int>, 2> top;    // Over the shoulder and down the arm's outside.
  std::array<std::vector<int>, 2> under;  // From the underarm.
};

// Lays the part of a sleeve that is free of the torso round the arm: each level of it becomes the tape round the arm's
// section there (arm and hand as the axis runs in space, which seen from the front is shorter), farther out where the
// sleeve is wider. Between the underarm and there `places` (one a particle, metres) goes over into the tube.
//
//   underarm ---- goes over ----|---- tube ----| cuff     <- way along the arm
//
// A sleeve that is longer than the arm starts pushed up, its end at the wrist, so that no finger is caught in it.
// side: +1 the wearer's left, -1 right. `dressed` is the body, and what is worn on it, without holes. Leaves the places
// as they are where the sleeve ends above the elbow, nobody knows which particles are a sleeve's, or there is no arm.
void LaySleeveRoundArm(const ClothMesh& cloth, const SleeveSeams& seams, int side, const LimbAxis& arm,
                       const TriangleMesh& dressed, double clearance, std::vector<Eigen::Vector3d>& places);

}  // namespace fitroom
