#pragma once

#include <opencv2/core.hpp>

#include "common/garment/polygon.h"

namespace fitroom::shop_catalog {

// Traces the outline of the garment in a coverage image (CV_8U; the outline is its level 128) as a simple polygon,
// clockwise on the screen, with points about `spacing` apart (unit: pixel), placed between pixels by the coverage.
// Returns an empty polygon where there is none.
Polygon TraceOutline(const cv::Mat& coverage, double spacing);

// Returns points at equal arc lengths, starting at point 0. `count` is at least 3.
Polygon Resample(const Polygon& polygon, int count);

// Fills a polygon: CV_8U of that size, 255 inside.
cv::Mat FillPolygon(const Polygon& polygon, cv::Size size);

// A closed curve sampled at equal arc lengths, with what local searches along it need.
class SampledOutline {
 public:
  // Samples at about `step` (unit: pixel).
  SampledOutline(const Polygon& polygon, double step);

  int count() const { return static_cast<int>(points_.size()); }
  double step() const { return step_; }
  double length() const { return step_ * count(); }
  // The sample of any index, taken round and round.
  const Eigen::Vector2d& at(int index) const { return points_[Wrap(index)]; }
  int IndexNear(const Eigen::Vector2d& pixel) const;

  // Returns the angle by which the outline turns at a sample, seen over `arm` samples to both sides: positive at a
  // convex corner (unit: radian).
  double TurnAt(int index, int arm) const;

 private:
  size_t Wrap(int index) const {
    const int n = count();
    return static_cast<size_t>(((index % n) + n) % n);
  }
  Polygon points_;
  double step_ = 1.0;
};

}  // namespace fitroom::shop_catalog
