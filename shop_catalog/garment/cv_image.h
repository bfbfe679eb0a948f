#pragma once

#include <opencv2/core.hpp>

#include "common/image/image.h"

// Between our images and OpenCV's matrices. OpenCV stays inside this folder.
namespace fitroom::shop_catalog {

// Wraps the image's pixels without a copy; the matrix must not outlive or change the image.
cv::Mat ViewOf(const Image& image);

// Copies an 8-bit matrix of 1, 3 or 4 channels.
Image ImageOf(const cv::Mat& matrix);

// Returns an RGB image in CIE L*a*b* (L 0 to 100, a and b about -127 to 127) as 32-bit floats.
cv::Mat LabOf(const cv::Mat& rgb);

}  // namespace fitroom::shop_catalog
