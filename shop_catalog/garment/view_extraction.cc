#include "shop_catalog/garment/view_extraction.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/core.hpp>

#include "common/garment/validate.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/kind_frame.h"
#include "shop_catalog/garment/kind_points.h"
#include "shop_catalog/garment/kind_templates.h"
#include "shop_catalog/garment/neckline.h"
#include "shop_catalog/garment/shape_check.h"
#include "shop_catalog/garment/side_folded.h"
#include "shop_catalog/garment/silhouette.h"
#include "shop_catalog/garment/top_corners.h"
#include "shop_catalog/garment/top_points.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kLeastChestOfLength = 0.46;  // Flat chest over length: T-shirts 0.5 to 0.9.
constexpr double kLeastPointConfidence = 0.45;
constexpr double kWrong = 1e9;  // The cost of a shape that is not there.

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

double LengthOf(const ViewExtraction& extraction) {
  const GarmentView& view = extraction.view;
  return view.side == GarmentSide::kSideFolded ? SideFoldedLengthInPixels(view.points)
                                               : LengthInPixels(extraction.kind, view.points);
}

// Puts points given by hand into the view: scaled to the working image, the neckline drawn through the neck drop.
Status ApplyAnnotation(const std::vector<OutlinePoint>& annotation, double scale, const Polygon& silhouette,
                       ViewExtraction& extraction) {
  GarmentView& view = extraction.view;
  view.points = annotation;
  for (OutlinePoint& point : view.points) point.pixel *= scale;
  FR_RETURN_IF_ERROR(ValidatePoints(extraction.kind, view));
  if (!HasNeck(extraction.kind)) {
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

// A dress with short sleeves has all the corners of a T-shirt, but is longer.
double CostOfTop(GarmentKind kind, const std::optional<TopCorners>& corners) {
  if (!corners) return kWrong;
  const double chest = (corners->pixel[kUnderarmLeft] - corners->pixel[kUnderarmRight]).norm();
  if (!IsDress(kind) && chest <= kLeastChestOfLength * LengthInPixels(*corners)) return kWrong;
  return corners->cost;
}

Status DetectTop(const Silhouette& silhouette, double length, ViewExtraction& extraction) {
  GarmentView& view = extraction.view;
  extraction.kind = ResolveSleeves(silhouette.outline, extraction.kind);
  const std::optional<TopCorners> found = FindTopCorners(silhouette.outline, extraction.kind);
  FR_RETURN_IF_ERROR(CheckShape(silhouette, extraction.kind, CostOfTop(extraction.kind, found)));
  const TopCorners& corners = *found;
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
  view.points = IsDress(extraction.kind)
                    ? PlaceDressPoints(extraction.kind, view.outline, corners, neckline, view.side, length)
                    : PlaceTopPoints(view.outline, corners, neckline, view.side);
  return {};
}

Status DetectBottom(const Silhouette& silhouette, double length, ViewExtraction& extraction) {
  GarmentView& view = extraction.view;
  std::optional<CornerMatch> best;
  for (const CornerTemplate& candidate : TemplatesOf(extraction.kind)) {
    std::optional<CornerMatch> match = MatchCorners(silhouette.outline, candidate);
    if (match && (!best || match->cost < best->cost)) best = std::move(match);
  }
  FR_RETURN_IF_ERROR(CheckShape(silhouette, extraction.kind, best ? best->cost : kWrong));
  view.outline = silhouette.outline;
  view.points = PlaceBottomPoints(extraction.kind, view.outline, *best, view.side, length);
  return {};
}

Status DetectSideFolded(const Silhouette& silhouette, ViewExtraction& extraction) {
  constexpr double kNotFolded = 2.2;
  const std::optional<CornerMatch> match = FindSideFoldedCorners(silhouette.outline, extraction.kind);
  if (!match || match->cost > kNotFolded) {
    return FailedPrecondition("NOT_SIDE_FOLDED",
                              "the photograph does not show one leg laid over the other; lay the crotch out to the "
                              "image's left and the outseam to its right, or give the points as an annotation");
  }
  extraction.view.outline = silhouette.outline;
  extraction.view.points = PlaceSideFoldedPoints(silhouette.outline, *match);
  return {};
}

Status Detect(const Silhouette& silhouette, double length, ViewExtraction& extraction) {
  if (extraction.view.side == GarmentSide::kSideFolded) return DetectSideFolded(silhouette, extraction);
  return HasNeck(extraction.kind) ? DetectTop(silhouette, length, extraction)
                                  : DetectBottom(silhouette, length, extraction);
}

double SideFoldedCost(const Polygon& outline, GarmentKind kind) {
  const std::optional<CornerMatch> match = FindSideFoldedCorners(outline, kind);
  return match ? match->cost : kWrong;
}

Result<ViewExtraction> ExtractViewOrThrow(const ViewRequest& request) {
  FR_ASSIGN_OR_RETURN(WorkingImage working, LoadWorkingImage(request.photo));
  const bool is_folded = request.side == GarmentSide::kSideFolded;
  const Silhouette silhouette = FindSilhouette(working, request.kind, is_folded ? SideFoldedCost : ShapeCostOf);
  FR_RETURN_IF_ERROR(CheckSilhouette(silhouette, ViewOf(working.rgb).size()));

  ViewExtraction extraction;
  extraction.kind = request.kind;
  extraction.photo = std::move(working.rgb);
  extraction.mask = ImageOf(cv::Mat(silhouette.coverage >= 128));
  extraction.view.side = request.side;
  extraction.view.image_width = extraction.photo.width;
  extraction.view.image_height = extraction.photo.height;
  const bool is_given = request.annotation != nullptr && !request.annotation->empty();
  FR_RETURN_IF_ERROR(is_given ? ApplyAnnotation(*request.annotation, working.scale, silhouette.outline, extraction)
                              : Detect(silhouette, request.length, extraction));
  extraction.length_px = LengthOf(extraction);
  extraction.view.metre_per_pixel = request.length / extraction.length_px;
  extraction.confidence = RateView(silhouette, extraction.view.points);
  if (!is_given &&
      (extraction.confidence.mask < kLeastMaskConfidence || extraction.confidence.points < kLeastPointConfidence)) {
    return FailedPrecondition("LOW_CONFIDENCE",
                              "the garment's edge is uncertain (mask " + std::to_string(extraction.confidence.mask) +
                                  ", points " + std::to_string(extraction.confidence.points) +
                                  " of 1); use a plainer background or give the points as an annotation");
  }
  return extraction;
}

}  // namespace

Result<ViewExtraction> ExtractView(const ViewRequest& request) {
  const char* place = request.side == GarmentSide::kFront  ? "front photograph"
                      : request.side == GarmentSide::kBack ? "back photograph"
                                                           : "side-folded photograph";
  try {
    Result<ViewExtraction> extraction = ExtractViewOrThrow(request);
    if (!extraction.ok()) return extraction.status().At(place);
    return extraction;
  } catch (const cv::Exception& exception) {
    return Internal("IMAGE_PROCESSING_FAILED", "image processing failed: " + exception.err).At(place);
  }
}

}  // namespace fitroom::shop_catalog
