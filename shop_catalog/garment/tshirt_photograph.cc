#include "shop_catalog/garment/tshirt_photograph.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/cloth_texture.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/tshirt_canvas.h"
#include "shop_catalog/garment/tshirt_design.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// The lie of the garment in the picture: front and back are taken apart, so they differ.
TShirtCanvas::Lie MakeLie(GarmentSide side, const TShirtPhotographOptions& options) {
  const bool is_front = side == GarmentSide::kFront;
  cv::RNG random(options.seed * 977 + (is_front ? 11 : 23));
  TShirtCanvas::Lie lie;
  lie.tilt = (is_front ? 0.035 : -0.028) + random.uniform(-0.012, 0.012);
  const double length_cm = 100.0 * options.measures.length;
  const double reach_cm = 100.0 * (0.5 * options.measures.chest + options.measures.sleeve) + 4.0;
  const double room = is_front ? 0.87 : 0.82;
  lie.pixels_per_cm = options.image_side * room / std::max(length_cm, 2.0 * reach_cm);
  lie.middle = options.image_side * Vector2d(0.5 + random.uniform(-0.012, 0.012), 0.5 + random.uniform(-0.012, 0.012));
  lie.flat_middle = Vector2d(0.0, 0.5 * length_cm);
  for (int i = 0; i < 2; ++i) {
    lie.crumple_phase[static_cast<size_t>(i)] = random.uniform(0.0, 6.28);
  }
  return lie;
}

// Folds as gravity and hands leave them on a table: from the underarms inwards, along the sleeves, up from the hem.
std::vector<Fold> MakeFolds(const TShirtShape& shape, uint64_t seed) {
  cv::RNG random(seed * 7919 + 3);
  const Vector2d underarm = shape.armhole.back();
  const double length = shape.hem.back().y();
  const auto sign = [&random] { return random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0; };
  std::vector<Fold> folds;
  const auto add = [&](const Vector2d& middle, double angle, double fold_length, double fold_width, double height) {
    folds.push_back({middle, Vector2d(std::cos(angle), std::sin(angle)), fold_length, fold_width, height});
  };
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 4; ++i) {
      const double angle = side * random.uniform(0.5, 1.25);
      const Vector2d start(side * (underarm.x() - random.uniform(2.5, 7.0)), underarm.y() + random.uniform(-3.0, 9.0));
      add(start, angle, random.uniform(4.0, 9.0), random.uniform(0.7, 1.5), sign() * random.uniform(0.15, 0.4));
    }
    for (int i = 0; i < 3; ++i) {
      const Vector2d middle = shape.armhole.front() + random.uniform(3.0, 15.0) * shape.sleeve_axis +
                              Vector2d(-2.0, random.uniform(2.0, 11.0));
      add({side * middle.x(), middle.y()}, side * random.uniform(0.3, 1.0), random.uniform(3.0, 6.0),
          random.uniform(0.6, 1.2), sign() * random.uniform(0.1, 0.28));
    }
  }
  for (int i = 0; i < 9; ++i) {
    const Vector2d middle(random.uniform(-0.85, 0.85) * underarm.x(), random.uniform(0.5, 0.97) * length);
    add(middle, random.uniform(1.0, 2.1), random.uniform(5.0, 13.0), random.uniform(0.9, 2.2),
        sign() * random.uniform(0.12, 0.36));
  }
  return folds;
}

}  // namespace

Result<TShirtPhotograph> DrawTShirtPhotograph(GarmentSide side, const TShirtPhotographOptions& options) {
  FR_RETURN_IF_ERROR(ValidateTShirtMeasures(options.measures));
  if (options.image_side < 400 || options.image_side > 4000) {
    return InvalidArgument("IMAGE_SIDE_OUT_OF_RANGE", "--image-side " + std::to_string(options.image_side) +
                                                          " is out of range: give 400 to 4000 pixels");
  }
  try {
    const TShirtShape shape = MakeTShirtShape(options.measures);
    const uint64_t seed = 2 * options.seed + (side == GarmentSide::kFront ? 0 : 1);
    TShirtCanvas canvas(options.image_side, MakeLie(side, options), seed);
    canvas.LayGround(Rgb(232, 229, 224));
    canvas.CastShadow(shape.outline);
    canvas.SetClip(shape.outline);
    canvas.SetFolds(MakeFolds(shape, seed));
    DrawTShirt(shape, side, options, canvas);
    TShirtPhotograph photograph;
    photograph.image = canvas.Develop();
    photograph.metre_per_pixel = 0.01 / canvas.lie().pixels_per_cm;
    for (const auto& [name, place] : PointsOnShape(shape, side)) {
      photograph.points.push_back({name, canvas.Pixel(place), 1.0});
    }
    return photograph;
  } catch (const cv::Exception& error) {
    return Internal("DRAWING_FAILED", error.what());
  }
}

std::string AnnotationAsJson(const TShirtPhotograph& front, const TShirtPhotograph& back) {
  nlohmann::ordered_json annotation;
  const auto put = [&annotation](const char* side, const TShirtPhotograph& photograph) {
    for (const OutlinePoint& point : photograph.points) {
      annotation[side][point.name] = {point.pixel.x(), point.pixel.y()};
    }
  };
  put("front", front);
  put("back", back);
  return annotation.dump(1) + "\n";
}

}  // namespace fitroom::shop_catalog
