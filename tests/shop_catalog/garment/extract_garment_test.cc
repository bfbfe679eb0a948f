#include "shop_catalog/garment/extract_garment.h"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/garment/validate.h"
#include "common/image/decode.h"
#include "common/image/encode.h"
#include "tests/shop_catalog/garment/drawn_tshirt.h"

namespace fitroom::shop_catalog {
namespace {

using testing::DrawnTShirt;
using testing::DrawnTShirtOptions;
using testing::DrawTShirt;
using ::testing::HasSubstr;

ExtractionRequest RequestFor(const std::string& front, const std::string& back = "") {
  ExtractionRequest request;
  request.id = "drawn";
  request.length = 0.68;
  request.front_photo = front;
  request.back_photo = back;
  return request;
}

const GarmentFile* FindFile(const GarmentExtraction& extraction, const std::string& name) {
  for (const GarmentFile& file : extraction.files) {
    if (file.name == name) return &file;
  }
  return nullptr;
}

// The largest distance of a drawn point from the one that was found, as part of the garment's height.
double WorstPointError(const GarmentView& view, const DrawnTShirt& truth, std::string& worst_name) {
  double worst = 0.0;
  for (const auto& [name, pixel] : truth.points) {
    const double error = (FindPoint(view, name)->pixel - pixel).norm() / truth.length_px;
    if (error > worst) {
      worst = error;
      worst_name = name;
    }
  }
  return worst;
}

struct Scene {
  const char* name;
  DrawnTShirtOptions options;
};

class DrawnScenes : public ::testing::TestWithParam<Scene> {};

TEST_P(DrawnScenes, PointsAndScaleAreThoseOfTheDrawing) {
  const DrawnTShirt drawn = DrawTShirt(GetParam().options);
  const std::string photo = EncodePng(drawn.photo);
  const Result<GarmentExtraction> extraction = ExtractGarment(GetParam().options.side == GarmentSide::kFront
                                                                  ? RequestFor(photo)
                                                                  : RequestFor(EncodePng(DrawTShirt({}).photo), photo));
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  const GarmentView& view =
      GetParam().options.side == GarmentSide::kFront ? extraction->garment.front : *extraction->garment.back;
  std::string name;
  EXPECT_LT(WorstPointError(view, drawn, name), 0.02) << name;
  EXPECT_NEAR(view.metre_per_pixel * drawn.length_px, 0.68, 0.68 * 0.01);
  EXPECT_TRUE(ValidateGarment(extraction->garment).ok());
  // The outline holds the drawn area: the silhouette, without the inside of the back neck on a front view.
  const double neck_area = GetParam().options.side == GarmentSide::kFront
                               ? 0.5 * 3.14159 * 0.13 * (0.125 - 0.03) * drawn.length_px * drawn.length_px
                               : 0.0;
  EXPECT_NEAR(SignedArea(view.outline) / (SignedArea(drawn.silhouette) - neck_area), 1.0, 0.015);
}

INSTANTIATE_TEST_SUITE_P(
    All, DrawnScenes,
    ::testing::Values(
        Scene{"Plain", {}}, Scene{"Back", {.side = GarmentSide::kBack}}, Scene{"TiltedLeft", {.tilt_deg = -14}},
        Scene{"TiltedRight", {.tilt_deg = 11}}, Scene{"Shadow", {.shadow = true}},
        Scene{"Striped", {.background = {150, 140, 120}, .texture = 25}}, Scene{"Transparent", {.with_alpha = true}},
        Scene{"WhiteOnWhite", {.cloth = {222, 222, 226}, .inside = {190, 190, 200}, .background = {248, 248, 248}}},
        Scene{"DarkOnBlack", {.cloth = {60, 60, 66}, .inside = {38, 38, 42}, .background = {12, 12, 12}}}),
    [](const auto& tested) { return tested.param.name; });

TEST(ExtractGarment, StoresPhotographsAsReceivedAndImagesOfTheViewsSize) {
  const std::string front = EncodeJpeg(DrawTShirt({}).photo, 92);
  const std::string back = EncodePng(DrawTShirt({.side = GarmentSide::kBack}).photo);
  const Result<GarmentExtraction> extraction = ExtractGarment(RequestFor(front, back));
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  ASSERT_NE(FindFile(*extraction, "front.jpg"), nullptr);
  EXPECT_EQ(FindFile(*extraction, "front.jpg")->bytes, front);
  ASSERT_NE(FindFile(*extraction, "back.png"), nullptr);
  EXPECT_EQ(FindFile(*extraction, "back.png")->bytes, back);
  for (const char* name : {"front_mask.png", "front_texture.png", "back_mask.png", "back_texture.png"}) {
    ASSERT_NE(FindFile(*extraction, name), nullptr) << name;
    const Result<Image> image = DecodeImage(FindFile(*extraction, name)->bytes);
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(image->width, 600);
  }
  EXPECT_NE(FindFile(*extraction, "extraction.png"), nullptr);
  // The drawing's own proportions, flat, at 68 cm.
  std::map<std::string, double> measures;
  for (const GarmentMeasure& measure : extraction->garment.measures) measures[measure.name] = measure.value;
  EXPECT_NEAR(measures.at("hem_width"), 2 * 0.345 * 0.68, 0.01);
  EXPECT_NEAR(measures.at("neck_width"), 2 * 0.130 * 0.68, 0.012);
  EXPECT_NEAR(measures.at("front_length"), 0.68, 0.005);
  EXPECT_NEAR(measures.at("sleeve_opening"), std::hypot(0.065, 0.145) * 0.68, 0.012);
}

TEST(ExtractGarment, TheTextureShowsNoBackgroundOnOrNearTheOutline) {
  const DrawnTShirtOptions options = {.cloth = {170, 40, 40}, .inside = {110, 25, 25}, .background = {40, 200, 60}};
  const std::string photo = EncodePng(DrawTShirt(options).photo);
  const Result<GarmentExtraction> extraction = ExtractGarment(RequestFor(photo));
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  const Result<Image> texture = DecodeImage(FindFile(*extraction, "front_texture.png")->bytes);
  ASSERT_TRUE(texture.ok());
  // The cloth is red and the ground green: no pixel of the texture may be nearer to green.
  int green_count = 0;
  for (int y = 0; y < texture->height; ++y) {
    for (int x = 0; x < texture->width; ++x) {
      const uint8_t* pixel = texture->at(x, y);
      if (pixel[1] > pixel[0]) ++green_count;
    }
  }
  EXPECT_EQ(green_count, 0);
}

TEST(ExtractGarment, TheSameInputGivesTheSameBytes) {
  const std::string photo = EncodePng(DrawTShirt({}).photo);
  const Result<GarmentExtraction> first = ExtractGarment(RequestFor(photo));
  const Result<GarmentExtraction> second = ExtractGarment(RequestFor(photo));
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(GarmentToJson(first->garment), GarmentToJson(second->garment));
  for (size_t i = 0; i < first->files.size(); ++i) EXPECT_EQ(first->files[i].bytes, second->files[i].bytes);
}

TEST(ExtractGarment, AnnotationReplacesDetectionAndIsChecked) {
  const DrawnTShirt drawn = DrawTShirt({});
  const std::string photo = EncodePng(drawn.photo);
  const Result<GarmentExtraction> detected = ExtractGarment(RequestFor(photo));
  ASSERT_TRUE(detected.ok());
  PointAnnotation annotation;
  annotation.front = detected->garment.front.points;
  for (OutlinePoint& point : annotation.front) point.confidence = 1.0;
  annotation.front[2].pixel += Eigen::Vector2d(1.5, 0.5);  // e1, by hand a little farther out.
  ExtractionRequest request = RequestFor(photo);
  request.annotation = &annotation;
  const Result<GarmentExtraction> annotated = ExtractGarment(request);
  ASSERT_TRUE(annotated.ok()) << annotated.status().ToString();
  EXPECT_EQ(annotated->garment.front.points[2].pixel, annotation.front[2].pixel);
  EXPECT_EQ(annotated->garment.front.points[2].confidence, 1.0);

  std::swap(annotation.front[14].pixel, annotation.front[15].pixel);  // waist_L and waist_R.
  const Status swapped = ExtractGarment(request).status();
  EXPECT_EQ(swapped.reason(), "POINTS_SWAPPED");
  EXPECT_THAT(swapped.message(), HasSubstr("waist_L"));
  annotation.front.pop_back();
  EXPECT_EQ(ExtractGarment(request).status().reason(), "POINT_MISSING");
}

TEST(ExtractGarment, RefusesAStatementThatCannotBe) {
  const std::string photo = "never looked at";
  ExtractionRequest request = RequestFor(photo);
  request.length = 0.0;
  EXPECT_EQ(ExtractGarment(request).status().reason(), "LENGTH_MISSING");
  for (const double length : {0.29, 1.21, -0.68, 68.0, std::nan("")}) {
    request.length = length;
    EXPECT_EQ(ExtractGarment(request).status().reason(), "LENGTH_OUT_OF_RANGE") << length;
  }
  request.length = 0.68;
  request.side_folded_photo = photo;
  EXPECT_EQ(ExtractGarment(request).status().reason(), "SIDE_FOLDED_WITHOUT_LEGS");
  request.side_folded_photo = {};
  // Every kind has its own lengths.
  for (const auto& [kind, length] : {std::pair(GarmentKind::kPants, 0.4), std::pair(GarmentKind::kShorts, 0.9),
                                     std::pair(GarmentKind::kSkirt, 1.3), std::pair(GarmentKind::kOnePiece, 0.45)}) {
    request.kind = kind;
    request.length = length;
    EXPECT_EQ(ExtractGarment(request).status().reason(), "LENGTH_OUT_OF_RANGE") << length;
  }
  EXPECT_EQ(ExtractGarment(RequestFor("")).status().reason(), "PHOTO_MISSING");
}

TEST(ExtractGarment, RefusesAPhotographThatCannotBeRead) {
  const std::string photo = EncodePng(DrawTShirt({}).photo);
  const std::string truncated = photo.substr(0, photo.size() / 2);
  EXPECT_FALSE(ExtractGarment(RequestFor(truncated)).ok());
  EXPECT_EQ(ExtractGarment(RequestFor("not an image")).status().reason(), "IMAGE_FORMAT_UNKNOWN");
  const std::string tiny = EncodePng(MakeImage(100, 300, 3));
  EXPECT_EQ(ExtractGarment(RequestFor(tiny)).status().reason(), "IMAGE_TOO_SMALL");
  const Status back = ExtractGarment(RequestFor(photo, "not an image")).status();
  EXPECT_EQ(back.reason(), "IMAGE_FORMAT_UNKNOWN");
  EXPECT_THAT(back.message(), HasSubstr("back photograph"));
}

TEST(ExtractGarment, RefusesAnEmptyGround) {
  const testing::Colour grey = {180, 178, 175};
  const std::string photo = EncodePng(testing::DrawShape({{1, 1}, {2, 1}, {2, 2}}, 400, grey, grey));
  const Status status = ExtractGarment(RequestFor(photo)).status();
  EXPECT_EQ(status.reason(), "NO_GARMENT_FOUND") << status.message();
}

TEST(ExtractGarment, RefusesAGarmentCutOffByTheFrame) {
  for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0, 130), Eigen::Vector2d(150, 0), Eigen::Vector2d(-150, 0)}) {
    const std::string photo = EncodePng(DrawTShirt({.shift = shift}).photo);
    const Status status = ExtractGarment(RequestFor(photo)).status();
    EXPECT_EQ(status.reason(), "GARMENT_CROPPED") << shift.transpose() << status.message();
  }
}

TEST(ExtractGarment, RefusesOtherKindsOfGarment) {
  const testing::Colour cloth = {60, 70, 120};
  const testing::Colour ground = {240, 238, 232};
  const Polygon trousers = {{220, 60}, {380, 60}, {410, 540}, {320, 540}, {300, 220}, {280, 540}, {190, 540}};
  const Polygon skirt = {{220, 100}, {380, 100}, {480, 500}, {120, 500}};
  const Polygon dress = {{240, 40},  {260, 40},  {270, 80},  {330, 80},  {340, 40},  {360, 40},
                         {380, 130}, {360, 250}, {450, 560}, {150, 560}, {240, 250}, {220, 130}};
  for (const Polygon& shape : {trousers, skirt, dress}) {
    const std::string photo = EncodePng(testing::DrawShape(shape, 600, cloth, ground));
    const Status status = ExtractGarment(RequestFor(photo)).status();
    EXPECT_EQ(status.code(), StatusCode::kFailedPrecondition);
    EXPECT_EQ(status.reason(), "WRONG_KIND") << status.message();
  }
}

TEST(ExtractGarment, RefusesAFrontAndABackOfDifferentGarments) {
  const std::string front = EncodePng(DrawTShirt({}).photo);
  const std::string back =
      EncodePng(DrawTShirt({.side = GarmentSide::kBack, .height = 300, .width_scale = 1.45}).photo);
  const Status status = ExtractGarment(RequestFor(front, back)).status();
  EXPECT_EQ(status.reason(), "VIEWS_DO_NOT_MATCH") << status.message();
}

TEST(ExtractGarment, StopsWhenAskedTo) {
  const std::string photo = EncodePng(DrawTShirt({}).photo);
  ExtractionRequest request = RequestFor(photo);
  request.is_cancelled = [] { return true; };
  EXPECT_EQ(ExtractGarment(request).status().code(), StatusCode::kCancelled);
}

}  // namespace
}  // namespace fitroom::shop_catalog
