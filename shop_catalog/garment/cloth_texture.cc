#include "shop_catalog/garment/cloth_texture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace fitroom::shop_catalog {
namespace {

// Folds are soft: their height is computed on every fourth pixel.
constexpr int kCoarse = 4;

cv::Mat ToUnitDeviation(const cv::Mat& noise) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  return (noise - mean[0]) / std::max(deviation[0], 1e-9);
}

}  // namespace

cv::Mat WhiteNoise(cv::Size size, uint64_t seed) {
  cv::Mat noise(size, CV_32F);
  cv::RNG random(seed * 0x9E3779B97F4A7C15u + 1);
  random.fill(noise, cv::RNG::UNIFORM, -1.0, 1.0);
  return noise;
}

cv::Mat SmoothNoise(cv::Size size, double feature, uint64_t seed) {
  const cv::Size coarse(static_cast<int>(size.width / feature) + 4, static_cast<int>(size.height / feature) + 4);
  cv::Mat noise;
  cv::resize(WhiteNoise(coarse, seed), noise, size, 0, 0, cv::INTER_CUBIC);
  return ToUnitDeviation(noise);
}

cv::Mat FibreNoise(cv::Size size, uint64_t seed) {
  cv::Mat noise;
  cv::GaussianBlur(WhiteNoise(size, seed), noise, cv::Size(0, 0), 2.2, 0.6);
  return ToUnitDeviation(noise);
}

cv::Mat ShadeFolds(const std::vector<Fold>& folds, const cv::Mat& cm_from_pixel, cv::Size size, uint64_t seed) {
  const cv::Size coarse(size.width / kCoarse + 1, size.height / kCoarse + 1);
  cv::Mat height(coarse, CV_32F);
  const double* m = cm_from_pixel.ptr<double>();
  for (int y = 0; y < coarse.height; ++y) {
    float* row = height.ptr<float>(y);
    for (int x = 0; x < coarse.width; ++x) {
      const double px = x * kCoarse, py = y * kCoarse;
      const Eigen::Vector2d place(m[0] * px + m[1] * py + m[2], m[3] * px + m[4] * py + m[5]);
      double sum = 0.0;
      for (const Fold& fold : folds) {
        const Eigen::Vector2d offset = place - fold.middle;
        const double along = offset.dot(fold.direction) / fold.length;
        // A fold is never quite straight.
        const double across = (offset.x() * fold.direction.y() - offset.y() * fold.direction.x()) / fold.width +
                              0.6 * std::sin(1.7 * along + fold.middle.x());
        const double exponent = along * along + across * across;
        if (exponent < 8.0) sum += fold.height * std::exp(-exponent);
      }
      row[x] = static_cast<float>(sum);
    }
  }
  height += 0.05 * SmoothNoise(coarse, 30.0 / kCoarse, seed) + 0.11 * SmoothNoise(coarse, 90.0 / kCoarse, seed + 1);
  cv::GaussianBlur(height, height, cv::Size(0, 0), 1.5);
  cv::Mat slope_x, slope_y;
  cv::Sobel(height, slope_x, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(height, slope_y, CV_32F, 0, 1, 3, 1.0 / 8.0);
  const double pixels_per_cm = 1.0 / std::hypot(m[0], m[3]);
  // Light from the upper left: a slope that rises to the right or downwards faces away from it. Slopes of height in cm
  // a coarse pixel are brought to cm a cm.
  const double gain = 1.5 * pixels_per_cm / kCoarse;
  const cv::Mat rise = gain * (0.6 * slope_x + 0.8 * slope_y);
  cv::Mat shade;
  cv::resize(1.0 + rise, shade, cv::Size(coarse.width * kCoarse, coarse.height * kCoarse), 0, 0, cv::INTER_CUBIC);
  shade = shade(cv::Rect(cv::Point(0, 0), size)).clone();
  cv::max(shade, 0.62, shade);
  cv::min(shade, 1.22, shade);
  return shade;
}

}  // namespace fitroom::shop_catalog
