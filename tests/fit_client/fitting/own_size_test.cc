#include "fit_client/fitting/own_size.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// A chart that speaks of one of the body's girths alone: 80, 90, 100 and 110 cm.
SizeChart ChartOf(const std::string& dimension) {
  SizeChart chart;
  for (const double girth : {0.80, 0.90, 1.00, 1.10}) {
    GarmentSize size;
    size.name = std::to_string(static_cast<int>(100.0 * girth + 0.5));
    size.body = {{dimension, girth, Provenance::kStated}};
    chart.sizes.push_back(size);
  }
  return chart;
}

Body MakeBody() {
  Body body;
  body.measurements.bust.girth = 1.01;
  body.measurements.waist.girth = 0.79;
  body.measurements.hip.girth = 1.11;
  return body;
}

// Each of the body's girths is compared with the chart's girth of the same name.
TEST(OwnSize, IsThatOfTheGirthThatTheChartSpeaksOf) {
  for (const auto& [dimension, size] : {std::pair("bust", "100"), {"waist", "80"}, {"hip", "110"}}) {
    for (const GarmentKind kind : {GarmentKind::kTShirt, GarmentKind::kSkirt}) {
      Garment garment;
      garment.id = "blouse";
      garment.kind = kind;
      garment.fabric = "woven";
      garment.chart = ChartOf(dimension);
      const Result<SizeChoice> choice = ChooseOwnSize(garment, MakeBody());
      ASSERT_TRUE(choice.ok()) << dimension << ": " << choice.status().ToString();
      EXPECT_EQ(garment.chart.sizes[static_cast<size_t>(choice->index)].name, size) << dimension;
    }
  }
}

TEST(OwnSize, OfAGarmentWithoutAChartIsRefusedByItsName) {
  Garment garment;
  garment.id = "blouse";
  const Status status = ChooseOwnSize(garment, MakeBody()).status();
  EXPECT_EQ(status.reason(), "CHART_EMPTY");
  EXPECT_NE(status.ToString().find("blouse"), std::string::npos) << status.ToString();
}

}  // namespace
}  // namespace fitroom
