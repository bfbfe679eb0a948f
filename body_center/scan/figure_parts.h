#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "body_center/scan/implicit_solid.h"

namespace fitroom::body_center {

// What the figure's proportions are written in (unit: metre).
inline constexpr double kCm = 0.01;

// Returns a point given in centimetres in metres.
inline Eigen::Vector3d PointCm(double x, double y, double z) { return kCm * Eigen::Vector3d(x, y, z); }

// Returns the point mirrored to the figure's other side where `side` is -1.
inline Eigen::Vector3d OnSide(double side, const Eigen::Vector3d& left) {
  return {side * left.x(), left.y(), left.z()};
}

// One row of a table of horizontal sections (unit: centimetre).
struct HorizontalRow {
  double y = 0.0;
  double x_centre = 0.0;
  double half_width = 0.0;
  double z_centre = 0.0;  // Where the section is widest.
  double z_front = 0.0;
  double z_back = 0.0;
  double front_exponent = 2.0;
  double back_exponent = 2.0;
};

// Returns the row as a section of a vertical sweep (frame: VerticalSweepFrame), its widths and depths times `factor`
// and its distance from the middle plane times `spread`. `side` is -1 for the figure's right.
SweptSection SectionFromRow(const HorizontalRow& row, double factor, double spread = 1.0, double side = 1.0);

// Returns the frame of a vertical sweep: u = x, v = z (the front), axis = y. It is left-handed on purpose: a section's
// front must be the body's front on either side.
Eigen::Isometry3d VerticalSweepFrame();

// Returns the value at `place` of the line through (place, value) pairs, blended smoothly from pair to pair.
double SmoothProfile(const std::vector<Eigen::Vector2d>& pairs, double place);

}  // namespace fitroom::body_center
