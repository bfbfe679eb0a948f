#include "shop_catalog/garment/texture.h"

#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/base/check.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {
namespace {

cv::Mat Disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

// Mean colour of the pixels of `where` near each pixel; black where there are none.
cv::Mat LocalMean(const cv::Mat& rgb, const cv::Mat& where, int window) {
  cv::Mat weight;
  where.convertTo(weight, CV_32F, 1.0 / 255.0);
  cv::Mat total;
  cv::blur(weight, total, cv::Size(window, window));
  std::vector<cv::Mat> channels;
  cv::split(rgb, channels);
  for (cv::Mat& channel : channels) {
    channel.convertTo(channel, CV_32F);
    channel = channel.mul(weight);
    cv::blur(channel, channel, cv::Size(window, window));
    channel = channel / cv::max(total, 1e-4);
  }
  cv::Mat mean;
  cv::merge(channels, mean);
  return mean;
}

// Finds background that reaches into the silhouette through gaps too narrow for it, for example between sleeve and
// body: pixels of clearly the background's colour, connected with the outside, not deeper than `depth` (unit: pixel).
cv::Mat FindCrevices(const cv::Mat& rgb, const cv::Mat& silhouette, int depth) {
  constexpr double kLeastContrast = 40.0;  // Between garment and background near the place (unit: grey level).
  const cv::Mat outside = ~silhouette;
  cv::Mat deep;
  cv::Mat distance;
  cv::distanceTransform(silhouette, distance, cv::DIST_L2, cv::DIST_MASK_3);
  deep = distance > depth;
  const cv::Mat background = LocalMean(rgb, outside, 4 * depth + 1);
  const cv::Mat garment = LocalMean(rgb, deep, 6 * depth + 1);
  cv::Mat passable = outside.clone();
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      if (silhouette.at<uint8_t>(y, x) == 0 || deep.at<uint8_t>(y, x) != 0) continue;
      const cv::Vec3f colour = rgb.at<cv::Vec3b>(y, x);
      const cv::Vec3f& outer = background.at<cv::Vec3f>(y, x);
      const cv::Vec3f& inner = garment.at<cv::Vec3f>(y, x);
      if (cv::norm(outer - inner) < kLeastContrast) continue;
      if (cv::norm(colour - outer) < 0.5 * cv::norm(colour - inner)) passable.at<uint8_t>(y, x) = 255;
    }
  }
  cv::Mat labels;
  const int count = cv::connectedComponents(passable, labels, 8, CV_32S);
  std::vector<uint8_t> reaches_outside(static_cast<size_t>(count), 0);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      if (outside.at<uint8_t>(y, x) != 0) reaches_outside[static_cast<size_t>(labels.at<int>(y, x))] = 1;
    }
  }
  cv::Mat crevices(rgb.size(), CV_8U, cv::Scalar(0));
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label != 0 && reaches_outside[static_cast<size_t>(label)] != 0 && silhouette.at<uint8_t>(y, x) != 0) {
        crevices.at<uint8_t>(y, x) = 255;
      }
    }
  }
  return crevices;
}

}  // namespace

Image CarryColoursOn(const Image& photograph, const Image& silhouette, const Polygon& outline, int edge) {
  FR_CHECK(photograph.channels == 3 && silhouette.channels == 1);
  const cv::Mat rgb = ViewOf(photograph);
  const cv::Mat filled = FillPolygon(outline, rgb.size());
  cv::Mat inside;
  cv::erode(filled, inside, Disc(edge), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat crevices = FindCrevices(rgb, ViewOf(silhouette), 14 * edge);
  cv::dilate(crevices, crevices, Disc(edge));
  inside.setTo(0, crevices);
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
