#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// The smooth map from a panel to its photograph: outline onto outline exactly, the inside by mean-value coordinates
// (Hormann and Floater, "Mean value coordinates for arbitrary planar polygons", 2006), which carry a similarity of the
// outline on to the inside unchanged. At a corner that the photograph creases (the underarm) it may fold over within a
// centimetre; MeshPattern() mends that on the mesh. Immutable; safe to share between threads.
class PhotoWarp {
 public:
  explicit PhotoWarp(const PanelPattern& panel);

  // Returns the pixel that shows a point of the pattern (metres) inside the panel or on its outline.
  Eigen::Vector2d PixelAt(const Eigen::Vector2d& point) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<Eigen::Vector2d> pixels_;
};

}  // namespace fitroom
