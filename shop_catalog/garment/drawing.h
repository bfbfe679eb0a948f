#pragma once

#include "common/garment/garment.h"
#include "common/image/image.h"

namespace fitroom::shop_catalog {

// Draws what was found over the photographs (RGB, working size), front beside back: the outline, the named points,
// green where they are trusted over amber to red where they are not, and the measures below. `back_photo` and
// `side_folded_photo` may be null.
Image DrawExtraction(const Garment& garment, const Image& front_photo, const Image* back_photo,
                     const Image* side_folded_photo);

}  // namespace fitroom::shop_catalog
