#pragma once

#include "common/garment/polygon.h"
#include "common/image/image.h"

namespace fitroom::shop_catalog {

// Returns the photograph (RGB) with the garment's colours carried on beyond its outline over the whole picture, so that
// a seam or an edge can never show background. Colours within `edge` of the outline are replaced too: there the
// photograph's pixels are a mixture with the background (unit: pixel). So are gaps of background too narrow for the
// outline, for example between sleeve and body; they are looked for from the edge of `silhouette` (grey, 255 =
// garment), which on a front view is not the outline: above the neckline lies cloth, not background.
Image CarryColoursOn(const Image& photograph, const Image& silhouette, const Polygon& outline, int edge);

}  // namespace fitroom::shop_catalog
