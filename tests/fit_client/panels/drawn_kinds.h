#pragma once

#include <Eigen/Core>

#include "common/garment/garment.h"
#include "tests/fit_client/panels/drawn_tshirt.h"

namespace fitroom::testing {

// Garments of the other kinds drawn from formulas, so that every measure is known. All in metres, y up, wearer's left
// half; origin in the middle between the waist's ends (bottoms) or the neck's (one-pieces).

// Sides: a parabola from waist to hip, then straight to the hem.
struct DrawnSkirt {
  double length = 0.60;  // From the waist's ends to the hem's corners.
  double half_waist = 0.18;
  double half_hip = 0.24;  // 0.20 below the waist's ends.
  double half_hem = 0.30;
  double front_dip = 0.02;  // How much lower the waist's centre lies than its ends.
  double back_dip = 0.0;
  double slit_depth = 0.0;       // Of a slit in the middle of the hem that gapes by 1 cm; its end is the hem's centre.
  double hem_sag = 0.0;          // How much lower the hem's centre lies than its corners.
  double right_hem_lift = 0.0;   // How much higher the wearer's right hem corner lies: the hem runs slanting.
  double right_hip_share = 1.0;  // The wearer's right half's hip and hem as a share of the left one's.
};

struct DrawnTrousers {
  double length = 1.00;  // From the waist's ends to the hems.
  double half_waist = 0.19;
  double half_hip = 0.25;  // 0.18 below the waist's ends.
  double crotch = 0.27;    // Depth of the crotch below the waist's ends.
  double inner_hem = 0.09;
  double outer_hem = 0.25;
  double front_dip = 0.03;
  double back_dip = -0.01;
};

struct DrawnDress {
  double length = 0.95;  // From the shoulders to the hem's corners.
  double half_neck = 0.09;
  bool v_neck = false;  // In front: straight from the drop to the neck's ends.
  double front_drop = 0.12;
  double back_drop = 0.04;
  Eigen::Vector2d shoulder_tip{0.15, -0.03};
  Eigen::Vector2d underarm{0.22, -0.24};
  // Nearest the armhole comes to the middle, 0.15 below the shoulder.
  double front_armhole = 0.14;
  double back_armhole = 0.155;
  double half_waist = 0.18;  // 0.42 below Cp.
  double half_hip = 0.24;    // 0.62 below Cp.
  double half_hem = 0.34;
  // With sleeves: as a T-shirt's, tip to top and underarm to bottom.
  bool sleeved = false;
  Eigen::Vector2d sleeve_top{0.33, -0.14};
  Eigen::Vector2d sleeve_bottom{0.27, -0.26};
};

// Draws one side or both. DrawnView::sleeve_turn_deg turns the wearer's left leg inwards and the right one outwards by
// that angle; `leg_turn_deg` of DrawTrousers() turns both legs outwards.
GarmentView DrawView(const DrawnSkirt& skirt, GarmentSide side, const DrawnView& view);
GarmentView DrawView(const DrawnTrousers& trousers, GarmentSide side, const DrawnView& view, double leg_turn_deg = 0.0);
GarmentView DrawView(const DrawnDress& dress, GarmentSide side, const DrawnView& view);

Garment DrawGarment(const DrawnSkirt& skirt, const DrawnView& front = {}, const DrawnView& back = {});
Garment DrawGarment(const DrawnTrousers& trousers, const DrawnView& front = {}, const DrawnView& back = {});
Garment DrawGarment(const DrawnDress& dress, const DrawnView& front = {}, const DrawnView& back = {});

// One simple garment of any kind.
Garment DrawKind(GarmentKind kind, const DrawnView& front = {}, const DrawnView& back = {});

}  // namespace fitroom::testing
