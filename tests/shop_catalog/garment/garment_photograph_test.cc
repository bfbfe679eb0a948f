#include "shop_catalog/garment/garment_photograph.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/garment/garment_json.h"
#include "common/image/encode.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/extract_garment.h"

namespace fitroom::shop_catalog {
namespace {

GarmentPhotograph Draw(GarmentSide side, const PhotographOptions& options) {
  Result<GarmentPhotograph> photograph = DrawGarmentPhotograph(side, options);
  EXPECT_TRUE(photograph.ok()) << photograph.status().ToString();
  return std::move(photograph).value();
}

std::map<std::string, Eigen::Vector2d> ByName(const GarmentPhotograph& photograph) {
  std::map<std::string, Eigen::Vector2d> points;
  for (const OutlinePoint& point : photograph.points) points[point.name] = point.pixel;
  return points;
}

// Mean colour of the 7 x 7 pixels round a place.
Eigen::Vector3d ColourAt(const Image& image, const Eigen::Vector2d& pixel) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const uint8_t* p = image.at(static_cast<int>(pixel.x()) + dx, static_cast<int>(pixel.y()) + dy);
      sum += Eigen::Vector3d(p[0], p[1], p[2]);
    }
  }
  return sum / 49.0;
}

PhotographOptions Small(TopDesign design) {
  PhotographOptions options;
  options.design = design;
  options.image_side = 600;
  options.measures = DrawnMeasures(options.kind, BodyGirths(), ForkRule::kTrouser);
  return options;
}

TEST(GarmentPhotograph, HasTheTwentyTwoPointsAsAnAnnotation) {
  const GarmentPhotograph front = Draw(GarmentSide::kFront, Small(TopDesign::kHeather));
  const GarmentPhotograph back = Draw(GarmentSide::kBack, Small(TopDesign::kHeather));
  const Result<PointAnnotation> annotation =
      PointAnnotationFromJson(TruthAsJson({&front, &back, nullptr, {}}), GarmentKind::kTShirt);
  ASSERT_TRUE(annotation.ok()) << annotation.status().ToString();
  EXPECT_EQ(annotation->front.size(), 22u);
  EXPECT_EQ(annotation->back.size(), 22u);
  // The wearer's left is on the image's right from the front, on its left from behind.
  EXPECT_GT(ByName(front).at("hem_L").x(), ByName(front).at("hem_R").x());
  EXPECT_LT(ByName(back).at("hem_L").x(), ByName(back).at("hem_R").x());
}

TEST(GarmentPhotograph, IsDrawnToScale) {
  PhotographOptions options = Small(TopDesign::kStriped);
  options.measures = DrawnMeasures(options.kind, {.bust = 104, .waist = 88, .hip = 106}, ForkRule::kTrouser);
  const auto measure = [&](const char* name) { return FindMeasure(options.measures, name)->value; };
  for (const GarmentSide side : {GarmentSide::kFront, GarmentSide::kBack}) {
    const GarmentPhotograph photograph = Draw(side, options);
    const auto points = ByName(photograph);
    const auto length = [&](const char* a, const char* b) {
      return photograph.metre_per_pixel * (points.at(a) - points.at(b)).norm();
    };
    // Edges wave by some millimetres.
    EXPECT_NEAR(length("underarm_L", "underarm_R"), measure("chest_width"), 0.006);
    EXPECT_NEAR(length("e3", "e4"), measure("sleeve_length"), 0.006);
    const Eigen::Vector2d neck = 0.5 * (points.at("P1") + points.at("P2"));
    const Eigen::Vector2d hem = 0.5 * (points.at("hem_L") + points.at("hem_R"));
    EXPECT_NEAR(photograph.metre_per_pixel * (neck - hem).norm(), measure("front_length"), 0.008);
  }
}

TEST(GarmentPhotograph, ShowsClothInsideTheOutlineAndGroundOutside) {
  for (const TopDesign design : {TopDesign::kHeather, TopDesign::kStriped}) {
    const GarmentPhotograph photograph = Draw(GarmentSide::kFront, Small(design));
    const auto points = ByName(photograph);
    const Eigen::Vector3d ground = ColourAt(photograph.image, {20, 20});
    const std::vector<std::pair<const char*, const char*>> corners_towards = {
        {"hem_L", "P1"},      {"hem_R", "P2"},           {"e4", "underarm_L"},
        {"e8", "underarm_R"}, {"sleeve_bottom_L", "e3"}, {"sleeve_bottom_R", "e7"}};
    for (const auto& [name, target] : corners_towards) {
      const Eigen::Vector2d inwards = (points.at(target) - points.at(name)).normalized();
      EXPECT_GT((ColourAt(photograph.image, points.at(name) + 9.0 * inwards) - ground).norm(), 60.0) << name;
      EXPECT_LT((ColourAt(photograph.image, points.at(name) - 25.0 * inwards) - ground).norm(), 40.0) << name;
    }
  }
}

// A mirrored or swapped texture must be seen: the front differs from the back and from its own mirror image.
TEST(GarmentPhotograph, TellsFrontFromBackAndLeftFromRight) {
  for (const TopDesign design : {TopDesign::kHeather, TopDesign::kStriped}) {
    const GarmentPhotograph front = Draw(GarmentSide::kFront, Small(design));
    const GarmentPhotograph back = Draw(GarmentSide::kBack, Small(design));
    const auto difference = [](const GarmentPhotograph& a, const GarmentPhotograph& b, bool mirrored) {
      const auto pa = ByName(a), pb = ByName(b);
      const auto place = [](const std::map<std::string, Eigen::Vector2d>& p, double u, double v) -> Eigen::Vector2d {
        const bool left_is_r = p.at("hem_R").x() < p.at("hem_L").x();
        const Eigen::Vector2d& l = p.at(left_is_r ? "underarm_R" : "underarm_L");
        const Eigen::Vector2d& r = p.at(left_is_r ? "underarm_L" : "underarm_R");
        const Eigen::Vector2d down = p.at("hem_centre") - 0.5 * (l + r);
        return l + u * (r - l) + v * down;
      };
      double worst = 0.0;
      for (double u = 0.1; u < 0.95; u += 0.05) {
        for (double v = -0.15; v < 0.4; v += 0.03) {
          worst = std::max(
              worst,
              (ColourAt(a.image, place(pa, u, v)) - ColourAt(b.image, place(pb, mirrored ? 1.0 - u : u, v))).norm());
        }
      }
      return worst;
    };
    EXPECT_GT(difference(front, back, false), 100.0);
    EXPECT_GT(difference(front, front, true), 100.0);
  }
}

TEST(GarmentPhotograph, SameSeedSamePicture) {
  PhotographOptions options = Small(TopDesign::kHeather);
  const GarmentPhotograph first = Draw(GarmentSide::kFront, options), again = Draw(GarmentSide::kFront, options);
  options.seed = 2;
  const GarmentPhotograph other = Draw(GarmentSide::kFront, options);
  EXPECT_EQ(first.image.pixels, again.image.pixels);
  EXPECT_NE(first.image.pixels, other.image.pixels);
}

TEST(GarmentPhotograph, RefusesMeasuresAndNamesThem) {
  const auto refused = [](const char* name, double value, int side, const char* reason, const char* named) {
    PhotographOptions options = Small(TopDesign::kHeather);
    for (GarmentMeasure& measure : options.measures) {
      if (measure.name == name) measure.value = value;
    }
    options.image_side = side;
    const Result<GarmentPhotograph> photograph = DrawGarmentPhotograph(GarmentSide::kFront, options);
    ASSERT_FALSE(photograph.ok());
    EXPECT_EQ(photograph.status().code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(photograph.status().reason(), reason);
    EXPECT_NE(photograph.status().message().find(named), std::string::npos) << photograph.status().message();
  };
  refused("front_length", 2.0, 600, "MEASURE_OUT_OF_RANGE", "front_length");
  refused("chest_width", 0.1, 600, "MEASURE_OUT_OF_RANGE", "chest_width");
  refused("sleeve_length", std::numeric_limits<double>::quiet_NaN(), 600, "MEASURE_OUT_OF_RANGE", "sleeve_length");
  refused("", 0.0, 5, "IMAGE_SIDE_OUT_OF_RANGE", "--image-side");
}

class DrawnTShirt : public ::testing::TestWithParam<TopDesign> {};

// Extraction knows nothing of how the picture was made. Corners come back within 1.2 cm; points that are defined by a
// part of the way along an edge within 2 cm.
TEST_P(DrawnTShirt, ExtractionFindsTheTruth) {
  PhotographOptions options = Small(GetParam());
  options.image_side = 1200;
  const GarmentPhotograph front = Draw(GarmentSide::kFront, options), back = Draw(GarmentSide::kBack, options);
  const std::string front_bytes = EncodePng(front.image), back_bytes = EncodePng(back.image);
  ExtractionRequest request;
  request.id = "drawn";
  request.length = FindMeasure(options.measures, "front_length")->value;
  request.front_photo = front_bytes;
  request.back_photo = back_bytes;
  const Result<GarmentExtraction> extraction = ExtractGarment(request);
  ASSERT_TRUE(extraction.ok()) << extraction.status().ToString();
  ASSERT_TRUE(extraction->garment.back.has_value());
  const auto check = [](const GarmentView& view, const GarmentPhotograph& photograph) {
    ASSERT_EQ(view.image_width, photograph.image.width);
    EXPECT_NEAR(view.metre_per_pixel / photograph.metre_per_pixel, 1.0, 0.01);
    for (const auto& [name, truth] : ByName(photograph)) {
      const OutlinePoint* found = FindPoint(view, name);
      ASSERT_NE(found, nullptr) << name;
      const bool is_corner = name == "P1" || name == "P2" || name == "e4" || name == "e8" ||
                             name.starts_with("sleeve") || name.starts_with("hem_") || name.starts_with("underarm");
      EXPECT_LT(photograph.metre_per_pixel * (found->pixel - truth).norm(), is_corner ? 0.012 : 0.020) << name;
    }
  };
  check(extraction->garment.front, front);
  check(*extraction->garment.back, back);
}

INSTANTIATE_TEST_SUITE_P(Designs, DrawnTShirt, ::testing::Values(TopDesign::kHeather, TopDesign::kStriped));

}  // namespace
}  // namespace fitroom::shop_catalog
