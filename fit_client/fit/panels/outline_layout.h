#pragma once

#include <string>
#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// One section of a kind's outline: which points it runs through, and which section mirrors it.
struct SectionLayout {
  std::string name;
  SectionKind kind = SectionKind::kSeam;
  std::vector<std::string> knots;  // First and last are corners of the outline.
  int mirror = 0;                  // Index of the section on the other side; its own for neck and hem.
  int degree = 1;                  // Of the smooth curve that replaces the crumpled outline.
  int held_knot = -1;              // A knot at which the outline bends: the curve is held there. -1: none.
  // The section is its own on each panel (neck, waist, armhole, hem) instead of shared by both.
  bool own_per_panel = false;
};

// Returns the outline of a kind, counter-clockwise in the wearer's frame (x towards the wearer's left, y up), which is
// the order in which the sections are joined. The first section is the upper opening: the neck or the waist.
const std::vector<SectionLayout>& OutlineLayout(GarmentKind kind);

// Returns the name of the point at which the shoulder ends and the arm begins, of a kind that hangs on the shoulders.
std::string ShoulderTipName(GarmentKind kind, bool left);

}  // namespace fitroom::panels
