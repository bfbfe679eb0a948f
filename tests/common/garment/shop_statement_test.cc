#include "common/garment/shop_statement.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sample_garment.h"

namespace fitroom {
namespace {

using ::testing::HasSubstr;

TEST(ShopStatement, AMeasureIsReadAsPeopleTypeIt) {
  const Result<GarmentMeasure> rise = StatedMeasureFromText("front_rise=24.5", GarmentKind::kPants);
  ASSERT_TRUE(rise.ok()) << rise.status().ToString();
  EXPECT_EQ(*rise, (GarmentMeasure{"front_rise", 0.245, Provenance::kStated}));
  for (const char* text : {"front_rise", "front_rise=", "front_rise=x", "front_rise=24,5", "front_rise=nan",
                           "front_rise=1e999", "front_rise=24.5cm"}) {
    EXPECT_EQ(StatedMeasureFromText(text, GarmentKind::kPants).status().reason(), "MEASURE_TEXT") << text;
  }
  const Status unknown = StatedMeasureFromText("front_rise=24.5", GarmentKind::kSkirt).status();
  EXPECT_EQ(unknown.reason(), "MEASURE_UNKNOWN");
  EXPECT_THAT(unknown.message(), HasSubstr("hem_width"));
  EXPECT_EQ(StatedMeasureFromText("", GarmentKind::kPants).status().reason(), "MEASURE_UNKNOWN");
}

TEST(ShopStatement, WhatIsStatedStandsInForWhatWasFound) {
  Garment garment = testing::MakeSampleTrousers();
  garment.chart = {};
  ShopStatement statement;
  statement.fabric = "woven";
  statement.chart = testing::MakeSampleTrousers().chart;
  statement.measures = {{"thigh_width", 0.31, Provenance::kStated}, {"inseam", 0.76, Provenance::kStated}};
  const size_t count = garment.measures.size();
  ApplyShopStatement(statement, garment);
  EXPECT_EQ(garment.fabric, "woven");
  EXPECT_EQ(garment.chart, statement.chart);
  EXPECT_EQ(garment.measures.size(), count + 1);
  EXPECT_EQ(*FindMeasure(garment.measures, "thigh_width"), statement.measures[0]);
  EXPECT_EQ(*FindMeasure(garment.measures, "inseam"), statement.measures[1]);
  EXPECT_EQ(FindMeasure(garment.measures, "waist_width")->provenance, Provenance::kMeasured);
  const Garment once = garment;
  ApplyShopStatement(statement, garment);
  EXPECT_EQ(garment.measures, once.measures);
}

}  // namespace
}  // namespace fitroom
