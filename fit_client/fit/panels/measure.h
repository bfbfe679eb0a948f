#pragma once

#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// The flat measures of a garment, all in metres. Girths are twice the flat width, as a shop measures them; left and
// right are averaged.
struct GarmentMeasures {
  double length = 0.0;            // Highest point of the shoulder straight down to the hem.
  double bust_girth = 0.0;        // At the underarms.
  double waist_girth = 0.0;       // At the waist points.
  double hip_girth = 0.0;         // At the hip points.
  double hem_girth = 0.0;         // Between the hem's corners.
  double shoulder_width = 0.0;    // Between the shoulder tips e3 and e7.
  double sleeve_length = 0.0;     // Along the top edge from the shoulder tip to the sleeve's end.
  double upper_arm_girth = 0.0;   // Twice the shortest way from the underarm to the sleeve's top edge.
  double side_seam_length = 0.0;  // Underarm to hem.
  double neck_opening = 0.0;      // Front and back neckline together.
};

// Returns one panel's length, from its highest point straight down to the hem (unit: metre).
double MeasureLength(const PanelPattern& panel);

// Measures a reconciled pattern of a top.
GarmentMeasures MeasurePattern(const GarmentPattern& pattern);

}  // namespace fitroom
