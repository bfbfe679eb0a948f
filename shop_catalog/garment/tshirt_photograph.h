#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/image/image.h"
#include "shop_catalog/garment/tshirt_shape.h"

namespace fitroom::shop_catalog {

// Two T-shirts that the project draws itself; neither bears anybody's mark.
enum class TShirtDesign {
  kHeather,  // Mottled cloth with an emblem on the chest and a bar on the back.
  kStriped,  // Cross stripes, a pocket on the wearer's left, a tab on the back.
};

// What a drawn photograph shows and how it was "taken".
struct TShirtPhotographOptions {
  TShirtMeasures measures;
  TShirtDesign design = TShirtDesign::kHeather;
  std::optional<std::array<uint8_t, 3>> colour;  // Of the cloth, RGB; absent: the design's own.
  int image_side = 1200;                         // 400 to 4000 (unit: pixel).
  uint64_t seed = 1;                             // Of folds, mottling and the lie of the garment.
};

// A drawn photograph and where its 22 points truly are (unit: pixel).
struct TShirtPhotograph {
  Image image;  // RGB.
  std::vector<OutlinePoint> points;
  double metre_per_pixel = 0.0;
};

// Draws one side of a T-shirt that lies flat on a plain ground, slightly turned; the front shows the inside of the back
// neck. INVALID_ARGUMENT as ValidateTShirtMeasures() returns it, or IMAGE_SIDE_OUT_OF_RANGE. The same input gives the
// same bytes.
Result<TShirtPhotograph> DrawTShirtPhotograph(GarmentSide side, const TShirtPhotographOptions& options);

// Returns the points of both sides as an annotation (see PointAnnotationFromJson()).
std::string AnnotationAsJson(const TShirtPhotograph& front, const TShirtPhotograph& back);

}  // namespace fitroom::shop_catalog
