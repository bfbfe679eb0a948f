#pragma once

#include "common/garment/garment.h"
#include "shop_catalog/garment/tshirt_canvas.h"
#include "shop_catalog/garment/tshirt_photograph.h"
#include "shop_catalog/garment/tshirt_shape.h"

namespace fitroom::shop_catalog {

// Draws one side of the T-shirt on the canvas: inside of the back neck, panels, print, rib, seams and stitches.
void DrawTShirt(const TShirtShape& shape, GarmentSide side, const TShirtPhotographOptions& options,
                TShirtCanvas& canvas);

}  // namespace fitroom::shop_catalog
