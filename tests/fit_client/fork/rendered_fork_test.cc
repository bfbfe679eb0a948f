#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/image/encode.h"
#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/fork/fork_mesh.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/garment/garment_photograph.h"

// Row S46 of the method, from pixels: trousers of known measures are drawn folded, front, back and side-folded, with
// folds, ground and grain; what the shop finds in the pictures is all that the fork is rebuilt from.

namespace fitroom {
namespace {

using shop_catalog::DrawGarmentPhotograph;
using shop_catalog::DrawSideFoldedPhotograph;
using shop_catalog::ExtractionRequest;
using shop_catalog::GarmentPhotograph;

struct Rendered {
  shop_catalog::ForkRule drawn;
  ForkRule ruled;
  const char* name;
};
constexpr Rendered kRendered[] = {{shop_catalog::ForkRule::kClose, ForkRule::kClose, "close"},
                                  {shop_catalog::ForkRule::kTrouser, ForkRule::kTrouser, "trouser"},
                                  {shop_catalog::ForkRule::kClassic, ForkRule::kAldrich, "classic"}};

Result<Garment> Photographed(const GarmentSize& size, uint64_t seed) {
  shop_catalog::PhotographOptions options;
  options.kind = GarmentKind::kPants;
  options.measures = size.measures;
  options.seed = seed;
  FR_ASSIGN_OR_RETURN(const GarmentPhotograph front, DrawGarmentPhotograph(GarmentSide::kFront, options));
  FR_ASSIGN_OR_RETURN(const GarmentPhotograph back, DrawGarmentPhotograph(GarmentSide::kBack, options));
  FR_ASSIGN_OR_RETURN(const GarmentPhotograph side, DrawSideFoldedPhotograph(options));
  const std::string front_png = EncodePng(front.image), back_png = EncodePng(back.image),
                    side_png = EncodePng(side.image);
  ExtractionRequest request;
  request.id = "rendered-trousers";
  request.kind = GarmentKind::kPants;
  request.length = FindMeasure(size.measures, "length")->value;
  request.front_photo = front_png;
  request.back_photo = back_png;
  request.side_folded_photo = side_png;
  FR_ASSIGN_OR_RETURN(shop_catalog::GarmentExtraction extraction, shop_catalog::ExtractGarment(request));
  return std::move(extraction.garment);
}

double ValueOf(const std::vector<GarmentMeasure>& measures, const std::string& name) {
  return FindMeasure(measures, name)->value;
}

TEST(RenderedFork, S46IsRebuiltFromPictures) {
  std::printf("%-8s %4s %-8s  error of hip girth, thigh girth, crotch length (mm)\n", "drawn", "size", "evidence");
  for (const Rendered& rule : kRendered) {
    for (const char* size_name : {"8", "16"}) {
      const Result<SizeChart> chart = shop_catalog::DrawnSizeChart(GarmentKind::kPants, size_name, rule.drawn);
      ASSERT_TRUE(chart.ok()) << chart.status().ToString();
      const GarmentSize& truth = *FindSize(*chart, size_name);
      const Result<Garment> garment = Photographed(truth, 5);
      ASSERT_TRUE(garment.ok()) << garment.status().ToString();
      const Result<GarmentPattern> pattern = ReconcileViews(*garment);
      ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
      for (const std::string kind : {"stated", "side", "rule"}) {
        ForkEvidence evidence;
        if (kind == "side") evidence.side_folded = garment->side_folded;
        if (kind == "rule") evidence.rule = rule.ruled;
        if (kind == "stated") {
          evidence.front_rise = ValueOf(truth.measures, "front_rise");
          evidence.back_rise = ValueOf(truth.measures, "back_rise");
          evidence.thigh_width = ValueOf(truth.measures, "thigh_width");
        }
        const Result<ForkedPattern> forked = BuildFork(*pattern, evidence);
        ASSERT_TRUE(forked.ok()) << kind << " " << forked.status().ToString();
        const double hip = 2000.0 * (ValueOf(forked->measures, "hip_width") - ValueOf(truth.measures, "hip_width"));
        const double thigh =
            2000.0 * (ValueOf(forked->measures, "thigh_width") - ValueOf(truth.measures, "thigh_width"));
        const double crotch = 1000.0 * (ValueOf(forked->measures, "crotch_length") -
                                        ValueOf(truth.measures, "front_rise") - ValueOf(truth.measures, "back_rise"));
        std::printf("%-8s %4s %-8s  %6.1f %6.1f %6.1f\n", rule.name, size_name, kind.c_str(), hip, thigh, crotch);
        const double allowed = kind == "rule" ? 25.0 : 10.0;
        EXPECT_LE(std::abs(hip), 5.0) << rule.name << " " << kind;
        EXPECT_LE(std::abs(thigh), allowed) << rule.name << " " << kind;
        EXPECT_LE(std::abs(crotch), allowed) << rule.name << " " << kind;
        const Provenance expected =
            kind == "rule" ? Provenance::kRuled : (kind == "side" ? Provenance::kMeasured : Provenance::kStated);
        EXPECT_EQ(FindMeasure(forked->measures, "thigh_width")->provenance, expected);
        const Result<ClothMesh> mesh = MeshFork(*forked, 0.02);
        ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
        EXPECT_EQ(ComputeEulerCharacteristic(*mesh), -1);
      }
    }
  }
}

}  // namespace
}  // namespace fitroom
