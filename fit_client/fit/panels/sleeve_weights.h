#pragma once

#include <limits>

#include <Eigen/Core>

#include "fit_client/fit/panels/pattern.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {

// Says how much a point of a panel belongs to a sleeve: 1 on the sleeve, 0 on the torso, smooth across the armhole
// line, which runs straight from the shoulder tip to the underarm.
class SleeveWeight {
 public:
  // A kind without sleeves weighs 0 everywhere.
  SleeveWeight(const PanelPattern& panel, GarmentKind kind, bool left);

  // Returns 0 to 1; 0.5 on the armhole line, 0 and 1 from 3 cm beyond it.
  double At(const Eigen::Vector2d& point) const;

 private:
  Eigen::Vector2d shoulder_tip_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d underarm_ = Eigen::Vector2d::Zero();
  // The box round the sleeve.
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high_ = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  Polyline sleeve_;  // The closed outline of the sleeve, the armhole line its last side.
};

}  // namespace fitroom::panels
