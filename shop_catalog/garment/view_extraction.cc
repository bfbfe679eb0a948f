#include "shop_catalog/garment/view_extraction.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/imgproc.hpp>

#include "common/garment/validate.h"
#include "common/image/decode.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/kind_frame.h"
#include "shop_catalog/garment/neckline.h"
#include "shop_catalog/garment/outline.h"
#include "shop_catalog/garment/segmentation.h"
#include "shop_catalog/garment/top_corners.h"
#include "shop_catalog/garment/top_points.h"

namespace fitroom::shop_catalog {
namespace {

constexpr int kMaxWorkingSide = 2048;  // Of the working image (unit: pixel).
constexpr int kMinPhotoSide = 200;     // Below, a point is worth more than a centimetre (unit: pixel).
constexpr double kMaxOnFrame = 0.012;  // Part of the outline that may lie on the frame.
// Costs of the corner chain, per corner, seen on the external test photographs: T-shirts 0.2 to 2.5, others 3 and more.
constexpr double kGoodShape = 1.5;
constexpr double kDoubtfulShape = 2.6;
constexpr double kWrongShape = 3.6;
constexpr double kLeastChestOfLength = 0.46;  // Flat chest over length: T-shirts 0.5 to 0.9.
constexpr double kLeastMaskConfidence = 0.35;
constexpr double kLeastPointConfidence = 0.45;

struct WorkingImage {
  Image rgb;
  cv::Mat alpha;       // Empty where the photograph has none or it hides nothing.
  double scale = 1.0;  // Working pixels per pixel of the photograph.
};

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

// A mask with the outline and corners it leads to.
struct Silhouette {
  cv::Mat coverage;
  Polygon outline;
  std::optional<TopCorners> corners;
  double frame_part = 0.0;
  double confidence = 0.0;
  std::string source;
};

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
// frame and is shaped like a top.
Silhouette FromSegmentation(const cv::Mat& rgb) {
  Silhouette best;
  double best_score = -1e9;
  const MaskCandidate* chosen = nullptr;
  const auto looks_like_a_top = [](const MaskCandidate& candidate) {
    const Polygon outline = TraceOutline(candidate.mask, 2.5);
    return !outline.empty() && TopShapeCost(outline) < kGoodShape;
  };
  const std::vector<MaskCandidate> candidates = SegmentGarment(rgb, looks_like_a_top);
  for (const MaskCandidate& candidate : candidates) {
    const Polygon outline = TraceOutline(candidate.mask, 2.5 * std::max(1.0, std::max(rgb.cols, rgb.rows) / 400.0));
    if (outline.empty()) continue;
    const double shape_cost = std::min(TopShapeCost(outline), 6.0);
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

Status CheckShape(const Silhouette& silhouette, GarmentKind kind) {
  double cost = silhouette.corners ? silhouette.corners->cost : 1e9;
  if (cost < kDoubtfulShape) {
    const TopCorners& corners = *silhouette.corners;
    const double chest = (corners.pixel[kUnderarmLeft] - corners.pixel[kUnderarmRight]).norm();
    if (chest > kLeastChestOfLength * LengthInPixels(corners)) return {};
    cost = kWrongShape;  // A dress with short sleeves has all the corners of a T-shirt, but is longer.
  }
  const std::string name(GarmentKindName(kind));
  if (silhouette.confidence < kLeastMaskConfidence) {
    return FailedPrecondition("NO_GARMENT_FOUND", "nothing with the shape of a " + name +
                                                      " stands out from the background; photograph it flat on a plain "
                                                      "ground of another colour");
  }
  if (cost < kWrongShape) {
    return FailedPrecondition("LOW_CONFIDENCE", "the outline is only partly that of a " + name +
                                                    "; spread the sleeves, or give the points as an annotation");
  }
  return FailedPrecondition("WRONG_KIND", "what is photographed does not have the outline of a " + name +
                                              "; state its kind, or give the points as an annotation");
}

ViewConfidence RateView(const Silhouette& silhouette, const std::vector<OutlinePoint>& points) {
  ViewConfidence confidence;
  confidence.mask = silhouette.confidence;
  confidence.mask_source = silhouette.source;
  confidence.weakest = 1.0;
  for (const OutlinePoint& point : points) {
    confidence.points += point.confidence / static_cast<double>(points.size());
    if (point.confidence < confidence.weakest) {
      confidence.weakest = point.confidence;
      confidence.weakest_point = point.name;
    }
  }
  return confidence;
}

// Puts points given by hand into the view: scaled to the working image, the neckline drawn through the neck drop.
Status ApplyAnnotation(const std::vector<OutlinePoint>& annotation, double scale, const Polygon& silhouette,
                       GarmentKind kind, ViewExtraction& extraction) {
  GarmentView& view = extraction.view;
  view.points = annotation;
  for (OutlinePoint& point : view.points) point.pixel *= scale;
  FR_RETURN_IF_ERROR(ValidatePoints(kind, view));
  extraction.length_px = LengthInPixels(kind, view.points);
  if (!HasNeck(kind)) {
    view.outline = silhouette;
    return {};
  }
  const TopCorners corners = CornersOfPoints(view.points, view.side);
  Neckline neckline = SilhouetteNeckline(silhouette, corners);
  if (view.side == GarmentSide::kFront) {
    neckline.curve =
        NecklineThrough(corners.pixel[kNeckLeft], FindPoint(view, "neck_drop")->pixel, corners.pixel[kNeckRight]);
  }
  view.outline = JoinNeckline(silhouette, corners, neckline);
  if (view.outline.empty()) {
    return InvalidArgument("POINT_OFF_OUTLINE", "P1, P2 and neck_drop do not fit the garment's outline; check them");
  }
  return {};
}

Status ApplyDetection(const Silhouette& silhouette, GarmentKind kind, ViewExtraction& extraction) {
  FR_RETURN_IF_ERROR(CheckShape(silhouette, kind));
  const TopCorners& corners = *silhouette.corners;
  GarmentView& view = extraction.view;
  Neckline neckline = SilhouetteNeckline(silhouette.outline, corners);
  if (view.side == GarmentSide::kFront) {
    neckline = FindFrontNeckline(LabOf(ViewOf(extraction.photo)), silhouette.outline, corners);
  }
  view.outline = JoinNeckline(silhouette.outline, corners, neckline);
  if (view.outline.empty()) {
    neckline = SilhouetteNeckline(silhouette.outline, corners);
    neckline.confidence = 0.3;
    view.outline = silhouette.outline;
  }
  view.points = PlaceTopPoints(view.outline, corners, neckline, view.side);
  extraction.length_px = LengthInPixels(corners);
  return {};
}

Result<ViewExtraction> ExtractViewOrThrow(std::string_view photo_bytes, GarmentSide side, GarmentKind kind,
                                          const std::vector<OutlinePoint>& annotation) {
  FR_ASSIGN_OR_RETURN(WorkingImage working, LoadWorkingImage(photo_bytes));
  const cv::Mat rgb = ViewOf(working.rgb);
  Silhouette silhouette = working.alpha.empty() ? FromSegmentation(rgb) : FromAlpha(working.alpha);
  silhouette.frame_part = FramePartOf(silhouette.outline, rgb.size(), 2.5);
  FR_RETURN_IF_ERROR(CheckSilhouette(silhouette, rgb.size()));

  ViewExtraction extraction;
  extraction.photo = std::move(working.rgb);
  extraction.mask = ImageOf(cv::Mat(silhouette.coverage >= 128));
  extraction.view.side = side;
  extraction.view.image_width = extraction.photo.width;
  extraction.view.image_height = extraction.photo.height;
  if (!annotation.empty()) {
    FR_RETURN_IF_ERROR(ApplyAnnotation(annotation, working.scale, silhouette.outline, kind, extraction));
  } else {
    silhouette.corners = FindTopCorners(silhouette.outline);
    FR_RETURN_IF_ERROR(ApplyDetection(silhouette, kind, extraction));
  }
  extraction.confidence = RateView(silhouette, extraction.view.points);
  if (annotation.empty() &&
      (extraction.confidence.mask < kLeastMaskConfidence || extraction.confidence.points < kLeastPointConfidence)) {
    return FailedPrecondition("LOW_CONFIDENCE",
                              "the garment's edge is uncertain (mask " + std::to_string(extraction.confidence.mask) +
                                  ", points " + std::to_string(extraction.confidence.points) +
                                  " of 1); use a plainer background or give the points as an annotation");
  }
  return extraction;
}

}  // namespace

Result<ViewExtraction> ExtractView(std::string_view photo_bytes, GarmentSide side, GarmentKind kind,
                                   const std::vector<OutlinePoint>& annotation) {
  const char* place = side == GarmentSide::kFront ? "front photograph" : "back photograph";
  try {
    Result<ViewExtraction> extraction = ExtractViewOrThrow(photo_bytes, side, kind, annotation);
    if (!extraction.ok()) return extraction.status().At(place);
    return extraction;
  } catch (const cv::Exception& exception) {
    return Internal("IMAGE_PROCESSING_FAILED", "image processing failed: " + exception.err).At(place);
  }
}

}  // namespace fitroom::shop_catalog
