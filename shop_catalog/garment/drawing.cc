#include "shop_catalog/garment/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/cv_image.h"

namespace fitroom::shop_catalog {
namespace {

constexpr int kPanelSide = 900;  // Longest side of one photograph in the drawing (unit: pixel).
constexpr int kMargin = 40;      // Round the garment (unit: pixel of the drawing).
constexpr int kLineHeight = 22;  // Of the measures below (unit: pixel).

const cv::Scalar kPaper(250, 250, 250);
const cv::Scalar kInk(20, 20, 20);
const cv::Scalar kOutline(255, 0, 200);

cv::Scalar ColourOf(double confidence) {
  if (confidence >= 0.7) return {0, 150, 40};
  if (confidence >= 0.45) return {230, 140, 0};
  return {220, 0, 0};
}

cv::Point ToPoint(const Eigen::Vector2d& p) { return {cvRound(p.x() * 16), cvRound(p.y() * 16)}; }

void DrawLabel(cv::Mat& panel, const std::string& text, const cv::Point& where, const cv::Scalar& colour) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.42, 1, &baseline);
  const cv::Point corner(std::clamp(where.x, 0, std::max(0, panel.cols - size.width)),
                         std::clamp(where.y, size.height, panel.rows - 2));
  cv::putText(panel, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar(255, 255, 255), 3, cv::LINE_AA);
  cv::putText(panel, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.42, colour, 1, cv::LINE_AA);
}

// Draws one view, cut to the garment with a margin.
cv::Mat DrawView(const GarmentView& view, const Image& photo) {
  Eigen::Vector2d low = view.outline[0];
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& p : view.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = (kPanelSide - 2 * kMargin) / std::max(1.0, (high - low).maxCoeff());
  const Eigen::Vector2d origin = low - Eigen::Vector2d::Constant(kMargin / scale);
  const cv::Size size(cvCeil((high.x() - low.x()) * scale) + 2 * kMargin, kPanelSide);
  // Maps a pixel of the photograph to one of the drawing.
  const cv::Matx23d to_drawing(scale, 0, -origin.x() * scale, 0, scale, -origin.y() * scale);
  cv::Mat panel;
  cv::warpAffine(ViewOf(photo), panel, to_drawing, size, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR,
                 cv::BORDER_CONSTANT, kPaper);
  const auto place = [&](const Eigen::Vector2d& p) { return Eigen::Vector2d((p - origin) * scale); };

  std::vector<cv::Point> line;
  for (const Eigen::Vector2d& p : view.outline) line.push_back(ToPoint(place(p)));
  cv::polylines(panel, std::vector<std::vector<cv::Point>>{line}, true, kOutline, 1, cv::LINE_AA, 4);
  const double middle = 0.5 * (low.x() + high.x());
  for (const OutlinePoint& point : view.points) {
    const Eigen::Vector2d at = place(point.pixel);
    const cv::Scalar colour = ColourOf(point.confidence);
    cv::circle(panel, ToPoint(at), 5 * 16, cv::Scalar(255, 255, 255), cv::FILLED, cv::LINE_AA, 4);
    cv::circle(panel, ToPoint(at), 4 * 16, colour, cv::FILLED, cv::LINE_AA, 4);
    char text[64];
    std::snprintf(text, sizeof text, "%s %.2f", point.name.c_str(), point.confidence);
    // Labels go inwards, where there is cloth to write on.
    const bool on_left = point.pixel.x() < middle;
    DrawLabel(panel, text, {cvRound(at.x()) + (on_left ? 9 : -118), cvRound(at.y()) + 14}, colour);
  }
  const char* const title = view.side == GarmentSide::kFront  ? "FRONT (wearer's right on the left)"
                            : view.side == GarmentSide::kBack ? "BACK (wearer's left on the left)"
                                                              : "SIDE-FOLDED (crotch on the left)";
  DrawLabel(panel, title, {8, kPanelSide - 8}, kInk);
  return panel;
}

}  // namespace

Image DrawExtraction(const Garment& garment, const Image& front_photo, const Image* back_photo,
                     const Image* side_folded_photo) {
  std::vector<cv::Mat> panels = {DrawView(garment.front, front_photo)};
  if (garment.back && back_photo != nullptr) panels.push_back(DrawView(*garment.back, *back_photo));
  if (garment.side_folded && side_folded_photo != nullptr) {
    panels.push_back(DrawView(*garment.side_folded, *side_folded_photo));
  }
  int width = 0;
  for (const cv::Mat& panel : panels) width += panel.cols;
  width = std::max(width, 640);
  const int line_count = (static_cast<int>(garment.measures.size()) + 2) / 3 + 1;
  cv::Mat sheet(kPanelSide + line_count * kLineHeight + 10, width, CV_8UC3, kPaper);
  int x = 0;
  for (const cv::Mat& panel : panels) {
    panel.copyTo(sheet(cv::Rect(x, 0, panel.cols, panel.rows)));
    x += panel.cols;
  }
  for (size_t i = 0; i < garment.measures.size(); ++i) {
    char text[96];
    const GarmentMeasure& measure = garment.measures[i];
    const std::string name = measure.name.substr(0, 60);
    if (measure.provenance == Provenance::kUnknown) {
      std::snprintf(text, sizeof text, "%s unknown", name.c_str());
    } else {
      std::snprintf(text, sizeof text, "%s %.1f cm%s", name.c_str(), measure.value * 100.0,
                    measure.provenance == Provenance::kStated ? " (stated)" : "");
    }
    DrawLabel(sheet, text,
              {10 + static_cast<int>(i % 3) * width / 3, kPanelSide + (static_cast<int>(i / 3) + 1) * kLineHeight},
              kInk);
  }
  return ImageOf(sheet);
}

}  // namespace fitroom::shop_catalog
