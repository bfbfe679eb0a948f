#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace fitroom::shop_catalog {

// A soft fold: a ridge with a Gaussian profile along a straight line (unit: centimetre).
struct Fold {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double length = 10.0;
  double width = 2.0;
  double height = 0.3;
};

// Returns even noise in [-1, 1] as CV_32F. The same seed gives the same picture.
cv::Mat WhiteNoise(cv::Size size, uint64_t seed);

// Returns smooth noise of about unit deviation whose features are `feature` large (unit: pixel).
cv::Mat SmoothNoise(cv::Size size, double feature, uint64_t seed);

// Returns the fibres of mottled yarn: noise drawn out along the rows, about unit deviation.
cv::Mat FibreNoise(cv::Size size, uint64_t seed);

// Returns the brightness (about 1) of cloth that lies in these folds under light from the upper left.
// `cm_from_pixel` is the affine map from pixels to centimetres (2x3, CV_64F).
cv::Mat ShadeFolds(const std::vector<Fold>& folds, const cv::Mat& cm_from_pixel, cv::Size size, uint64_t seed);

}  // namespace fitroom::shop_catalog
