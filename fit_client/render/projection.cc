#include "fit_client/render/projection.h"

#include <algorithm>
#include <cmath>

namespace fitroom::render {
namespace {

// A long lens: from 6 m, as in a photographer's studio, near parts of a body are drawn less than 4 % larger.
constexpr double kCameraDistance = 6.0;  // (unit: metre)
constexpr double kMargin = 1.06;         // The picture is this much larger than the subject.
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Returns the camera's bearing: 0 looks at the body's front, 90 degrees at its left.
double Bearing(ViewDirection view) {
  switch (view) {
    case ViewDirection::kFront:
      return 0.0;
    case ViewDirection::kSide:
      return 90.0 * kDegree;
    case ViewDirection::kBack:
      return 180.0 * kDegree;
    case ViewDirection::kThreeQuarter:
      return 38.0 * kDegree;
  }
  return 0.0;
}

}  // namespace

const char* ViewName(ViewDirection view) {
  switch (view) {
    case ViewDirection::kFront:
      return "front";
    case ViewDirection::kSide:
      return "side";
    case ViewDirection::kBack:
      return "back";
    case ViewDirection::kThreeQuarter:
      return "three_quarter";
  }
  return "";
}

Projection ComputeProjection(const Camera& camera) {
  const Eigen::Vector3d middle = camera.subject.center();
  const Eigen::Vector3d size = camera.subject.sizes();
  const double bearing = Bearing(camera.view);
  const Eigen::Vector3d backward(std::sin(bearing), 0.0, std::cos(bearing));  // From the subject to the camera.
  const Eigen::Vector3d right(std::cos(bearing), 0.0, -std::sin(bearing));

  Projection projection;
  Eigen::Matrix4d& eye = projection.eye_from_world;
  eye.block<1, 3>(0, 0) = right.transpose();
  eye.block<1, 3>(1, 0) = Eigen::RowVector3d::UnitY();
  eye.block<1, 3>(2, 0) = backward.transpose();
  eye(0, 3) = -right.dot(middle);
  eye(1, 3) = -middle.y();
  eye(2, 3) = -backward.dot(middle) - kCameraDistance;

  // The subject's near face is nearest to the lens: what fits there fits everywhere.
  const double half_width = 0.5 * std::max(size.x(), size.z());
  const double nearest = kCameraDistance - half_width;
  const double aspect = static_cast<double>(camera.width) / static_cast<double>(camera.height);
  const double tangent_y = kMargin * std::max(0.5 * size.y(), half_width / aspect) / nearest;
  const double near_plane = std::max(0.1, kCameraDistance - 4.0);
  const double far_plane = kCameraDistance + 4.0;
  Eigen::Matrix4d& clip = projection.clip_from_eye;
  clip.setZero();
  clip(0, 0) = 1.0 / (tangent_y * aspect);
  clip(1, 1) = 1.0 / tangent_y;
  clip(2, 2) = -(far_plane + near_plane) / (far_plane - near_plane);
  clip(2, 3) = -2.0 * far_plane * near_plane / (far_plane - near_plane);
  clip(3, 2) = -1.0;
  projection.pixel_size = 2.0 * tangent_y * kCameraDistance / static_cast<double>(camera.height);
  return projection;
}

Eigen::Vector2d ProjectToPixel(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector4d clip = ComputeProjection(camera).clip_from_world() * point.homogeneous();
  return {(clip.x() / clip.w() * 0.5 + 0.5) * camera.width, (0.5 - clip.y() / clip.w() * 0.5) * camera.height};
}

}  // namespace fitroom::render
