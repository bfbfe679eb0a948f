// Drawn garments of every kind: the drawing knows the truth, extraction knows nothing of how the picture was made.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/garment/garment_json.h"
#include "common/garment/size_chart_file.h"
#include "common/image/encode.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/garment/fork_draft.h"
#include "shop_catalog/garment/garment_photograph.h"

namespace fitroom::shop_catalog {
namespace {

constexpr GarmentKind kAllKinds[] = {GarmentKind::kTShirt,          GarmentKind::kLongSleeve, GarmentKind::kOnePiece,
                                     GarmentKind::kSleevedOnePiece, GarmentKind::kSkirt,      GarmentKind::kPants,
                                     GarmentKind::kShorts};

PhotographOptions OptionsOf(GarmentKind kind) {
  PhotographOptions options;
  options.kind = kind;
  options.measures = DrawnMeasures(kind, BodyGirths(), ForkRule::kTrouser);
  options.image_side = 700;
  return options;
}

double Measure(const std::vector<GarmentMeasure>& measures, const char* name) {
  const GarmentMeasure* measure = FindMeasure(measures, name);
  EXPECT_NE(measure, nullptr) << name;
  return measure == nullptr ? 0.0 : measure->value;
}

double LengthOf(const PhotographOptions& options) {
  return Measure(options.measures, IsBottom(options.kind) ? "length" : "front_length");
}

// A photograph with its bytes, and a request for its extraction.
struct Shot {
  GarmentPhotograph photograph;
  std::string bytes;
};

Shot Draw(const PhotographOptions& options, GarmentSide side) {
  Result<GarmentPhotograph> drawn =
      side == GarmentSide::kSideFolded ? DrawSideFoldedPhotograph(options) : DrawGarmentPhotograph(side, options);
  EXPECT_TRUE(drawn.ok()) << drawn.status().ToString();
  std::string bytes = EncodePng(drawn->image);
  return {std::move(drawn).value(), std::move(bytes)};
}

ExtractionRequest RequestFor(const PhotographOptions& options, const Shot& front) {
  ExtractionRequest request;
  request.id = "drawn";
  request.kind = options.kind;
  request.length = LengthOf(options);
  request.front_photo = front.bytes;
  return request;
}

class DrawnKind : public ::testing::TestWithParam<GarmentKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, DrawnKind, ::testing::ValuesIn(kAllKinds),
                         [](const auto& tested) { return std::string(GarmentKindName(tested.param)); });

// Extraction comes within 2 cm of the corners and 3.5 cm of points that are defined by a part of the way; the measures
// are those that the garment was cut to, to 1.2 cm.
TEST_P(DrawnKind, ExtractionFindsTheTruth) {
  const PhotographOptions options = OptionsOf(GetParam());
  const Shot front = Draw(options, GarmentSide::kFront);
  const Result<GarmentExtraction> extraction = ExtractGarment(RequestFor(options, front));
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  EXPECT_EQ(extraction->garment.kind, GetParam());
  EXPECT_NEAR(extraction->garment.front.metre_per_pixel / front.photograph.metre_per_pixel, 1.0, 0.012);
  for (const OutlinePoint& truth : front.photograph.points) {
    const OutlinePoint* found = FindPoint(extraction->garment.front, truth.name);
    ASSERT_NE(found, nullptr) << truth.name;
    EXPECT_LT(front.photograph.metre_per_pixel * (found->pixel - truth.pixel).norm(), 0.035) << truth.name;
  }
  for (const char* name : {"waist_width", "hip_width", "hem_width", "chest_width", "knee_width"}) {
    if (FindMeasure(options.measures, name) == nullptr) continue;
    EXPECT_NEAR(Measure(extraction->garment.measures, name), Measure(options.measures, name), 0.012) << name;
  }
}

// Folding hides rises and thigh: they are said to be unknown, not guessed.
TEST(DrawnKinds, WhatFoldingHidesIsUnknownUntilItIsStated) {
  const PhotographOptions options = OptionsOf(GarmentKind::kPants);
  const Shot front = Draw(options, GarmentSide::kFront);
  ExtractionRequest request = RequestFor(options, front);
  const Result<GarmentExtraction> bare = ExtractGarment(request);
  ASSERT_TRUE(bare.ok()) << bare.status().ToString();
  for (const char* name : {"front_rise", "back_rise", "thigh_width"}) {
    EXPECT_EQ(FindMeasure(bare->garment.measures, name)->provenance, Provenance::kUnknown) << name;
  }
  ShopStatement statement;
  const Result<SizeChart> chart = DrawnSizeChart(options.kind, "12", ForkRule::kTrouser);
  ASSERT_TRUE(chart.ok());
  statement.chart = *chart;
  statement.fabric = "denim";
  request.statement = &statement;
  const Result<GarmentExtraction> stated = ExtractGarment(request);
  ASSERT_TRUE(stated.ok()) << stated.status().ToString();
  EXPECT_EQ(stated->garment.fabric, "denim");
  for (const char* name : {"front_rise", "back_rise", "thigh_width"}) {
    EXPECT_EQ(FindMeasure(stated->garment.measures, name)->provenance, Provenance::kStated) << name;
    EXPECT_NEAR(Measure(stated->garment.measures, name), Measure(options.measures, name), 1e-9) << name;
  }
  // A chart of full girths instead of flat widths contradicts the photograph.
  for (GarmentSize& size : statement.chart.sizes) {
    for (GarmentMeasure& measure : size.measures) {
      if (measure.name == "waist_width") measure.value *= 1.7;
    }
  }
  EXPECT_EQ(ExtractGarment(request).status().reason(), "CHART_DOES_NOT_MATCH");
}

// S46: with the side-folded photograph the fork is measured.
TEST(DrawnKinds, TheSideFoldedPhotographShowsThighAndRises) {
  PhotographOptions options = OptionsOf(GarmentKind::kPants);
  options.measures = DrawnMeasures(options.kind, BodyGirths(), ForkRule::kClassic);
  const Shot front = Draw(options, GarmentSide::kFront), folded = Draw(options, GarmentSide::kSideFolded);
  ExtractionRequest request = RequestFor(options, front);
  request.side_folded_photo = folded.bytes;
  const Result<GarmentExtraction> extraction = ExtractGarment(request);
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  const auto& found = extraction->garment.measures;
  EXPECT_NEAR(Measure(found, "thigh_width"), Measure(options.measures, "thigh_width"), 0.005);
  EXPECT_NEAR(Measure(found, "front_rise") + Measure(found, "back_rise"),
              Measure(options.measures, "front_rise") + Measure(options.measures, "back_rise"), 0.012);
  EXPECT_NEAR(Measure(found, "back_rise"), Measure(options.measures, "back_rise"), 0.012);
  EXPECT_EQ(FindMeasure(found, "thigh_width")->provenance, Provenance::kMeasured);
  ASSERT_TRUE(extraction->garment.side_folded.has_value());
  // A front photograph is not a side-folded one.
  request.side_folded_photo = front.bytes;
  EXPECT_EQ(ExtractGarment(request).status().reason(), "NOT_SIDE_FOLDED");
}

TEST(DrawnKinds, AOnePieceDecidesByItselfWhetherItHasSleeves) {
  const PhotographOptions options = OptionsOf(GarmentKind::kSleevedOnePiece);
  const Shot front = Draw(options, GarmentSide::kFront);
  ExtractionRequest request = RequestFor(options, front);
  request.kind = GarmentKind::kOnePiece;
  const Result<GarmentExtraction> extraction = ExtractGarment(request);
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  EXPECT_EQ(extraction->garment.kind, GarmentKind::kSleevedOnePiece);
}

TEST(DrawnKinds, TheWrongKindIsRefusedWithWhatItLooksLike) {
  const auto refused = [](GarmentKind drawn, GarmentKind stated, const char* looks_like) {
    const PhotographOptions options = OptionsOf(drawn);
    const Shot front = Draw(options, GarmentSide::kFront);
    ExtractionRequest request = RequestFor(options, front);
    request.kind = stated;
    const Status status = ExtractGarment(request).status();
    EXPECT_EQ(status.reason(), "WRONG_KIND") << status.ToString();
    EXPECT_THAT(status.message(), ::testing::HasSubstr(looks_like));
  };
  refused(GarmentKind::kPants, GarmentKind::kTShirt, "looks like pants");
  refused(GarmentKind::kSkirt, GarmentKind::kOnePiece, "looks like skirt");
}

TEST(DrawnKinds, TruthIsAnAnnotationAndTheChartIsValid) {
  for (const GarmentKind kind : kAllKinds) {
    const PhotographOptions options = OptionsOf(kind);
    const Shot front = Draw(options, GarmentSide::kFront), back = Draw(options, GarmentSide::kBack);
    const Result<PointAnnotation> annotation =
        PointAnnotationFromJson(TruthAsJson({&front.photograph, &back.photograph, nullptr, options.measures}), kind);
    ASSERT_TRUE(annotation.ok()) << annotation.status().ToString();
    EXPECT_EQ(annotation->front.size(), 22u);
    for (const char* photographed : {"8", "M"}) {
      const Result<SizeChart> chart = DrawnSizeChart(kind, photographed, ForkRule::kClose);
      ASSERT_TRUE(chart.ok());
      const Result<SizeChart> read = SizeChartFromText(SizeChartAsJson(*chart, DrawnFabric(kind)), kind, "");
      ASSERT_TRUE(read.ok()) << GarmentKindName(kind) << ": " << read.status().ToString();
      EXPECT_EQ(read->photographed_size, photographed);
      for (const std::string& name : MeasureNames(kind)) {
        EXPECT_NE(FindMeasure(read->sizes.front().measures, name), nullptr) << name;
      }
    }
  }
  EXPECT_EQ(DrawnSizeChart(GarmentKind::kSkirt, "XXXL", ForkRule::kClose).status().reason(), "SIZE_UNKNOWN");
}

// Hip 96: 6 + 6 cm close, 6.5 + 12.1 cm classic (Aldrich).
TEST(ForkDraft, ExtensionsAreThoseOfTheRules) {
  const ForkDraft close = DraftFork(48.0, 27.0, ForkRule::kClose), classic = DraftFork(48.0, 27.0, ForkRule::kClassic);
  EXPECT_NEAR(close.front_extension, 6.0, 1e-12);
  EXPECT_NEAR(close.back_extension, 6.0, 1e-12);
  EXPECT_NEAR(classic.front_extension, 6.5, 1e-12);
  EXPECT_NEAR(classic.back_extension, 12.125, 1e-12);
  EXPECT_NEAR(DraftFork(48.0, 27.0, ForkRule::kTrouser).back_extension, 9.6, 1e-12);
  // Half the leg's girth: the tube's half and both extensions, halved.
  EXPECT_NEAR(classic.thigh_width, 0.5 * (48.0 + 6.5 + 12.125), 1e-12);
  EXPECT_GT(classic.back_rise, classic.front_rise);
}

TEST(ForkDraft, TheCrotchCurveComesDownStraightAndEndsLevel) {
  const FlatCurve curve = CrotchCurve(27.0, 10.0);
  EXPECT_NEAR((curve.front() - Eigen::Vector2d(0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((curve.back() - Eigen::Vector2d(-10.0, 27.0)).norm(), 0.0, 1e-12);
  const Eigen::Vector2d first = curve[1] - curve[0], last = curve.back() - curve[curve.size() - 2];
  EXPECT_NEAR(first.x(), 0.0, 1e-12);
  EXPECT_LT(std::abs(last.y()), 0.1 * std::abs(last.x()));
  // Longer than the straight way, shorter than the corner.
  EXPECT_GT(CurveLength(curve), std::hypot(27.0, 10.0));
  EXPECT_LT(CurveLength(curve), 37.0);
}

}  // namespace
}  // namespace fitroom::shop_catalog
