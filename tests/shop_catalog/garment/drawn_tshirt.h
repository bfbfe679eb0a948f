#pragma once

#include <array>
#include <map>
#include <string>

#include <Eigen/Core>

#include "common/garment/garment.h"
#include "common/garment/polygon.h"
#include "common/image/image.h"

namespace fitroom::testing {

using Colour = std::array<int, 3>;  // RGB, 0 to 255.

// How a T-shirt is drawn. The truth about every point is known, because the drawing starts from the points.
struct DrawnTShirtOptions {
  GarmentSide side = GarmentSide::kFront;
  int image_side = 600;                             // (unit: pixel)
  double height = 420.0;                            // Neck ends to hem (unit: pixel).
  double tilt_deg = 0.0;                            // Clockwise on the screen.
  double width_scale = 1.0;                         // Of everything across.
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  // (unit: pixel)
  Colour cloth = {40, 90, 170};
  Colour inside = {25, 55, 110};  // Of the visible inside of the back neck (front view).
  Colour background = {235, 232, 226};
  double noise = 3.0;       // Standard deviation of each channel (unit: grey level).
  double texture = 0.0;     // Amplitude of stripes in the background (unit: grey level).
  bool shadow = false;      // A soft, detached shadow below the hem.
  bool with_alpha = false;  // The background is transparent instead.
};

struct DrawnTShirt {
  Image photo;                                    // RGB, or RGBA with_alpha.
  Polygon silhouette;                             // Clockwise; the back neck's inside included.
  std::map<std::string, Eigen::Vector2d> points;  // P1, P2, e4, e8, sleeve bottoms, underarms, hem corners, neck_drop.
  double length_px = 0.0;
};

DrawnTShirt DrawTShirt(const DrawnTShirtOptions& options);

// Draws a filled polygon on a plain ground: for garments of other kinds.
Image DrawShape(const Polygon& polygon, int image_side, const Colour& cloth, const Colour& background);

}  // namespace fitroom::testing
