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
#include "shop_catalog/garment/side_folded.h"
#include "shop_catalog/garment/texture.h"
#include "shop_catalog/garment/view_extraction.h"

namespace fitroom::shop_catalog {
namespace {

constexpr double kMaxViewMismatch = 0.25;   // Front against back, part of the larger.
constexpr double kMaxChartMismatch = 0.30;  // Chart against photograph, part of the larger.

std::string Centimetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f cm", length * 100.0);
  return text;
}

Status CheckStatement(const ExtractionRequest& request) {
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
  if (!request.side_folded_photo.empty() && !HasLegs(request.kind)) {
    return InvalidArgument("SIDE_FOLDED_WITHOUT_LEGS", "a side-folded photograph can only be given of pants or shorts");
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
  const std::string base(GarmentSideName(view.side));
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

// What the shop states stands in for what folding hides; where both are known they must not contradict each other.
Status TakeStatement(const ExtractionRequest& request, Garment& garment) {
  if (request.statement == nullptr) return {};
  const std::vector<GarmentMeasure> found = garment.measures;
  ApplyShopStatement(*request.statement, garment);
  const GarmentSize* size = FindSize(garment.chart, garment.chart.photographed_size);
  if (size == nullptr) return {};
  for (const GarmentMeasure& stated : size->measures) {
    const GarmentMeasure* seen = FindMeasure(found, stated.name);
    if (seen != nullptr && seen->provenance == Provenance::kMeasured && seen->value > 0.0 &&
        std::abs(seen->value - stated.value) > kMaxChartMismatch * std::max(seen->value, stated.value)) {
      return FailedPrecondition("CHART_DOES_NOT_MATCH", "the chart's " + stated.name + " of size " + size->name + ", " +
                                                            Centimetres(stated.value) +
                                                            ", is not what the photographs show (" +
                                                            Centimetres(seen->value) +
                                                            "); widths are flat, half a girth; check the chart, the "
                                                            "photographed size and the length");
    }
    // What neither photographs nor tape gave, the chart's row does.
    for (GarmentMeasure& measure : garment.measures) {
      if (measure.name == stated.name && measure.provenance == Provenance::kUnknown) {
        measure = {stated.name, stated.value, Provenance::kStated};
      }
    }
  }
  return {};
}

Result<GarmentExtraction> ExtractOrThrow(const ExtractionRequest& request) {
  FR_RETURN_IF_ERROR(CheckStatement(request));
  const PointAnnotation* given = request.annotation;
  ViewRequest wanted = {request.front_photo, GarmentSide::kFront, request.kind, request.length,
                        given != nullptr ? &given->front : nullptr};
  FR_ASSIGN_OR_RETURN(ViewExtraction front, ExtractView(wanted));
  FR_RETURN_IF_ERROR(Cancelled(request));
  wanted.kind = front.kind;
  std::optional<ViewExtraction> back, side_folded;
  if (!request.back_photo.empty()) {
    wanted.photo = request.back_photo;
    wanted.side = GarmentSide::kBack;
    wanted.annotation = given != nullptr ? &given->back : nullptr;
    FR_ASSIGN_OR_RETURN(back, ExtractView(wanted));
    FR_RETURN_IF_ERROR(CheckViewsMatch(front.kind, front.view, back->view));
    FR_RETURN_IF_ERROR(Cancelled(request));
  }
  if (!request.side_folded_photo.empty()) {
    wanted.photo = request.side_folded_photo;
    wanted.side = GarmentSide::kSideFolded;
    wanted.annotation = given != nullptr ? &given->side_folded : nullptr;
    FR_ASSIGN_OR_RETURN(side_folded, ExtractView(wanted));
    FR_RETURN_IF_ERROR(Cancelled(request));
  }

  GarmentExtraction result;
  AddFiles(request.front_photo, front, result.files);
  if (back) AddFiles(request.back_photo, *back, result.files);
  if (side_folded) AddFiles(request.side_folded_photo, *side_folded, result.files);
  FR_RETURN_IF_ERROR(Cancelled(request));
  Garment& garment = result.garment;
  garment.id = request.id;
  garment.title = request.title;
  garment.kind = front.kind;
  garment.length = request.length;
  garment.measures = MeasureGarment(front.kind, front.view, back ? &back->view : nullptr);
  garment.front = std::move(front.view);
  result.front = front.confidence;
  if (back) {
    garment.back = std::move(back->view);
    result.back = back->confidence;
  }
  if (side_folded) {
    MeasureSideFolded(side_folded->view, garment.measures);
    garment.side_folded = std::move(side_folded->view);
    result.side_folded = side_folded->confidence;
  }
  FR_RETURN_IF_ERROR(TakeStatement(request, garment));
  const Status valid = ValidateGarment(garment);
  if (!valid.ok() && request.annotation == nullptr && valid.reason().starts_with("POINT")) {
    return FailedPrecondition("LOW_CONFIDENCE", "the points found contradict each other (" + valid.message() +
                                                    "); spread the garment flat or give the points as an annotation");
  }
  FR_RETURN_IF_ERROR(valid);
  result.files.push_back(
      {"extraction.png", EncodePng(DrawExtraction(garment, front.photo, back ? &back->photo : nullptr,
                                                  side_folded ? &side_folded->photo : nullptr))});
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
