#include "shop_catalog/garment/garment_canvas.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/cv_image.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// Shapes are drawn with this many fractional bits of a pixel.
constexpr int kShift = 6;
// How far the edges wave (unit: centimetre).
constexpr double kCrumple = 0.22;

std::vector<cv::Point> ToFixed(const std::vector<Vector2d>& pixels) {
  std::vector<cv::Point> fixed;
  fixed.reserve(pixels.size());
  for (const Vector2d& pixel : pixels) {
    // OpenCV's whole numbers are pixel centres.
    fixed.emplace_back(static_cast<int>(std::lround((pixel.x() - 0.5) * (1 << kShift))),
                       static_cast<int>(std::lround((pixel.y() - 0.5) * (1 << kShift))));
  }
  return fixed;
}

void Multiply(cv::Mat& picture, const cv::Mat& factor) {
  cv::Mat three;
  cv::merge(std::vector<cv::Mat>{factor, factor, factor}, three);
  cv::multiply(picture, three, picture);
}

}  // namespace

GarmentCanvas::GarmentCanvas(int side, const Lie& lie, uint64_t seed)
    : side_(side),
      lie_(lie),
      seed_(seed),
      picture_(side, side, CV_32FC3),
      clip_(side, side, CV_32F, cv::Scalar(1.0)),
      shade_(side, side, CV_32F, cv::Scalar(1.0)),
      fibres_(FibreNoise(cv::Size(side, side), seed + 101)) {}

Vector2d GarmentCanvas::Crumple(const Vector2d& place) const {
  return kCrumple * Vector2d(std::sin(0.19 * place.y() + 0.07 * place.x() + lie_.crumple_phase[0]),
                             std::sin(0.17 * place.x() - 0.05 * place.y() + lie_.crumple_phase[1]));
}

Vector2d GarmentCanvas::Pixel(const Vector2d& place) const {
  const Vector2d offset = lie_.pixels_per_cm * (place + Crumple(place) - lie_.flat_middle);
  const double c = std::cos(lie_.tilt), s = std::sin(lie_.tilt);
  return lie_.middle + Vector2d(c * offset.x() - s * offset.y(), s * offset.x() + c * offset.y());
}

Vector2d GarmentCanvas::Place(const Vector2d& pixel) const {
  const Vector2d offset = (pixel - lie_.middle) / lie_.pixels_per_cm;
  const double c = std::cos(lie_.tilt), s = std::sin(lie_.tilt);
  const Vector2d crumpled =
      lie_.flat_middle + Vector2d(c * offset.x() + s * offset.y(), c * offset.y() - s * offset.x());
  // The waves are long: one step of the inverse is exact to a few hundredths of a millimetre.
  return crumpled - Crumple(crumpled - Crumple(crumpled));
}

cv::Mat GarmentCanvas::Coverage(const FlatCurve& outline) const {
  std::vector<Vector2d> pixels;
  pixels.reserve(outline.size());
  for (const Vector2d& place : outline) pixels.push_back(Pixel(place));
  cv::Mat mask(side_, side_, CV_8U, cv::Scalar(0));
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{ToFixed(pixels)}, cv::Scalar(255), cv::LINE_AA, kShift);
  cv::Mat coverage;
  mask.convertTo(coverage, CV_32F, 1.0 / 255.0);
  return coverage;
}

cv::Mat GarmentCanvas::StrokeCoverage(const std::vector<FlatCurve>& curves, double width_cm) const {
  std::vector<std::vector<cv::Point>> lines;
  for (const FlatCurve& curve : curves) {
    std::vector<Vector2d> pixels;
    for (const Vector2d& place : curve) pixels.push_back(Pixel(place));
    lines.push_back(ToFixed(pixels));
  }
  cv::Mat mask(side_, side_, CV_8U, cv::Scalar(0));
  const int thickness = std::max(1, static_cast<int>(std::lround(width_cm * lie_.pixels_per_cm)));
  cv::polylines(mask, lines, false, cv::Scalar(255), thickness, cv::LINE_AA, kShift);
  cv::Mat coverage;
  mask.convertTo(coverage, CV_32F, 1.0 / 255.0);
  return coverage;
}

void GarmentCanvas::LayGround(const Rgb& colour) {
  picture_.setTo(cv::Scalar(colour.x(), colour.y(), colour.z()));
  const cv::Size size(side_, side_);
  cv::Mat light(size, CV_32F);
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      // Brighter towards the window at the upper left, dim in the corners.
      const double u = static_cast<double>(x) / side_ - 0.5, v = static_cast<double>(y) / side_ - 0.5;
      light.at<float>(y, x) = static_cast<float>(1.0 - 0.04 * (u + v) - 0.07 * (u * u + v * v));
    }
  }
  light += 0.004 * SmoothNoise(size, side_ / 5.0, seed_ + 5);
  Multiply(picture_, light);
}

void GarmentCanvas::CastShadow(const FlatCurve& outline) {
  const cv::Mat cover = Coverage(outline);
  const double cm = lie_.pixels_per_cm;
  cv::Mat contact, wide;
  cv::GaussianBlur(cover, contact, cv::Size(0, 0), 0.35 * cm);
  cv::GaussianBlur(cover, wide, cv::Size(0, 0), 1.3 * cm);
  const double shift = 0.5 * cm;
  const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, 0.6 * shift, 0, 1, shift);
  cv::warpAffine(wide, wide, move, wide.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  Multiply(picture_, 1.0 - 0.22 * contact - 0.20 * wide);
}

void GarmentCanvas::SetClip(const FlatCurve& outline) { clip_ = Coverage(outline); }

void GarmentCanvas::SetFolds(const std::vector<Fold>& folds) {
  const double c = std::cos(lie_.tilt) / lie_.pixels_per_cm, s = std::sin(lie_.tilt) / lie_.pixels_per_cm;
  const Vector2d origin =
      lie_.flat_middle - Vector2d(c * lie_.middle.x() + s * lie_.middle.y(), c * lie_.middle.y() - s * lie_.middle.x());
  const cv::Mat cm_from_pixel = (cv::Mat_<double>(2, 3) << c, s, origin.x(), -s, c, origin.y());
  shade_ = ShadeFolds(folds, cm_from_pixel, cv::Size(side_, side_), seed_ + 31);
}

void GarmentCanvas::FillCloth(const FlatCurve& outline, const Cloth& cloth, double mottle, double light) {
  const cv::Mat cover = cv::min(Coverage(outline), clip_);
  for (int y = 0; y < side_; ++y) {
    cv::Vec3f* row = picture_.ptr<cv::Vec3f>(y);
    for (int x = 0; x < side_; ++x) {
      const float amount = cover.at<float>(y, x);
      if (amount <= 0.0F) continue;
      const Rgb colour = cloth(Place(Vector2d(x + 0.5, y + 0.5)));
      const double bright = light * shade_.at<float>(y, x) * (1.0 + mottle * fibres_.at<float>(y, x));
      for (int i = 0; i < 3; ++i) {
        row[x][i] += amount * (static_cast<float>(bright) * colour[i] - row[x][i]);
      }
    }
  }
}

void GarmentCanvas::FillInk(const FlatCurve& outline, const Rgb& colour, double opacity) {
  FillCloth(
      outline, [&colour](const Vector2d&) { return colour; }, 0.02 * opacity);
}

void GarmentCanvas::DrawSeams(const std::vector<FlatCurve>& curves, double width_cm, double darkness) {
  cv::Mat stroke = StrokeCoverage(curves, width_cm);
  cv::GaussianBlur(stroke, stroke, cv::Size(0, 0), std::max(0.6, 0.5 * width_cm * lie_.pixels_per_cm));
  Multiply(picture_, 1.0 - darkness * stroke.mul(clip_));
}

void GarmentCanvas::DrawStitches(const FlatCurve& curve, const Rgb& colour, double stitch_cm, double width_cm) {
  // A stitch covers 60 % of its length.
  constexpr double kStep = 0.05;  // (unit: centimetre)
  std::vector<FlatCurve> stitches(1);
  double walked = 0.0;
  for (size_t i = 1; i < curve.size(); ++i) {
    const Vector2d step = curve[i] - curve[i - 1];
    const double length = step.norm();
    for (double t = 0.0; t < length; t += kStep) {
      if (std::fmod(walked + t, stitch_cm) < 0.6 * stitch_cm) {
        stitches.back().push_back(curve[i - 1] + t / length * step);
      } else if (!stitches.back().empty()) {
        stitches.emplace_back();
      }
    }
    walked += length;
  }
  std::erase_if(stitches, [](const FlatCurve& stitch) { return stitch.size() < 2; });
  const cv::Mat stroke = StrokeCoverage(stitches, width_cm).mul(clip_);
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      const float amount = 0.75F * stroke.at<float>(y, x);
      if (amount <= 0.0F) continue;
      cv::Vec3f& pixel = picture_.at<cv::Vec3f>(y, x);
      for (int i = 0; i < 3; ++i) pixel[i] += amount * (shade_.at<float>(y, x) * colour[i] - pixel[i]);
    }
  }
}

Image GarmentCanvas::Develop() {
  cv::GaussianBlur(picture_, picture_, cv::Size(0, 0), 0.55);
  const cv::Mat grain = WhiteNoise(picture_.size(), seed_ + 977);
  std::vector<cv::Mat> channels;
  cv::split(picture_, channels);
  for (cv::Mat& channel : channels) channel += 1.6 * grain;
  cv::merge(channels, picture_);
  cv::Mat developed;
  picture_.convertTo(developed, CV_8UC3);
  return ImageOf(developed);
}

}  // namespace fitroom::shop_catalog
