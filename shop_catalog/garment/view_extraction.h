#pragma once

#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/image/image.h"
#include "shop_catalog/garment/extract_garment.h"

namespace fitroom::shop_catalog {

// One photograph's part of an extraction.
struct ViewExtraction {
  GarmentKind kind = GarmentKind::kTShirt;  // As stated, but a one_piece may turn out to have sleeves.
  GarmentView view;                         // Valid but for the file names.
  Image photo;                              // RGB, working size.
  Image mask;  // Grey, working size; 255 = garment, the visible inside of the back neck included.
  ViewConfidence confidence;
  double length_px = 0.0;  // Neck ends or waist to hem (unit: pixel).
};

// What is known before a photograph is looked at.
struct ViewRequest {
  std::string_view photo;
  GarmentSide side = GarmentSide::kFront;
  GarmentKind kind = GarmentKind::kTShirt;
  double length = 0.0;                                    // As stated (unit: metre).
  const std::vector<OutlinePoint>* annotation = nullptr;  // Null or empty: the points are to be found.
};

// Finds mask, outline, points and scale in one photograph. Fails as ExtractGarment() does; never throws.
Result<ViewExtraction> ExtractView(const ViewRequest& request);

}  // namespace fitroom::shop_catalog
