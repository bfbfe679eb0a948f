#include "shop_catalog/garment/garment_photograph.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/cloth_texture.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/garment_canvas.h"
#include "shop_catalog/garment/garment_design.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// A side-folded photograph is taken by itself, as front and back are.
enum class Shot { kFront, kBack, kSideFolded };

// The lie of the garment in the picture: the photographs are taken apart, so they differ.
GarmentCanvas::Lie MakeLie(Shot shot, const GarmentShape& shape, const PhotographOptions& options) {
  const bool is_front = shot == Shot::kFront;
  const uint64_t salt = is_front ? 11 : shot == Shot::kBack ? 23 : 37;
  cv::RNG random(options.seed * 977 + salt);
  GarmentCanvas::Lie lie;
  lie.tilt = (is_front ? 0.035 : -0.028) + random.uniform(-0.012, 0.012);
  Vector2d low = shape.outline.front(), high = low;
  for (const Vector2d& place : shape.outline) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double room = is_front ? 0.86 : 0.82;
  lie.pixels_per_cm = options.image_side * room / (1.0 + (high - low).maxCoeff());
  const double x = random.uniform(-0.012, 0.012), y = random.uniform(-0.012, 0.012);
  lie.middle = options.image_side * Vector2d(0.5 + x, 0.5 + y);
  lie.flat_middle = 0.5 * (low + high);
  for (double& phase : lie.crumple_phase) phase = random.uniform(0.0, 6.28);
  return lie;
}

Result<GarmentPhotograph> Draw(Shot shot, const PhotographOptions& options) {
  FR_RETURN_IF_ERROR(ValidateDrawnMeasures(options.kind, options.measures));
  if (options.image_side < 400 || options.image_side > 4000) {
    return InvalidArgument("IMAGE_SIDE_OUT_OF_RANGE", "--image-side " + std::to_string(options.image_side) +
                                                          " is out of range: give 400 to 4000 pixels");
  }
  try {
    const bool is_folded = shot == Shot::kSideFolded;
    const GarmentSide side = shot == Shot::kBack ? GarmentSide::kBack : GarmentSide::kFront;
    const GarmentShape shape = is_folded ? MakeSideFoldedShape(options.kind, options.measures)
                                         : MakeGarmentShape(options.kind, options.measures);
    const uint64_t seed = 2 * options.seed + static_cast<uint64_t>(shot);
    GarmentCanvas canvas(options.image_side, MakeLie(shot, shape, options), seed);
    canvas.LayGround(Rgb(232, 229, 224));
    canvas.CastShadow(shape.outline);
    canvas.SetClip(shape.outline);
    canvas.SetFolds(MakeFolds(shape, seed));
    if (is_folded) {
      DrawSideFolded(shape, options, canvas);
    } else {
      DrawGarment(shape, side, options, canvas);
    }
    GarmentPhotograph photograph;
    photograph.image = canvas.Develop();
    photograph.metre_per_pixel = 0.01 / canvas.lie().pixels_per_cm;
    for (const auto& [name, place] : is_folded ? shape.points : PointsOnShape(shape, side)) {
      photograph.points.push_back({name, canvas.Pixel(place), 1.0});
    }
    return photograph;
  } catch (const cv::Exception& error) {
    return Internal("DRAWING_FAILED", error.what());
  }
}

}  // namespace

Result<GarmentPhotograph> DrawGarmentPhotograph(GarmentSide side, const PhotographOptions& options) {
  return Draw(side == GarmentSide::kFront ? Shot::kFront : Shot::kBack, options);
}

Result<GarmentPhotograph> DrawSideFoldedPhotograph(const PhotographOptions& options) {
  if (!HasLegs(options.kind)) {
    return InvalidArgument("KIND_HAS_NO_LEGS", "only pants and shorts can be photographed side-folded; a " +
                                                   std::string(GarmentKindName(options.kind)) + " has no legs");
  }
  return Draw(Shot::kSideFolded, options);
}

std::string TruthAsJson(const DrawnTruth& truth) {
  nlohmann::ordered_json json;
  const auto put = [&json](const char* side, const GarmentPhotograph* photograph) {
    if (photograph == nullptr) return;
    for (const OutlinePoint& point : photograph->points) json[side][point.name] = {point.pixel.x(), point.pixel.y()};
  };
  put("front", truth.front);
  put("back", truth.back);
  put("side_folded", truth.side_folded);
  for (const GarmentMeasure& measure : truth.measures) {
    json["measures_cm"][measure.name] = std::round(measure.value * 1e5) / 1e3;
  }
  return json.dump(1) + "\n";
}

}  // namespace fitroom::shop_catalog
