#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/image/image.h"

namespace fitroom::shop_catalog {

// Shirts come in two designs; the other kinds have one each. None bears anybody's mark.
enum class TopDesign {
  kHeather,  // Mottled cloth with an emblem on the chest and a bar on the back.
  kStriped,  // Cross stripes, a pocket on the wearer's left, a tab on the back.
};

// What a drawn photograph shows and how it was "taken".
struct PhotographOptions {
  GarmentKind kind = GarmentKind::kTShirt;
  std::vector<GarmentMeasure> measures;  // Flat, all of MeasureNames(kind): see DrawnMeasures().
  TopDesign design = TopDesign::kHeather;
  std::optional<std::array<uint8_t, 3>> colour;  // Of the cloth, RGB; absent: the design's own.
  int image_side = 1200;                         // 400 to 4000 (unit: pixel).
  uint64_t seed = 1;                             // Of folds, mottling and the lie of the garment.
};

// A drawn photograph and where its points truly are (unit: pixel).
struct GarmentPhotograph {
  Image image;  // RGB.
  std::vector<OutlinePoint> points;
  double metre_per_pixel = 0.0;
};

// Draws one side of a garment that lies flat on a plain ground, slightly turned; where there is a neck, the front shows
// the inside of the back's. INVALID_ARGUMENT as ValidateDrawnMeasures() returns it, or IMAGE_SIDE_OUT_OF_RANGE. The
// same input gives the same bytes.
Result<GarmentPhotograph> DrawGarmentPhotograph(GarmentSide side, const PhotographOptions& options);

// Draws trousers or shorts with one leg laid over the other: see MakeSideFoldedShape(). Fails as above, and with
// INVALID_ARGUMENT KIND_HAS_NO_LEGS.
Result<GarmentPhotograph> DrawSideFoldedPhotograph(const PhotographOptions& options);

// What is known about a drawn garment.
struct DrawnTruth {
  const GarmentPhotograph* front = nullptr;
  const GarmentPhotograph* back = nullptr;
  const GarmentPhotograph* side_folded = nullptr;  // May be null.
  std::vector<GarmentMeasure> measures;            // Of the true garment, also what folding hides.
};

// Returns the points as an annotation (see PointAnnotationFromJson()), with the measures beside them.
std::string TruthAsJson(const DrawnTruth& truth);

}  // namespace fitroom::shop_catalog
