#pragma once

#include <Eigen/Core>

#include "common/garment/garment.h"

namespace fitroom::testing {

// A T-shirt drawn from formulas, so that every measure is known. All in metres, y up, origin at Cp, wearer's left half.
struct DrawnTShirt {
  double length = 0.68;
  double half_neck = 0.09;
  double front_drop = 0.09;
  double back_drop = 0.02;
  Eigen::Vector2d shoulder_tip{0.215, -0.05};
  Eigen::Vector2d sleeve_top{0.37, -0.17};
  Eigen::Vector2d sleeve_bottom{0.30, -0.28};
  Eigen::Vector2d underarm{0.25, -0.235};
  double half_waist = 0.24;  // At 0.40 below Cp; the side seam is a smooth curve through it.
  double half_hem = 0.255;
  double hem_sag = 0.0;             // How much lower the hem's middle lies than its corners.
  double right_sleeve_share = 1.0;  // The wearer's right sleeve's length as a share of the left one's.
};

// How a view is photographed.
struct DrawnView {
  double tilt_deg = 0.0;           // Clockwise on the screen.
  double pixels_per_metre = 1000;  // True scale of the picture.
  double sway = 0.0;               // How far the shirt is bent sideways, the same way on both sides (unit: metre).
  double crumple = 0.0;            // Amplitude of short waves across the outline (unit: metre).
  double sleeve_turn_deg = 0.0;    // The wearer's left sleeve is laid lower by this, the right one higher.
};

// Draws one side. The outline is sampled about every 1.5 pixels; the points lie on it.
GarmentView DrawView(const DrawnTShirt& shirt, GarmentSide side, const DrawnView& view);

// Draws a whole garment.
Garment DrawGarment(const DrawnTShirt& shirt, const DrawnView& front, const DrawnView& back);

}  // namespace fitroom::testing
