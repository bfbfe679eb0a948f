#include "shop_catalog/garment/cv_image.h"

#include <cstring>

#include <opencv2/imgproc.hpp>

#include "common/base/check.h"

namespace fitroom::shop_catalog {

cv::Mat ViewOf(const Image& image) {
  FR_CHECK(IsValid(image));
  return cv::Mat(image.height, image.width, CV_8UC(image.channels), const_cast<uint8_t*>(image.pixels.data()));
}

Image ImageOf(const cv::Mat& matrix) {
  FR_CHECK(matrix.depth() == CV_8U);
  Image image = MakeImage(matrix.cols, matrix.rows, matrix.channels());
  for (int y = 0; y < matrix.rows; ++y) {
    std::memcpy(image.at(0, y), matrix.ptr(y),
                static_cast<size_t>(matrix.cols) * static_cast<size_t>(matrix.channels()));
  }
  return image;
}

cv::Mat LabOf(const cv::Mat& rgb) {
  cv::Mat scaled;
  rgb.convertTo(scaled, CV_32FC3, 1.0 / 255.0);
  cv::Mat lab;
  cv::cvtColor(scaled, lab, cv::COLOR_RGB2Lab);
  return lab;
}

}  // namespace fitroom::shop_catalog
