#include "shop_catalog/garment/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "common/base/check.h"

namespace fitroom::shop_catalog {
namespace {

Polygon ToPolygon(const std::vector<cv::Point>& contour) {
  Polygon polygon;
  for (const cv::Point& p : contour) polygon.push_back({p.x + 0.5, p.y + 0.5});
  return polygon;
}

// Moves each point of a pixel contour along the coverage's gradient onto level 128; the contour runs through the
// innermost pixels of the edge, so the way is about half a pixel outwards.
void MoveOntoLevel(const cv::Mat& coverage, const std::vector<cv::Point>& contour, Polygon& polygon) {
  cv::Mat smooth;
  coverage.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, cv::Size(0, 0), 0.8);
  for (size_t i = 0; i < contour.size(); ++i) {
    const int x = std::clamp(contour[i].x, 1, coverage.cols - 2);
    const int y = std::clamp(contour[i].y, 1, coverage.rows - 2);
    const Eigen::Vector2d gradient(0.5 * static_cast<double>(smooth.at<float>(y, x + 1) - smooth.at<float>(y, x - 1)),
                                   0.5 * static_cast<double>(smooth.at<float>(y + 1, x) - smooth.at<float>(y - 1, x)));
    const double squared_slope = gradient.squaredNorm();
    if (squared_slope < 25.0) continue;
    const double excess = static_cast<double>(smooth.at<float>(y, x)) - 127.5;
    Eigen::Vector2d move = -excess / squared_slope * gradient;
    if (move.norm() > 1.5) move *= 1.5 / move.norm();
    polygon[i] += move;
  }
}

// Averages each point with its neighbours (weights 1 2 1), `rounds` times: removes the stairs of the pixel grid.
void Smooth(Polygon& polygon, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    Polygon smooth = polygon;
    const size_t n = polygon.size();
    for (size_t i = 0; i < n; ++i) {
      smooth[i] = 0.25 * polygon[(i + n - 1) % n] + 0.5 * polygon[i] + 0.25 * polygon[(i + 1) % n];
    }
    polygon = std::move(smooth);
  }
}

double SquaredDistance(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).squaredNorm(); }

}  // namespace

Polygon Resample(const Polygon& polygon, int count) {
  FR_CHECK(polygon.size() >= 3 && count >= 3);
  const double step = Perimeter(polygon) / count;
  Polygon samples;
  samples.reserve(static_cast<size_t>(count));
  double before = 0.0;
  for (size_t i = 0; i < polygon.size() && samples.size() < static_cast<size_t>(count); ++i) {
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    while (samples.size() < static_cast<size_t>(count)) {
      const double wanted = step * static_cast<double>(samples.size()) - before;
      if (wanted >= length) break;
      samples.push_back(polygon[i] + wanted / length * edge);
    }
    before += length;
  }
  while (samples.size() < static_cast<size_t>(count)) samples.push_back(polygon.back());
  return samples;
}

Polygon TraceOutline(const cv::Mat& coverage, double spacing) {
  std::vector<std::vector<cv::Point>> contours;
  const cv::Mat inside = coverage >= 128;
  cv::findContours(inside, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto longest = std::max_element(contours.begin(), contours.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  if (longest == contours.end() || longest->size() < 16) return {};
  for (int attempt = 0; attempt < 2; ++attempt) {
    Polygon polygon = ToPolygon(*longest);
    if (attempt == 0) MoveOntoLevel(coverage, *longest, polygon);
    Smooth(polygon, 3);
    const int count = std::clamp(static_cast<int>(Perimeter(polygon) / spacing), 16, 4000);
    polygon = Resample(polygon, count);
    if (SignedArea(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    if (!FindCrossing(polygon)) return polygon;
  }
  return {};
}

cv::Mat FillPolygon(const Polygon& polygon, cv::Size size) {
  constexpr int kShift = 4;  // Corners are given to a sixteenth of a pixel.
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& p : polygon) {
    corners.emplace_back(cvRound((p.x() - 0.5) * (1 << kShift)), cvRound((p.y() - 0.5) * (1 << kShift)));
  }
  cv::Mat mask(size, CV_8U, cv::Scalar(0));
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255), cv::LINE_8, kShift);
  return mask;
}

SampledOutline::SampledOutline(const Polygon& polygon, double step)
    : points_(Resample(polygon, std::max(64, static_cast<int>(Perimeter(polygon) / step)))) {
  step_ = Perimeter(polygon) / count();
}

int SampledOutline::IndexNear(const Eigen::Vector2d& pixel) const {
  int best = 0;
  for (int i = 1; i < count(); ++i) {
    if (SquaredDistance(at(i), pixel) < SquaredDistance(at(best), pixel)) best = i;
  }
  return best;
}

double SampledOutline::TurnAt(int index, int arm) const {
  const Eigen::Vector2d in = at(index) - at(index - arm);
  const Eigen::Vector2d out = at(index + arm) - at(index);
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

}  // namespace fitroom::shop_catalog
