#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/image/encode.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/garment/garment_photograph.h"

// Photographs that the shop draws of every kind, from measures that are known, through the shop's extraction with
// points given by hand: both sides of the wire agree what a measure and a length are.

namespace fitroom {
namespace {

using shop_catalog::DrawGarmentPhotograph;
using shop_catalog::GarmentPhotograph;

class SynthesizedGarment : public ::testing::TestWithParam<GarmentKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, SynthesizedGarment,
                         ::testing::Values(GarmentKind::kTShirt, GarmentKind::kOnePiece, GarmentKind::kSleevedOnePiece,
                                           GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts),
                         [](const auto& kind) { return std::string(GarmentKindName(kind.param)); });

TEST_P(SynthesizedGarment, KeepsTheMeasuresThatItWasDrawnWith) {
  const GarmentKind kind = GetParam();
  shop_catalog::PhotographOptions options;
  options.kind = kind;
  options.image_side = 700;
  options.measures = shop_catalog::DrawnMeasures(kind, {}, {});
  const Result<GarmentPhotograph> front = DrawGarmentPhotograph(GarmentSide::kFront, options);
  options.seed = 2;
  const Result<GarmentPhotograph> back = DrawGarmentPhotograph(GarmentSide::kBack, options);
  ASSERT_TRUE(front.ok() && back.ok());
  const std::string front_png = EncodePng(front->image), back_png = EncodePng(back->image);
  PointAnnotation annotation;
  annotation.front = front->points;
  annotation.back = back->points;
  shop_catalog::ExtractionRequest request;
  request.id = "drawn";
  request.kind = kind;
  const std::string length_name = IsBottom(kind) ? "length" : "front_length";
  request.length = MeasureValue(options.measures, length_name);
  request.front_photo = front_png;
  request.back_photo = back_png;
  request.annotation = &annotation;
  const Result<shop_catalog::GarmentExtraction> extraction = shop_catalog::ExtractGarment(request);
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();

  const Result<GarmentPattern> pattern = ReconcileViews(extraction->garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  EXPECT_FALSE(pattern->asymmetric_by_design);
  for (const GarmentMeasure& measure : MeasurePattern(*pattern)) {
    // A chart's rises and thigh follow the fork, which folding hides; the drawing's inseam runs upright, ours along the
    // seam, and its lengths of a top end at the hem's corners.
    const bool other = measure.name == "inseam" || measure.name.ends_with("_length");
    if (other || measure.provenance == Provenance::kUnknown) continue;
    const double truth = MeasureValue(options.measures, measure.name);
    // The drawing rounds its bends by up to 1 %, and a mask's edge is known to a pixel and a half on both sides.
    EXPECT_NEAR(measure.value, truth, 0.015 * truth + 3.0 * front->metre_per_pixel) << measure.name;
  }
  for (const double pitch : {0.02, 0.01, 0.005}) {
    const Result<ClothMesh> mesh = MeshPattern(*pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    EXPECT_EQ(ComputeEulerCharacteristic(*mesh), ExpectedEulerCharacteristic(kind));
  }
}

}  // namespace
}  // namespace fitroom
