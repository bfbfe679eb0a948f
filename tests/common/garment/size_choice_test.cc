#include "common/garment/size_choice.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// EN 13402-3 as drafted by Aldrich: sizes 6 to 24, the body's girths in cm.
SizeChart BodyChart() {
  const double bust[] = {80, 84, 88, 92, 96, 100, 104, 110, 116, 122};
  const double waist[] = {64, 68, 72, 76, 80, 84, 88, 94, 100, 106};
  const double hip[] = {88, 92, 96, 100, 104, 108, 112, 118, 124, 132};
  SizeChart chart;
  for (int i = 0; i < 10; ++i) {
    GarmentSize size;
    size.name = std::to_string(6 + 2 * i);
    size.body = {{"bust", bust[i] / 100, Provenance::kStated},
                 {"waist", waist[i] / 100, Provenance::kStated},
                 {"hip", hip[i] / 100, Provenance::kStated}};
    chart.sizes.push_back(size);
  }
  return chart;
}

SizeChart FlatChart(const std::vector<double>& chest_widths) {
  SizeChart chart;
  for (size_t i = 0; i < chest_widths.size(); ++i) {
    GarmentSize size;
    size.name = "S" + std::to_string(i);
    size.measures = {{"chest_width", chest_widths[i], Provenance::kStated}};
    chart.sizes.push_back(size);
  }
  return chart;
}

TEST(SizeChoice, TakesBustForTopsAndHipForBottoms) {
  BodyGirths body;
  body.bust = 0.92;
  body.waist = 0.64;
  body.hip = 1.04;
  for (GarmentKind kind : {GarmentKind::kTShirt, GarmentKind::kOnePiece, GarmentKind::kSleevedOnePiece}) {
    const Result<SizeChoice> choice = ChooseSize(kind, "jersey", BodyChart(), body);
    ASSERT_TRUE(choice.ok());
    EXPECT_EQ(choice->size, "12");
    EXPECT_FALSE(choice->between());
    EXPECT_NEAR(choice->difference, 0.0, 1e-12);
  }
  for (GarmentKind kind : {GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts}) {
    const Result<SizeChoice> choice = ChooseSize(kind, "denim", BodyChart(), body);
    ASSERT_TRUE(choice.ok());
    EXPECT_EQ(choice->size, "14");
    EXPECT_EQ(choice->dimension, PrimaryDimension::kHip);
  }
}

// Between two sizes a step of s apart the distances differ by 2x at x from the middle: "between" for |x| < u/2.
TEST(SizeChoice, SaysBetweenWhereTheDistancesDifferByLessThanTheUncertainty) {
  for (double x = -0.0195; x < 0.0196; x += 0.001) {
    BodyGirths body;
    body.bust = 0.94 + x;  // 0.92 is size 12, 0.96 is size 14.
    const Result<SizeChoice> choice = ChooseSize(GarmentKind::kTShirt, "jersey", BodyChart(), body);
    ASSERT_TRUE(choice.ok());
    EXPECT_EQ(choice->size, x < 0 ? "12" : "14") << x;
    EXPECT_EQ(choice->between(), std::abs(2 * x) < kSizeUncertainty) << x;
    if (choice->between()) {
      EXPECT_EQ(choice->between_with, x < 0 ? "14" : "12");
    }
    EXPECT_NEAR(x < 0 ? choice->larger_margin : choice->smaller_margin, std::abs(2 * x), 1e-12);
  }
}

TEST(SizeChoice, SaysWhenTheBodyIsBeyondTheChart) {
  BodyGirths body;
  body.bust = 1.251;  // The largest is 122, the step before it 6 cm: half of it is 3.
  Result<SizeChoice> choice = ChooseSize(GarmentKind::kTShirt, "jersey", BodyChart(), body);
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice->size, "24");
  EXPECT_TRUE(choice->outside_chart);
  EXPECT_TRUE(choice->larger.empty());
  body.bust = 1.249;
  EXPECT_FALSE(ChooseSize(GarmentKind::kTShirt, "jersey", BodyChart(), body)->outside_chart);
  body.bust = 0.779;
  EXPECT_TRUE(ChooseSize(GarmentKind::kTShirt, "jersey", BodyChart(), body)->outside_chart);
}

// A body of 90 cm: woven needs 4.5 cm of ease at the bust, jersey 5 %.
TEST(SizeChoice, TakesTheClassEaseFromFlatWidths) {
  BodyGirths body;
  body.bust = 0.90;
  Result<SizeChoice> choice = ChooseSize(GarmentKind::kTShirt, "woven", FlatChart({0.4525, 0.4725, 0.4925}), body);
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice->size, "S1");
  EXPECT_TRUE(choice->from_flat_measures);
  EXPECT_NEAR(choice->difference, 0.0, 1e-12);
  choice = ChooseSize(GarmentKind::kTShirt, "jersey", FlatChart({0.4525, 0.4725, 0.4925}), body);
  ASSERT_TRUE(choice.ok());
  EXPECT_NEAR(choice->size_girth * 1.05, 2 * 0.4725, 1e-12);
}

TEST(SizeChoice, FallsBackToWhatIsKnownAndRefusesTheRest) {
  BodyGirths body;
  body.waist = 0.81;
  Result<SizeChoice> choice = ChooseSize(GarmentKind::kPants, "denim", BodyChart(), body);
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice->dimension, PrimaryDimension::kWaist);
  EXPECT_EQ(choice->size, "14");

  EXPECT_EQ(ChooseSize(GarmentKind::kPants, "denim", {}, body).status().reason(), "CHART_EMPTY");
  EXPECT_EQ(ChooseSize(GarmentKind::kPants, "denim", FlatChart({0.5}), body).status().reason(),
            "CHART_WITHOUT_DIMENSION");
  body.bust = 90.0;  // Centimetres.
  EXPECT_EQ(ChooseSize(GarmentKind::kTShirt, "denim", BodyChart(), body).status().reason(), "BODY_GIRTH_OUT_OF_RANGE");
  body.bust = std::nan("");
  EXPECT_EQ(ChooseSize(GarmentKind::kTShirt, "denim", BodyChart(), body).status().reason(), "BODY_GIRTH_OUT_OF_RANGE");
  body.bust = 0.9;
  EXPECT_EQ(ChooseSize(GarmentKind::kTShirt, "jersey", FlatChart({0.5, 0.5}), body).status().reason(),
            "CHART_NOT_A_GRADING");
}

// Sets with a known truth: every body is drawn from a size with the spread of a scan; the nearest size by girth is
// true.
TEST(SizeChoice, IsRightOnGradedSetsWhereItIsSure) {
  const SizeChart chart = BodyChart();
  unsigned seed = 1;
  int sure = 0, right = 0;
  for (int i = 0; i < 2000; ++i) {
    seed = seed * 1664525u + 1013904223u;
    const double truth = 0.78 + 0.46 * ((seed >> 8) / 16777216.0);
    seed = seed * 1664525u + 1013904223u;
    const double error = 0.006 * (2.0 * ((seed >> 8) / 16777216.0) - 1.0);
    BodyGirths body;
    body.bust = truth + error;
    const Result<SizeChoice> choice = ChooseSize(GarmentKind::kTShirt, "jersey", chart, body);
    ASSERT_TRUE(choice.ok());
    if (choice->between()) continue;
    int nearest = 0;
    for (int k = 1; k < 10; ++k) {
      const auto off = [&](int n) { return std::abs(chart.sizes[static_cast<size_t>(n)].body[0].value - truth); };
      if (off(k) < off(nearest)) nearest = k;
    }
    ++sure;
    right += choice->index == nearest;
  }
  EXPECT_GT(sure, 1000);
  EXPECT_GE(right, sure * 95 / 100);
}

}  // namespace
}  // namespace fitroom
