#pragma once

#include <Eigen/Core>

#include "body_center/scan/implicit_solid.h"

namespace fitroom::body_center {

// Stature of the reference figure that all proportions are given for (unit: metre).
inline constexpr double kReferenceStature = 1.68;

// How a figure departs from the reference figure: a young adult woman of 1.68 m with bust 88, waist 70 and hip 95 cm.
// Factors act on widths and depths of the section at that height and fade into one another between; 1 is the reference.
struct FigureShape {
  double bust = 1.0;
  double waist = 1.0;
  double hip = 1.0;
  double neck = 1.0;
  double limb = 1.0;            // Arms, knees and calves.
  double arm_angle = 0.523599;  // Of the upper arm from the vertical, in the frontal plane (unit: radian).
};

// A figure of the reference stature: canonical frame (Y up, floor at Y = 0, facing +Z, +X its left), metres.
// A figure of another stature is this one scaled as a whole.
struct Figure {
  ImplicitSolid solid;
  // Joints of the left side; the right side mirrors them in X.
  Eigen::Vector3d shoulder = Eigen::Vector3d::Zero();
  Eigen::Vector3d elbow = Eigen::Vector3d::Zero();
  Eigen::Vector3d wrist = Eigen::Vector3d::Zero();
  Eigen::Vector3d hip = Eigen::Vector3d::Zero();
  Eigen::Vector3d knee = Eigen::Vector3d::Zero();
  Eigen::Vector3d ankle = Eigen::Vector3d::Zero();
};

// Returns the height of the breasts' most prominent level: large ones sag a little (unit: metre).
double BustHeight(const FigureShape& shape);

// Builds the figure of that shape.
Figure BuildFigure(const FigureShape& shape);

// The parts of BuildFigure(): each adds its groups to figure.solid and sets its joints.
void AddTorso(const FigureShape& shape, Figure& figure);
void AddHead(const FigureShape& shape, Figure& figure);
void AddLegs(const FigureShape& shape, Figure& figure);
void AddArms(const FigureShape& shape, Figure& figure);

}  // namespace fitroom::body_center
