#include "shop_catalog/garment/silhouette.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/image/decode.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/narrow_gaps.h"
#include "shop_catalog/garment/outline.h"
#include "shop_catalog/garment/segmentation.h"

namespace fitroom::shop_catalog {
namespace {

constexpr int kMaxWorkingSide = 2048;  // Of the working image (unit: pixel).
constexpr int kMinPhotoSide = 200;     // Below, a point is worth more than a centimetre (unit: pixel).
constexpr double kGapDepth = 0.10;     // How far closed legs are opened, part of the height.
constexpr double kMaxOnFrame = 0.012;  // Part of the outline that may lie on the frame.

double HeightOf(const Polygon& outline) {
  const auto [top, bottom] = std::minmax_element(
      outline.begin(), outline.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); });
  return bottom->y() - top->y();
}

// Part of the outline that lies within `margin` of the frame (unit: pixel).
double FramePartOf(const Polygon& outline, cv::Size size, double margin) {
  double on_frame = 0.0;
  for (const Eigen::Vector2d& p : outline) {
    const double to_frame = std::min({p.x(), p.y(), size.width - p.x(), size.height - p.y()});
    if (to_frame < margin) on_frame += 1.0;
  }
  return outline.empty() ? 0.0 : on_frame / static_cast<double>(outline.size());
}

// Points about 1.5 pixels apart on small photographs, at most about 1,500 in all.
Polygon TraceAtWorkingSize(const cv::Mat& coverage) {
  return TraceOutline(coverage, std::max(1.5, 4.5 * std::max(coverage.cols, coverage.rows) / 1500.0));
}

Silhouette FromAlpha(const cv::Mat& alpha) {
  Silhouette silhouette;
  silhouette.source = "alpha";
  silhouette.confidence = 1.0;
  const cv::Mat solid = CleanMask(alpha >= 128, 3);
  if (solid.empty()) return silhouette;
  silhouette.coverage = alpha.clone();
  silhouette.coverage.setTo(0, ~solid & (alpha >= 128));
  silhouette.coverage.setTo(255, solid & (alpha < 128));
  silhouette.outline = TraceAtWorkingSize(silhouette.coverage);
  return silhouette;
}

// Several methods each propose a mask; the one is taken that agrees with the others, has a visible edge, keeps off the
// frame and is shaped like the kind.
Silhouette FromSegmentation(const cv::Mat& rgb, GarmentKind kind, ShapeCost cost) {
  Silhouette best;
  double best_score = -1e9;
  const MaskCandidate* chosen = nullptr;
  const auto looks_like_the_kind = [&](const MaskCandidate& candidate) {
    const Polygon outline = TraceOutline(candidate.mask, 2.5);
    return !outline.empty() && cost(outline, kind) < kGoodShape;
  };
  const std::vector<MaskCandidate> candidates = SegmentGarment(rgb, looks_like_the_kind);
  for (const MaskCandidate& candidate : candidates) {
    const Polygon outline = TraceOutline(candidate.mask, 2.5 * std::max(1.0, std::max(rgb.cols, rgb.rows) / 400.0));
    if (outline.empty()) continue;
    const double shape_cost = std::min(cost(outline, kind), 6.0);
    const double score = candidate.agreement + candidate.contrast - 4.0 * candidate.frame_part - 0.25 * shape_cost;
    if (score > best_score) {
      best_score = score;
      chosen = &candidate;
    }
  }
  if (chosen == nullptr) return best;
  double closest = 0.0;
  for (const MaskCandidate& other : candidates) {
    if (&other != chosen) closest = std::max(closest, IntersectionOverUnion(chosen->mask, other.mask));
  }
  best.source = chosen->method;
  // Two methods that agree on 97 % are as sure as can be; below 70 % they mean different things.
  best.confidence = std::clamp((closest - 0.7) / 0.27, 0.0, 1.0) * (0.4 + 0.6 * chosen->contrast);
  best.coverage = RefineCoverage(rgb, chosen->mask);
  best.outline = TraceAtWorkingSize(best.coverage);
  if (best.outline.empty() || !HasLegs(kind)) return best;
  const cv::Mat opened = OpenNarrowGaps(rgb, best.coverage, HeightOf(best.outline), kGapDepth);
  if (opened.data == best.coverage.data) return best;
  const Polygon outline = TraceAtWorkingSize(opened);
  if (outline.empty() || SignedArea(outline) < 0.9 * SignedArea(best.outline)) return best;
  best.coverage = opened;
  best.outline = outline;
  return best;
}

Status Cropped() {
  return FailedPrecondition("GARMENT_CROPPED",
                            "the garment reaches the edge of the photograph; give one that shows all of it");
}

// A garment that is cut off by the frame is taken for background there, and the methods come to different ends; what is
// found of it then runs along the strip that GrabCut was told is background.
bool RunsAlongFrame(const Silhouette& silhouette, cv::Size size) {
  return FramePartOf(silhouette.outline, size, 0.035 * std::min(size.width, size.height)) > 0.04;
}

}  // namespace

Result<WorkingImage> LoadWorkingImage(std::string_view bytes) {
  ImageLimits limits;
  limits.min_side = kMinPhotoSide;
  FR_ASSIGN_OR_RETURN(Image photo, DecodeImage(bytes, limits));
  WorkingImage working;
  working.scale = std::min(1.0, kMaxWorkingSide / static_cast<double>(std::max(photo.width, photo.height)));
  cv::Mat scaled = ViewOf(photo);
  if (working.scale < 1.0) cv::resize(scaled, scaled, cv::Size(), working.scale, working.scale, cv::INTER_AREA);
  if (photo.channels == 4) {
    cv::extractChannel(scaled, working.alpha, 3);
    const double visible =
        static_cast<double>(cv::countNonZero(working.alpha >= 128)) / static_cast<double>(working.alpha.total());
    if (visible > 0.98) working.alpha.release();
  }
  working.rgb = ConvertChannels(ImageOf(scaled), 3);
  return working;
}

Silhouette FindSilhouette(const WorkingImage& image, GarmentKind kind, ShapeCost cost) {
  const cv::Mat rgb = ViewOf(image.rgb);
  Silhouette silhouette = image.alpha.empty() ? FromSegmentation(rgb, kind, cost) : FromAlpha(image.alpha);
  silhouette.frame_part = FramePartOf(silhouette.outline, rgb.size(), 2.5);
  return silhouette;
}

Status CheckSilhouette(const Silhouette& silhouette, cv::Size size) {
  const double area = silhouette.outline.empty() ? 0.0 : SignedArea(silhouette.outline);
  if (area < 0.02 * size.width * size.height) {
    return FailedPrecondition("NO_GARMENT_FOUND",
                              "no garment was found; photograph it flat on a plain ground of another colour, or give "
                              "an image with a transparent background");
  }
  if (silhouette.frame_part > kMaxOnFrame) return Cropped();
  if (silhouette.confidence < kLeastMaskConfidence && RunsAlongFrame(silhouette, size)) return Cropped();
  return {};
}

}  // namespace fitroom::shop_catalog
