#pragma once

#include <Eigen/Core>

#include "fit_client/render/scene.h"

namespace fitroom::render {

// The transforms of a camera. OpenGL's conventions: the eye looks along its own -z, x to the right, y up; clip space is
// -1 to 1 with y up. `pixel_size` is that of the picture's plane through the middle of the subject.
struct Projection {
  Eigen::Matrix4d eye_from_world = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d clip_from_eye = Eigen::Matrix4d::Identity();
  double pixel_size = 0.0;  // (unit: metre)

  Eigen::Matrix4d clip_from_world() const { return clip_from_eye * eye_from_world; }
};

// Returns the projection of `camera`. The subject must not be empty and the picture must have an area.
Projection ComputeProjection(const Camera& camera);

// Returns where `point` falls in the camera's picture (unit: pixel, origin top left).
Eigen::Vector2d ProjectToPixel(const Camera& camera, const Eigen::Vector3d& point);

}  // namespace fitroom::render
