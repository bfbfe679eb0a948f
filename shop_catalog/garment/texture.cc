#include "shop_catalog/garment/texture.h"

#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/base/check.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {

Image CarryColoursOn(const Image& photograph, const Polygon& outline, int edge) {
  FR_CHECK(photograph.channels == 3);
  const cv::Mat rgb = ViewOf(photograph);
  const cv::Mat filled = FillPolygon(outline, rgb.size());
  cv::Mat inside;
  cv::erode(filled, inside, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * edge + 1, 2 * edge + 1)),
            cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  if (cv::countNonZero(inside) == 0) return photograph;
  // Each pixel outside learns which pixel inside is nearest to it.
  cv::Mat distance;
  cv::Mat labels;
  cv::distanceTransform(~inside, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec3b> colour_of_label(inside.total() + 1);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      if (inside.at<uint8_t>(y, x) != 0) {
        colour_of_label[static_cast<size_t>(labels.at<int>(y, x))] = rgb.at<cv::Vec3b>(y, x);
      }
    }
  }
  cv::Mat carried = rgb.clone();
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      if (inside.at<uint8_t>(y, x) == 0) {
        carried.at<cv::Vec3b>(y, x) = colour_of_label[static_cast<size_t>(labels.at<int>(y, x))];
      }
    }
  }
  // Single odd pixels would grow into rays: outside, neighbours are averaged.
  cv::Mat soft;
  cv::blur(carried, soft, cv::Size(5, 5));
  soft.copyTo(carried, ~inside);
  return ImageOf(carried);
}

}  // namespace fitroom::shop_catalog
