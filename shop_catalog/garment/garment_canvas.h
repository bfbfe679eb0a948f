#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "common/image/image.h"
#include "shop_catalog/garment/cloth_texture.h"
#include "shop_catalog/garment/flat_curve.h"

namespace fitroom::shop_catalog {

using Rgb = Eigen::Vector3f;  // Linear in the pixel's value, 0 to 255.

// A photograph in the making. Shapes are given on the flat garment (FlatCurve, centimetre); the canvas knows how the
// garment lies in the picture, crumples it a little and shades everything that is cloth by its folds. Not thread-safe.
class GarmentCanvas {
 public:
  // How the garment lies in the picture.
  struct Lie {
    double tilt = 0.0;  // Positive clockwise on the screen (unit: radian).
    double pixels_per_cm = 10.0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();       // Where `flat_middle` comes to lie (unit: pixel).
    Eigen::Vector2d flat_middle = Eigen::Vector2d::Zero();  // (unit: centimetre)
    std::array<double, 2> crumple_phase = {0.0, 0.0};       // Of the small waves in its edges (unit: radian).
  };
  // The colour of cloth at a place on the flat garment (unit: centimetre).
  using Cloth = std::function<Rgb(const Eigen::Vector2d& place)>;

  GarmentCanvas(int side, const Lie& lie, uint64_t seed);

  const Lie& lie() const { return lie_; }
  // Returns where a place on the flat garment is seen (unit: pixel, centres at +0.5).
  Eigen::Vector2d Pixel(const Eigen::Vector2d& place) const;

  // Fills the picture with a plain, not quite even ground.
  void LayGround(const Rgb& colour);
  // Darkens the ground round a shape that lies on it.
  void CastShadow(const FlatCurve& outline);
  // Lets nothing drawn from now on reach beyond a shape.
  void SetClip(const FlatCurve& outline);
  // Sets the folds that shade all cloth drawn from now on.
  void SetFolds(const std::vector<Fold>& folds);
  // Draws cloth. `mottle` is the strength of its fibres, 0 to about 0.1; `light` dims the whole of it.
  void FillCloth(const FlatCurve& outline, const Cloth& cloth, double mottle, double light = 1.0);
  // Draws one colour, shaded as the cloth beneath it.
  void FillInk(const FlatCurve& outline, const Rgb& colour, double opacity = 1.0);
  // Darkens softly along curves: seams and edges.
  void DrawSeams(const std::vector<FlatCurve>& curves, double width_cm, double darkness);
  // Draws a row of stitches.
  void DrawStitches(const FlatCurve& curve, const Rgb& colour, double stitch_cm = 0.32, double width_cm = 0.07);
  // Adds the camera's softness and noise and returns the picture.
  Image Develop();

 private:
  Eigen::Vector2d Place(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d Crumple(const Eigen::Vector2d& place) const;
  // Coverage of a shape, CV_32F, 0 to 1, with smooth edges.
  cv::Mat Coverage(const FlatCurve& outline) const;
  cv::Mat StrokeCoverage(const std::vector<FlatCurve>& curves, double width_cm) const;

  int side_;
  Lie lie_;
  uint64_t seed_;
  cv::Mat picture_;  // CV_32FC3, RGB.
  cv::Mat clip_;     // CV_32F, 0 to 1.
  cv::Mat shade_;    // CV_32F.
  cv::Mat fibres_;   // CV_32F.
};

}  // namespace fitroom::shop_catalog
