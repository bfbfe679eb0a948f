#include "shop_catalog/garment/extract_garment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <opencv2/core.hpp>

#include "common/garment/validate.h"
#include "common/image/decode.h"
#include "common/image/encode.h"
#include "shop_catalog/garment/drawing.h"
#include "shop_catalog/garment/kind_frame.h"
#include "shop_catalog/garment/measures.h"
#include "shop_catalog/garment/texture.h"
#include "shop_catalog/garment/view_extraction.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kMaxViewMismatch = 0.25;  // Front against back, part of the larger.

std::string Centimetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f cm", length * 100.0);
  return text;
}

Status CheckStatement(const ExtractionRequest& request) {
  if (request.kind != GarmentKind::kTShirt && request.annotation == nullptr) {
    return Status(StatusCode::kUnimplemented, "KIND_NOT_SUPPORTED",
                  "the points of a " + std::string(GarmentKindName(request.kind)) +
                      " are not detected yet; give them as an annotation");
  }
  const KindEnds& ends = EndsOf(request.kind);
  const std::string from_to = "from the " + std::string(ends.upper) + " to the " + std::string(ends.lower);
  if (request.length == 0.0) {
    return InvalidArgument("LENGTH_MISSING", "the garment's length is missing; state it in cm, " + from_to);
  }
  const LengthRange range = LengthRangeOf(request.kind);
  if (!(request.length >= range.least && request.length <= range.most)) {
    return InvalidArgument("LENGTH_OUT_OF_RANGE",
                           "a length of " + Centimetres(request.length) + " cannot be that of a " +
                               std::string(GarmentKindName(request.kind)) + " (" + Centimetres(range.least) + " to " +
                               Centimetres(range.most) + "); measure " + from_to);
  }
  if (request.front_photo.empty()) {
    return InvalidArgument("PHOTO_MISSING", "the front photograph is missing");
  }
  return {};
}

Status Cancelled(const ExtractionRequest& request) {
  if (!request.is_cancelled || !request.is_cancelled()) return {};
  return Status(StatusCode::kCancelled, "CANCELLED", "the extraction was cancelled");
}

// Both views were scaled by the same stated length, so their widths must agree as well.
Status CheckViewsMatch(GarmentKind kind, const GarmentView& front, const GarmentView& back) {
  const auto distance = [](const GarmentView& view, const char* a, const char* b) {
    return (FindPoint(view, a)->pixel - FindPoint(view, b)->pixel).norm() * view.metre_per_pixel;
  };
  using Width = std::array<const char*, 3>;
  static const std::vector<Width> kTop = {{"hem_L", "hem_R", "hem"}, {"underarm_L", "underarm_R", "chest"}};
  static const std::vector<Width> kBottom = {{"e1", "e3", "waist"}, {"hip_L", "hip_R", "hip"}};
  for (const auto& [a, b, name] : IsBottom(kind) ? kBottom : kTop) {
    const double width_front = distance(front, a, b);
    const double width_back = distance(back, a, b);
    if (std::abs(width_front - width_back) > kMaxViewMismatch * std::max(width_front, width_back)) {
      return FailedPrecondition("VIEWS_DO_NOT_MATCH", std::string("front and back are not the same garment: the ") +
                                                          name + " measures " + Centimetres(width_front) +
                                                          " on the front and " + Centimetres(width_back) +
                                                          " on the back; give two photographs of one garment");
    }
  }
  return {};
}

// Names the view's files and adds them to the extraction.
void AddFiles(std::string_view photo_bytes, ViewExtraction& extraction, std::vector<GarmentFile>& files) {
  GarmentView& view = extraction.view;
  const std::string base = view.side == GarmentSide::kFront ? "front" : "back";
  const Result<ImageHeader> header = ReadImageHeader(photo_bytes);
  FR_CHECK(header.ok());  // It has been decoded before.
  view.photo_file = base + "." + std::string(ImageFormatExtension(header->format));
  view.mask_file = base + "_mask.png";
  view.texture_file = base + "_texture.png";
  const int edge = std::max(2, static_cast<int>(std::lround(extraction.length_px / 260.0)));
  files.push_back({view.photo_file, std::string(photo_bytes)});
  files.push_back({view.mask_file, EncodePng(extraction.mask)});
  files.push_back(
      {view.texture_file, EncodePng(CarryColoursOn(extraction.photo, extraction.mask, view.outline, edge))});
}

Result<GarmentExtraction> ExtractOrThrow(const ExtractionRequest& request) {
  FR_RETURN_IF_ERROR(CheckStatement(request));
  static const std::vector<OutlinePoint> kNoPoints;
  const auto& front_points = request.annotation != nullptr ? request.annotation->front : kNoPoints;
  const auto& back_points = request.annotation != nullptr ? request.annotation->back : kNoPoints;
  FR_ASSIGN_OR_RETURN(ViewExtraction front,
                      ExtractView(request.front_photo, GarmentSide::kFront, request.kind, front_points));
  FR_RETURN_IF_ERROR(Cancelled(request));
  front.view.metre_per_pixel = request.length / front.length_px;
  std::optional<ViewExtraction> back;
  if (!request.back_photo.empty()) {
    FR_ASSIGN_OR_RETURN(back, ExtractView(request.back_photo, GarmentSide::kBack, request.kind, back_points));
    back->view.metre_per_pixel = request.length / back->length_px;
    FR_RETURN_IF_ERROR(CheckViewsMatch(request.kind, front.view, back->view));
    FR_RETURN_IF_ERROR(Cancelled(request));
  }

  GarmentExtraction result;
  AddFiles(request.front_photo, front, result.files);
  if (back) AddFiles(request.back_photo, *back, result.files);
  FR_RETURN_IF_ERROR(Cancelled(request));
  Garment& garment = result.garment;
  garment.id = request.id;
  garment.title = request.title;
  garment.kind = request.kind;
  garment.length = request.length;
  garment.measures = MeasureGarment(request.kind, front.view, back ? &back->view : nullptr);
  garment.front = std::move(front.view);
  result.front = front.confidence;
  if (back) {
    garment.back = std::move(back->view);
    result.back = back->confidence;
  }
  const Status valid = ValidateGarment(garment);
  if (!valid.ok() && request.annotation == nullptr && valid.reason().starts_with("POINT")) {
    return FailedPrecondition("LOW_CONFIDENCE", "the points found contradict each other (" + valid.message() +
                                                    "); spread the garment flat or give the points as an annotation");
  }
  FR_RETURN_IF_ERROR(valid);
  result.files.push_back(
      {"extraction.png", EncodePng(DrawExtraction(garment, front.photo, back ? &back->photo : nullptr))});
  return result;
}

}  // namespace

Result<GarmentExtraction> ExtractGarment(const ExtractionRequest& request) {
  try {
    return ExtractOrThrow(request);
  } catch (const cv::Exception& exception) {
    return Internal("IMAGE_PROCESSING_FAILED", "image processing failed: " + exception.err);
  }
}

}  // namespace fitroom::shop_catalog
