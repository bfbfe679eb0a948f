#pragma once

#include <Eigen/Core>

#include "common/image/image.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// The soft shadow of what stands on the floor, as a grey image to be laid on it (255: darkest).
struct GroundShadow {
  Image darkness;                                     // One channel; x along +X, y along +Z.
  Eigen::Vector2d min_xz = Eigen::Vector2d::Zero();   // World place of the image's corner (unit: metre).
  Eigen::Vector2d size_xz = Eigen::Vector2d::Zero();  // (unit: metre)
  double height = 0.0;                                // Of the floor: the lowest point of the body (unit: metre).
};

// Makes the shadow of a body: dark and sharp under what touches the floor, faint and wide under the rest.
GroundShadow ComputeGroundShadow(const DisplayBody& body);

}  // namespace fitroom::render
