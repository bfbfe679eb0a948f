#include "fit_client/render/fit_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "fit_client/render/film.h"
#include "fit_client/render/projection.h"
#include "fit_client/render/size_sheet.h"
#include "tests/fit_client/render/dressed_capsule.h"

namespace fitroom::render {
namespace {

// Relative luminance of an sRGB colour (Rec. 709, with a gamma of 2.2).
double Luminance(const Colour& colour) {
  return 0.2126 * std::pow(colour.x(), 2.2) + 0.7152 * std::pow(colour.y(), 2.2) + 0.0722 * std::pow(colour.z(), 2.2);
}

TEST(MapScale, BandsAreThoseOfTheTradeAndDifferInLightnessAlone) {
  for (const MapScale& scale : {StrainScale(0.05, 0.10), StrainScale(0.15, 0.30), PressureScale(), GapScale()}) {
    for (size_t i = 0; i + 1 < scale.bands.size(); ++i) {
      EXPECT_LT(scale.bands[i].from, scale.bands[i + 1].from);
      const double a = Luminance(scale.bands[i].colour) + 0.05;
      const double b = Luminance(scale.bands[i + 1].colour) + 0.05;
      EXPECT_GT(std::max(a, b) / std::min(a, b), 1.2) << scale.title << ", band " << i;
      // One way only: no two bands have one lightness.
      const double c = Luminance(scale.bands[0].colour) + 0.05;
      EXPECT_EQ(a > b, c > Luminance(scale.bands.back().colour) + 0.05) << scale.title << ", band " << i;
    }
  }
  const MapScale woven = StrainScale(0.05, 0.10);
  EXPECT_EQ(woven.bands[1].from, 0.02);
  EXPECT_EQ(woven.bands[2].from, 0.05);
  EXPECT_EQ(woven.bands[3].from, 0.10);
  EXPECT_EQ(PressureScale().bands[3].from, 2000.0);
}

TEST(MapScale, EachBandHasItsShareOfTheStrip) {
  const MapScale scale = StrainScale(0.05, 0.10);
  EXPECT_EQ(PlaceOnScale(scale, -1.0), 0.0);
  EXPECT_EQ(PlaceOnScale(scale, 0.02), 0.25);
  EXPECT_NEAR(PlaceOnScale(scale, 0.075), 0.625, 1e-12);
  EXPECT_EQ(PlaceOnScale(scale, 0.10), 0.75);
  EXPECT_EQ(PlaceOnScale(scale, 9.0), 1.0);
  EXPECT_EQ(PlaceOnScale(scale, std::numeric_limits<double>::quiet_NaN()), 0.0);
}

class FitMapTest : public ::testing::Test {
 protected:
  FitMapRequest MakeRequest() const {
    FitMapRequest request;
    request.body = &capsule_.body;
    request.cloth = &capsule_.cloth;
    request.positions = capsule_.positions;
    request.scale = {"TEST", {{0.0, "LOW", Colour(0.1F, 0.1F, 0.9F)}, {1.0, "HIGH", Colour(0.9F, 0.1F, 0.1F)}}};
    return request;
  }
  const DressedCapsule capsule_ = MakeDressedCapsule();
};

// Left half of the wearer low, right half high: on the front picture the wearer's right is on the left.
TEST_F(FitMapTest, ShowsEachValueWhereItIs) {
  FitMapRequest request = MakeRequest();
  for (const Eigen::Vector3d& position : capsule_.positions) request.values.push_back(position.x() < -0.01 ? 2.0 : 0.0);
  const Result<Image> map = DrawFitMap(request);
  ASSERT_TRUE(map.ok()) << map.status().ToString();
  const auto is_red = [&](int x, int y) { return map->at(x, y)[0] > map->at(x, y)[2] + 40; };
  const auto is_blue = [&](int x, int y) { return map->at(x, y)[2] > map->at(x, y)[0] + 40; };
  EXPECT_TRUE(is_red(230, 450));   // Front, wearer's right.
  EXPECT_TRUE(is_blue(370, 450));  // Front, wearer's left.
  EXPECT_TRUE(is_blue(606 + 230, 450));
  EXPECT_TRUE(is_red(606 + 370, 450));
  // The legend holds both colours.
  EXPECT_TRUE(is_blue(100, 955));
  EXPECT_TRUE(is_red(map->width - 100, 955));
}

TEST_F(FitMapTest, ValuesOfTrianglesMeetAtSeams) {
  std::vector<double> values;
  for (const Eigen::Vector3i& t : capsule_.cloth.triangles) {
    values.push_back(capsule_.cloth.panel_of_particle[static_cast<size_t>(t[0])] == 0 ? 1.0 : 3.0);
  }
  const std::vector<double> spread = SpreadToParticles(capsule_.cloth, capsule_.positions, values);
  for (const SeamPair& pair : capsule_.cloth.seams) {
    EXPECT_EQ(spread[static_cast<size_t>(pair.a)], spread[static_cast<size_t>(pair.b)]);
    EXPECT_GT(spread[static_cast<size_t>(pair.a)], 1.0);
    EXPECT_LT(spread[static_cast<size_t>(pair.a)], 3.0);
  }
}

TEST_F(FitMapTest, WhatCannotBeDrawnIsRefused) {
  FitMapRequest request = MakeRequest();
  EXPECT_EQ(DrawFitMap(request).status().reason(), "BAD_MAP_REQUEST");  // No values.
  request.values.assign(request.positions.size(), 0.0);
  request.scale.bands.clear();
  EXPECT_EQ(DrawFitMap(request).status().reason(), "BAD_MAP_REQUEST");
  request = MakeRequest();
  request.values.assign(capsule_.cloth.triangles.size(), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(DrawFitMap(request).ok());
}

TEST_F(FitMapTest, ASheetHasAColumnASizeAndFramesTheRecommendedOne) {
  SizeColumn column;
  column.size = "M";
  column.verdict = "tight at the hip: 2 cm less than the 5 cm a woven needs";
  column.ease_lines = {"HIP +3 CM"};
  column.shape = {&capsule_.cloth, capsule_.positions, nullptr, nullptr};
  SizeColumn chosen = column;
  chosen.size = "L";
  chosen.is_recommended = true;
  SizeColumn undressed;
  undressed.size = "XL";
  const Result<Image> one = DrawSizeSheet(capsule_.body, {column, chosen, undressed}, 1);
  const Result<Image> two = DrawSizeSheet(capsule_.body, {column, chosen, undressed}, 2);
  ASSERT_TRUE(one.ok()) << one.status().ToString();
  ASSERT_TRUE(two.ok());
  EXPECT_EQ(one->pixels, two->pixels);
  EXPECT_EQ(one->width, 3 * 300 + 2 * 6);
  const uint8_t* frame = one->at(306 + 2, one->height - 100);
  EXPECT_GT(frame[2], frame[0] + 100);
  EXPECT_EQ(one->at(2, one->height - 100)[0], 255);
  EXPECT_EQ(DrawSizeSheet(capsule_.body, {}, 1).status().reason(), "BAD_SIZE_SHEET");
  EXPECT_EQ(DrawSizeSheet(capsule_.body, std::vector<SizeColumn>(13), 1).status().reason(), "BAD_SIZE_SHEET");
}

// However much a verdict has to say, its last word is drawn, and nothing of it lies over the ease below.
TEST_F(FitMapTest, ASheetGrowsWithTheLongestVerdict) {
  const auto sheet_of = [&](const std::string& verdict) {
    SizeColumn column;
    column.verdict = verdict;
    return DrawSizeSheet(capsule_.body, {column}, 1).value();
  };
  const auto ink_below = [](const Image& sheet, int rows_from_bottom) {
    int count = 0;
    for (int y = sheet.height - rows_from_bottom; y < sheet.height; ++y) {
      for (int x = 0; x < sheet.width; ++x) count += sheet.at(x, y)[0] < 150;
    }
    return count;
  };
  std::string all_but_last = "NOT KNOWN: THIGH";
  for (int i = 0; i < 30; ++i) all_but_last += ", FRONT RISE";
  const Image shorter = sheet_of(all_but_last), longer = sheet_of(all_but_last + " X");
  ASSERT_EQ(shorter.height, longer.height);
  EXPECT_GT(ink_below(longer, 145), ink_below(shorter, 145));
  EXPECT_GT(ink_below(shorter, 145), 0);
  EXPECT_EQ(ink_below(longer, 110), 0);
  // A verdict without an end does not make a sheet of any height.
  std::string endless;
  for (int i = 0; i < 2000; ++i) endless += "RISE ";
  EXPECT_LT(sheet_of(endless).height, longer.height + 300);
}

TEST(WrapLabel, BreaksAtSpacesAndLosesNoWord) {
  const std::vector<std::string> lines = WrapLabel("tight at the hip: much too tight", 12.0, 150.0);
  EXPECT_GT(lines.size(), 1U);
  std::string joined;
  for (const std::string& line : lines) joined += (joined.empty() ? "" : " ") + line;
  EXPECT_EQ(joined, "tight at the hip: much too tight");
  EXPECT_EQ(WrapLabel("extraordinarily", 12.0, 10.0).size(), 1U);
  EXPECT_TRUE(WrapLabel("  ", 12.0, 10.0).empty());
}

class FilmTest : public FitMapTest {
 protected:
  FilmRequest MakeFilm() const {
    FilmRequest request;
    request.body = &capsule_.body;
    request.cloth = &capsule_.cloth;
    FilmKey begin{0.0, "1 START", capsule_.positions, true};
    for (Eigen::Vector3d& position : begin.positions) position.y() += 0.2;
    request.keys = {begin, {0.5, "2 WORN", capsule_.positions, false}};
    request.frame_count = 3;
    return request;
  }
};

TEST_F(FilmTest, IsAnAnimatedWebpTheSameForOneThreadAndTwo) {
  FilmRequest request = MakeFilm();
  const Result<std::string> one = DrawDressingFilm(request);
  request.thread_count = 2;
  const Result<std::string> two = DrawDressingFilm(request);
  ASSERT_TRUE(one.ok()) << one.status().ToString();
  ASSERT_TRUE(two.ok());
  EXPECT_EQ(*one, *two);
  EXPECT_EQ(one->substr(0, 4), "RIFF");
  EXPECT_EQ(one->substr(8, 8), "WEBPVP8X");
  int frame_count = 0;
  for (size_t at = one->find("ANMF"); at != std::string::npos; at = one->find("ANMF", at + 4)) ++frame_count;
  EXPECT_EQ(frame_count, 3);
  EXPECT_LT(one->size(), 100000U);
}

TEST_F(FilmTest, GoesStraightFromKeyToKey) {
  const FilmRequest request = MakeFilm();
  EXPECT_NEAR(FilmPositions(request.keys, 0.25)[7].y(), capsule_.positions[7].y() + 0.1, 1e-12);
  EXPECT_EQ(FilmPositions(request.keys, -1.0)[7], request.keys[0].positions[7]);
  EXPECT_EQ(FilmPositions(request.keys, 0.5)[7], capsule_.positions[7]);
  EXPECT_EQ(FilmPositions(request.keys, 5.0)[7], capsule_.positions[7]);
  EXPECT_TRUE(FilmPositions({}, 0.0).empty());
}

TEST_F(FilmTest, WhatCannotBeFilmedIsRefused) {
  FilmRequest request = MakeFilm();
  request.frame_count = 61;
  EXPECT_EQ(DrawDressingFilm(request).status().reason(), "BAD_FILM_REQUEST");
  request = MakeFilm();
  std::swap(request.keys[0], request.keys[1]);
  EXPECT_EQ(DrawDressingFilm(request).status().reason(), "BAD_FILM_REQUEST");
  request = MakeFilm();
  request.keys[1].positions.pop_back();
  EXPECT_EQ(DrawDressingFilm(request).status().reason(), "BAD_FILM_REQUEST");
  request.keys.clear();
  EXPECT_EQ(DrawDressingFilm(request).status().reason(), "BAD_FILM_REQUEST");
}

}  // namespace
}  // namespace fitroom::render
