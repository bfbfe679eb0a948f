#include "common/garment/garment_json.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/garment/validate.h"
#include "tests/support/sample_garment.h"

namespace fitroom {
namespace {

using ::testing::HasSubstr;

OutlinePoint& Point(GarmentView& view, const std::string& name) {
  return const_cast<OutlinePoint&>(*FindPoint(view, name));
}

TEST(GarmentJson, GivesBackWhatWasWritten) {
  const Garment garment = testing::MakeSampleTShirt();
  const std::string text = GarmentToJson(garment);
  const Result<Garment> read = GarmentFromJson(text);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->id, garment.id);
  EXPECT_EQ(read->kind, garment.kind);
  EXPECT_DOUBLE_EQ(read->length, garment.length);
  ASSERT_TRUE(read->back.has_value());
  EXPECT_EQ(read->back->side, GarmentSide::kBack);
  EXPECT_EQ(read->front.outline, garment.front.outline);
  EXPECT_DOUBLE_EQ(read->front.metre_per_pixel, garment.front.metre_per_pixel);
  for (size_t i = 0; i < garment.front.points.size(); ++i) {
    EXPECT_EQ(read->back->points[i].name, garment.back->points[i].name);
    EXPECT_EQ(read->back->points[i].pixel, garment.back->points[i].pixel);
  }
  ASSERT_EQ(read->measures.size(), 1u);
  EXPECT_DOUBLE_EQ(read->measures[0].value, 0.48);
  EXPECT_EQ(GarmentToJson(*read), text);
}

TEST(GarmentJson, GivesBackChartFabricProvenanceAndSideFoldedView) {
  const Garment garment = testing::MakeSampleTrousers();
  ASSERT_TRUE(ValidateGarment(garment).ok()) << ValidateGarment(garment).ToString();
  const std::string text = GarmentToJson(garment);
  const Result<Garment> read = GarmentFromJson(text);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->fabric, "denim");
  EXPECT_EQ(read->measures, garment.measures);
  EXPECT_EQ(read->chart, garment.chart);
  ASSERT_TRUE(read->side_folded.has_value());
  EXPECT_EQ(read->side_folded->side, GarmentSide::kSideFolded);
  EXPECT_EQ(read->side_folded->outline, garment.side_folded->outline);
  EXPECT_EQ(read->side_folded->points.size(), SideFoldedPointNames().size());
  EXPECT_EQ(GarmentToJson(*read), text);
}

// Every tenth of a millimetre is a number of its own on both sides of the change of unit.
TEST(GarmentJson, StatedLengthsComeBackBitForBit) {
  ShopStatement statement;
  for (int tenth = 100; tenth <= 25000; tenth += 7) {
    statement.measures = {{"front_rise", tenth / 1e4, Provenance::kStated}};
    const Result<ShopStatement> read = ShopStatementFromJson(ShopStatementToJson(statement));
    ASSERT_TRUE(read.ok()) << read.status().ToString();
    ASSERT_EQ(read->measures, statement.measures);
  }
}

// As the first version wrote it: no fabric, bare measures, nothing of sizes.
TEST(GarmentJson, ReadsTheFirstVersion) {
  std::string text = GarmentToJson(testing::MakeSampleTShirt());
  text.replace(text.find("\"version\":2"), 11, "\"version\":1");
  const std::string fabric = "\"fabric\":\"jersey\",";
  ASSERT_NE(text.find(fabric), std::string::npos);
  text.erase(text.find(fabric), fabric.size());
  const Result<Garment> read = GarmentFromJson(text);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->fabric, "jersey");
  EXPECT_TRUE(read->chart.sizes.empty());
  EXPECT_EQ(read->measures, testing::MakeSampleTShirt().measures);
}

TEST(GarmentJson, ALaterVersionSaysWhatToDo) {
  std::string text = GarmentToJson(testing::MakeSampleTShirt());
  text.replace(text.find("\"version\":2"), 11, "\"version\":3");
  const Status status = GarmentFromJson(text).status();
  EXPECT_EQ(status.reason(), "GARMENT_JSON");
  EXPECT_THAT(status.message(), HasSubstr("garment.version is 3"));
  EXPECT_THAT(status.message(), HasSubstr("update"));
}

TEST(GarmentJson, AChartsFaultNamesItsPlace) {
  std::string text = GarmentToJson(testing::MakeSampleTrousers());
  const size_t place = text.find("\"hip_width\":51.5");
  ASSERT_NE(place, std::string::npos);
  text.replace(place, 16, "\"hip_width\":\"x\"");
  const Status status = GarmentFromJson(text).status();
  EXPECT_EQ(status.reason(), "GARMENT_JSON");
  EXPECT_THAT(status.message(), HasSubstr("garment.chart.sizes[2].measures_cm.hip_width"));
}

TEST(GarmentJson, TextThatEndsEarlyIsRefusedAtEveryLength) {
  const std::string text = GarmentToJson(testing::MakeSampleTShirt());
  for (size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_EQ(GarmentFromJson(text.substr(0, length)).status().reason(), "GARMENT_JSON");
  }
}

TEST(GarmentJson, WrongTypesNameTheirPlace) {
  std::string text = GarmentToJson(testing::MakeSampleTShirt());
  const size_t place = text.find("\"image_width\":800");
  text.replace(place, 17, "\"image_width\":\"8\"");
  const Status status = GarmentFromJson(text).status();
  EXPECT_EQ(status.reason(), "GARMENT_JSON");
  EXPECT_THAT(status.message(), HasSubstr("front.image_width"));
  for (const char* other : {"[]", "null", "7", "{\"format\":\"fitroom.garment\",\"version\":2}", "{\"front\":{}}"}) {
    EXPECT_FALSE(GarmentFromJson(other).ok()) << other;
  }
  EXPECT_FALSE(GarmentFromJson(std::string(100000, '[')).ok());
}

struct Damage {
  const char* reason;
  const char* named;  // What the message must name.
  std::function<void(Garment&)> apply;
};

TEST(ValidateGarment, NamesEachFaultOfWhatTheShopStates) {
  const std::vector<Damage> damages = {
      {"FABRIC_UNKNOWN", "jersey", [](Garment& g) { g.fabric = "chainmail"; }},
      {"GARMENT_MEASURE", "twice", [](Garment& g) { g.measures.push_back(g.measures[0]); }},
      {"GARMENT_MEASURE", "front_rise", [](Garment& g) { g.measures[2].value = 2.45; }},
      {"GARMENT_MEASURE", "inseam", [](Garment& g) { g.measures[2].name = "sleeve_length"; }},
      {"GARMENT_MEASURE", "thigh_width", [](Garment& g) { g.measures[4].value = 0.3; }},
      {"CHART_PHOTOGRAPHED_SIZE", "XL", [](Garment& g) { g.chart.photographed_size = "XL"; }},
      {"CHART_SIZE_COUNT", "0", [](Garment& g) { g.chart.sizes.clear(); }},
      {"CHART_CONTRADICTS_PHOTOGRAPH", "girths", [](Garment& g) { g.measures[0].value = 0.76 / 4; }},
      {"SIDE_FOLDED_KIND", "shorts", [](Garment& g) { g.side_folded->side = GarmentSide::kFront; }},
      {"POINT_MISSING", "crotch", [](Garment& g) { g.side_folded->points.pop_back(); }},
      {"POINT_OUT_OF_ORDER", "side_folded",
       [](Garment& g) { std::swap(g.side_folded->points[1].pixel, g.side_folded->points[2].pixel); }},
  };
  for (const Damage& damage : damages) {
    Garment garment = testing::MakeSampleTrousers();
    damage.apply(garment);
    const Status status = ValidateGarment(garment);
    EXPECT_EQ(status.reason(), damage.reason) << status.ToString();
    EXPECT_THAT(status.message(), HasSubstr(damage.named));
  }
  Garment shirt = testing::MakeSampleTShirt();
  shirt.side_folded = testing::MakeSampleTrousers().side_folded;
  EXPECT_EQ(ValidateGarment(shirt).reason(), "SIDE_FOLDED_KIND");
}

TEST(ValidateGarment, NamesEachFault) {
  const std::vector<Damage> damages = {
      {"GARMENT_ID", "id", [](Garment& g) { g.id = "../x"; }},
      {"GARMENT_LENGTH", "length", [](Garment& g) { g.length = 5.0; }},
      {"GARMENT_FILE_NAME", "etc", [](Garment& g) { g.front.mask_file = "../etc/passwd"; }},
      {"GARMENT_FILE_NAME", ".x", [](Garment& g) { g.front.photo_file = ".x"; }},
      {"IMAGE_SIZE", "front", [](Garment& g) { g.front.image_width = 0; }},
      {"METRE_PER_PIXEL", "back", [](Garment& g) { g.back->metre_per_pixel = 0.0; }},
      {"POINT_MISSING", "hem_L",
       [](Garment& g) { std::erase_if(g.front.points, [](auto& p) { return p.name == "hem_L"; }); }},
      {"POINT_UNKNOWN", "hood", [](Garment& g) { Point(g.front, "P1").name = "hood"; }},
      {"POINT_OUTSIDE_IMAGE", "e4", [](Garment& g) { Point(g.front, "e4").pixel.x() = 801; }},
      {"POINT_OUTSIDE_IMAGE", "e4", [](Garment& g) { Point(g.front, "e4").pixel.x() = std::nan(""); }},
      {"POINT_CONFIDENCE", "e4", [](Garment& g) { Point(g.front, "e4").confidence = 1.5; }},
      {"POINTS_SWAPPED", "hip_L",
       [](Garment& g) { std::swap(Point(g.front, "hip_L").pixel, Point(g.front, "hip_R").pixel); }},
      {"POINTS_SWAPPED", "P2", [](Garment& g) { std::swap(Point(*g.back, "P1").pixel, Point(*g.back, "P2").pixel); }},
      {"POINTS_SWAPPED", "front", [](Garment& g) { std::swap(g.front, *g.back); }},
      {"POINT_OFF_OUTLINE", "waist_R", [](Garment& g) { Point(g.front, "waist_R").pixel.x() += 60; }},
      {"POINT_OUT_OF_ORDER", "waist_L",
       [](Garment& g) { std::swap(Point(g.front, "waist_L").pixel, Point(g.front, "hip_L").pixel); }},
      {"OUTLINE_SIZE", "outline", [](Garment& g) { g.front.outline.resize(5); }},
      {"OUTLINE_DIRECTION", "anticlockwise",
       [](Garment& g) { std::reverse(g.front.outline.begin(), g.front.outline.end()); }},
      {"OUTLINE_NOT_SIMPLE", "crosses", [](Garment& g) { std::swap(g.front.outline[6], g.front.outline[8]); }},
  };
  ASSERT_TRUE(ValidateGarment(testing::MakeSampleTShirt()).ok())
      << ValidateGarment(testing::MakeSampleTShirt()).ToString();
  for (const Damage& damage : damages) {
    Garment garment = testing::MakeSampleTShirt();
    damage.apply(garment);
    const Status status = ValidateGarment(garment);
    EXPECT_EQ(status.reason(), damage.reason) << status.message();
    EXPECT_THAT(status.message(), HasSubstr(damage.named));
  }
}

TEST(ValidateGarment, ATiltedGarmentIsNotTakenForASwappedOne) {
  for (const double angle_deg : {-60.0, -25.0, 25.0, 60.0}) {
    const double angle = angle_deg * 3.14159265358979 / 180.0;
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    Garment garment = testing::MakeSampleTShirt();
    for (GarmentView* view : {&garment.front, &*garment.back}) {
      const auto move = [&](Eigen::Vector2d& p) {
        p = Eigen::Vector2d(600, 600) + turn * (p - Eigen::Vector2d(400, 400));
      };
      for (Eigen::Vector2d& p : view->outline) move(p);
      for (OutlinePoint& point : view->points) move(point.pixel);
      view->image_width = view->image_height = 1200;
    }
    EXPECT_TRUE(ValidateGarment(garment).ok()) << angle_deg << ValidateGarment(garment).ToString();
  }
}

TEST(PointAnnotation, AcceptsPairsAndObjectsAndRefusesUnknownNames) {
  const Result<PointAnnotation> annotation = PointAnnotationFromJson(
      R"({"front": {"P2": {"pixel": [3, 4], "confidence": 0.5}, "P1": [1, 2]}})", GarmentKind::kTShirt);
  ASSERT_TRUE(annotation.ok()) << annotation.status().ToString();
  ASSERT_EQ(annotation->front.size(), 2u);
  EXPECT_EQ(annotation->front[0].name, "P1");
  EXPECT_EQ(annotation->front[0].confidence, 1.0);
  EXPECT_EQ(annotation->front[1].pixel, Eigen::Vector2d(3, 4));
  EXPECT_TRUE(annotation->back.empty());
  for (const char* bad :
       {"", "[]", "{}", R"({"front": 3})", R"({"front": {"P1": [1]}})", R"({"front": {"P1": ["a", 2]}})"}) {
    EXPECT_EQ(PointAnnotationFromJson(bad, GarmentKind::kTShirt).status().reason(), "GARMENT_JSON") << bad;
  }
  EXPECT_EQ(PointAnnotationFromJson(R"({"back": {"nose": [1, 2]}})", GarmentKind::kTShirt).status().reason(),
            "POINT_UNKNOWN");
}

TEST(OutlineOrder, PassesEveryPointOnceAndBackwardsOnTheBack) {
  std::vector<std::string> front = OutlineOrder(GarmentKind::kTShirt, GarmentSide::kFront);
  std::vector<std::string> back = OutlineOrder(GarmentKind::kTShirt, GarmentSide::kBack);
  EXPECT_THAT(front, ::testing::UnorderedElementsAreArray(OutlinePointNames(GarmentKind::kTShirt)));
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(front, back);
  for (const std::string& name : front)
    EXPECT_EQ(TwinPointName(GarmentKind::kTShirt, TwinPointName(GarmentKind::kTShirt, name)), name);
}

}  // namespace
}  // namespace fitroom
