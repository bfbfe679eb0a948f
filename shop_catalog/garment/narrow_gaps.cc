#include "shop_catalog/garment/narrow_gaps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace fitroom::shop_catalog {
namespace {

// Parts of the garment's height.
constexpr double kGapRadius = 0.018;  // A gap is at most twice as wide.
constexpr double kColourReach = 0.03;
constexpr double kLeastContrast = 40.0;   // Between garment and gap (unit: grey levels).
constexpr float kBackgroundPart = 0.38F;  // Below this part of the way from background to garment it is background.
constexpr double kMostOffLine = 40.0;  // Further from the line between both colours it is a print (unit: grey levels).
constexpr float kShading = 0.03F;      // A gap darkens inwards: how fast the background's colour follows, per pixel.

cv::Mat Disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radius + 1, 2 * radius + 1));
}

// The garment's mean colour near each pixel, from well inside the mask.
cv::Mat GarmentColours(const cv::Mat& colours, const cv::Mat& mask, int reach) {
  cv::Mat inside, weight, total;
  cv::erode(mask, inside, Disc(std::max(1, reach / 4)), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  inside.convertTo(weight, CV_32F, 1.0 / 255.0);
  const cv::Size window(2 * reach + 1, 2 * reach + 1);
  cv::blur(weight, total, window);
  std::vector<cv::Mat> channels;
  cv::split(colours, channels);
  for (cv::Mat& channel : channels) {
    channel = channel.mul(weight);
    cv::blur(channel, channel, window);
    channel = channel / cv::max(total, 1e-4);
  }
  cv::Mat mean;
  cv::merge(channels, mean);
  return mean;
}

struct Step {
  int x, y, depth;
  cv::Vec3f background;
};

}  // namespace

cv::Mat OpenNarrowGaps(const cv::Mat& rgb, const cv::Mat& coverage, double height, double max_depth) {
  const int radius = std::max(2, static_cast<int>(std::lround(kGapRadius * height)));
  const int max_depth_px = static_cast<int>(std::lround(max_depth * height));
  const cv::Mat mask = coverage >= 128;
  cv::Mat closed;
  cv::morphologyEx(mask, closed, cv::MORPH_CLOSE, Disc(radius), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT,
                   cv::Scalar(0));
  const cv::Mat gaps = closed & ~mask;
  cv::Mat colours;
  rgb.convertTo(colours, CV_32FC3);
  cv::GaussianBlur(colours, colours, cv::Size(0, 0), 0.8);
  const int reach = std::max(3, static_cast<int>(std::lround(kColourReach * height)));
  const cv::Mat garment = GarmentColours(colours, mask, reach);

  // Breadth first from the gaps that are seen; every pixel is reached once.
  cv::Mat reached = ~mask;
  cv::Mat grown(mask.size(), CV_8U, cv::Scalar(0));
  std::vector<Step> front;
  for (int y = 0; y < gaps.rows; ++y) {
    for (int x = 0; x < gaps.cols; ++x) {
      if (gaps.at<uint8_t>(y, x) != 0) front.push_back({x, y, 0, colours.at<cv::Vec3f>(y, x)});
    }
  }
  for (size_t next = 0; next < front.size(); ++next) {
    const Step step = front[next];
    if (step.depth >= max_depth_px) continue;
    constexpr int kWays[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const auto& way : kWays) {
      const int x = step.x + way[0], y = step.y + way[1];
      if (x < 0 || y < 0 || x >= mask.cols || y >= mask.rows || reached.at<uint8_t>(y, x) != 0) continue;
      const cv::Vec3f& colour = colours.at<cv::Vec3f>(y, x);
      const cv::Vec3f difference = garment.at<cv::Vec3f>(y, x) - step.background;
      const float squared = difference.dot(difference);
      if (squared < static_cast<float>(kLeastContrast * kLeastContrast)) continue;
      const float part = (colour - step.background).dot(difference) / squared;
      if (part > kBackgroundPart || cv::norm(colour - step.background - part * difference) > kMostOffLine) continue;
      reached.at<uint8_t>(y, x) = 255;
      grown.at<uint8_t>(y, x) = 255;
      front.push_back({x, y, step.depth + 1, step.background + kShading * (colour - step.background)});
    }
  }
  // What has grown wide is a print of the background's colour, not a gap.
  cv::Mat wide;
  cv::morphologyEx(grown | gaps, wide, cv::MORPH_OPEN, Disc(radius), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT,
                   cv::Scalar(0));
  cv::dilate(wide, wide, Disc(radius));
  grown &= ~wide;
  if (cv::countNonZero(grown) == 0) return coverage;
  cv::Mat opened = coverage.clone();
  opened.setTo(0, grown);
  return opened;
}

}  // namespace fitroom::shop_catalog
