#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "shop_catalog/garment/garment_canvas.h"
#include "shop_catalog/garment/garment_photograph.h"
#include "shop_catalog/garment/garment_shape.h"

namespace fitroom::shop_catalog {

// Returns folds as gravity and hands leave them on a table, by kind: from the underarms inwards and along the sleeves,
// from the crotch outwards, up from the hem.
std::vector<Fold> MakeFolds(const GarmentShape& shape, uint64_t seed);

// Draws one side of a garment on the canvas: panels, print, seams, stitches and whatever of the inside is seen.
void DrawGarment(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas);
// Draws trousers that lie side-folded.
void DrawSideFolded(const GarmentShape& shape, const PhotographOptions& options, GarmentCanvas& canvas);

// The parts of DrawGarment().
void DrawTop(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas);
void DrawDress(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas);
void DrawSkirt(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas);
void DrawTrousers(const GarmentShape& shape, GarmentSide side, const PhotographOptions& options, GarmentCanvas& canvas);

// Returns the colour that was asked for, or the design's own.
Rgb ColourOr(const PhotographOptions& options, const Rgb& own);
// Draws two rows of stitches along the inside of a curve that runs to the image's right, and the edge itself.
void DrawHem(const FlatCurve& edge, double height_cm, const Rgb& thread, GarmentCanvas& canvas);
// Draws what is seen of the back's inside through the neck: darker cloth, a facing, a plain label.
void DrawInsideOfNeck(const GarmentShape& shape, const Rgb& cloth, const Rgb& facing, double facing_cm, double mottle,
                      GarmentCanvas& canvas);

}  // namespace fitroom::shop_catalog
