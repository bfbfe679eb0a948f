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
  GarmentView view;  // Valid but for the scale, which LengthInPixels() decides, and the file names.
  Image photo;       // RGB, working size.
  Image mask;        // Grey, working size; 255 = garment, the visible inside of the back neck included.
  ViewConfidence confidence;
  double length_px = 0.0;  // Neck ends to hem (unit: pixel).
};

// Finds mask, outline and points in one photograph. `annotation` may be empty. Fails as ExtractGarment() does; never
// throws.
Result<ViewExtraction> ExtractView(std::string_view photo_bytes, GarmentSide side, GarmentKind kind,
                                   const std::vector<OutlinePoint>& annotation);

}  // namespace fitroom::shop_catalog
