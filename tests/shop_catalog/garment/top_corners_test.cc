#include "shop_catalog/garment/top_corners.h"

#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "shop_catalog/garment/measures.h"
#include "shop_catalog/garment/shape_check.h"
#include "tests/shop_catalog/garment/drawn_tshirt.h"
#include "tests/support/sample_garment.h"

namespace fitroom::shop_catalog {
namespace {

constexpr const char* kNamesOnFront[kTopCornerCount] = {
    "hem_R", "underarm_R", "sleeve_bottom_R", "e8", "P1", "P2", "e4", "sleeve_bottom_L", "underarm_L", "hem_L"};

TEST(FindTopCorners, FindsTheCornersOfADrawnOutlineUnderAnyTilt) {
  for (const double tilt_deg : {-35.0, -20.0, -5.0, 0.0, 5.0, 20.0, 35.0}) {
    const testing::DrawnTShirt drawn = testing::DrawTShirt({.image_side = 8, .tilt_deg = tilt_deg});
    Polygon dense;
    for (int i = 0; i < 800; ++i)
      dense.push_back(PlaceAt(drawn.silhouette, i * Perimeter(drawn.silhouette) / 800).pixel);
    const std::optional<TopCorners> found = FindTopCorners(dense);
    ASSERT_TRUE(found.has_value());
    for (size_t c = 0; c < kTopCornerCount; ++c) {
      EXPECT_LT((found->pixel[c] - drawn.points.at(kNamesOnFront[c])).norm(), 0.012 * drawn.length_px)
          << kNamesOnFront[c] << " at " << tilt_deg;
    }
    EXPECT_NEAR(found->tilt * 180.0 / 3.14159265, tilt_deg, 1.0);
    EXPECT_LT(found->cost, 1.5);
  }
}

TEST(FindTopCorners, TheMirroredOutlineHasTheMirroredCorners) {
  const testing::DrawnTShirt drawn = testing::DrawTShirt({.image_side = 8, .tilt_deg = 9});
  Polygon outline;
  for (int i = 0; i < 800; ++i)
    outline.push_back(PlaceAt(drawn.silhouette, i * Perimeter(drawn.silhouette) / 800).pixel);
  Polygon mirrored;
  for (size_t i = outline.size(); i > 0; --i) mirrored.push_back({-outline[i - 1].x(), outline[i - 1].y()});
  const std::optional<TopCorners> a = FindTopCorners(outline);
  const std::optional<TopCorners> b = FindTopCorners(mirrored);
  ASSERT_TRUE(a && b);
  for (size_t c = 0; c < kTopCornerCount; ++c) {
    const Eigen::Vector2d& twin = b->pixel[kTopCornerCount - 1 - c];
    EXPECT_LT((a->pixel[c] - Eigen::Vector2d(-twin.x(), twin.y())).norm(), 0.01 * drawn.length_px) << c;
  }
}

TEST(FindTopCorners, OtherShapesCostMore) {
  const auto dense = [](const Polygon& shape) {
    Polygon points;
    for (int i = 0; i < 600; ++i) points.push_back(PlaceAt(shape, i * Perimeter(shape) / 600).pixel);
    return points;
  };
  const Polygon square = {{0, 0}, {400, 0}, {400, 500}, {0, 500}};
  const Polygon trousers = {{220, 60}, {380, 60}, {410, 540}, {320, 540}, {300, 220}, {280, 540}, {190, 540}};
  EXPECT_GT(ShapeCostOf(dense(square), GarmentKind::kTShirt), 3.6);
  EXPECT_GT(ShapeCostOf(dense(trousers), GarmentKind::kTShirt), 3.6);
  EXPECT_LT(ShapeCostOf(dense(testing::DrawTShirt({.image_side = 8}).silhouette), GarmentKind::kTShirt), 1.5);
}

// The sample's corners are round numbers: half widths of 240 (chest, hem), 80 (neck), 210 (shoulders) millimetres.
TEST(MeasureGarment, AgreesWithTheSamplesCoordinates) {
  const Garment garment = testing::MakeSampleTShirt();
  std::map<std::string, double> measures;
  for (const GarmentMeasure& measure : MeasureGarment(GarmentKind::kTShirt, garment.front, &*garment.back))
    measures[measure.name] = measure.value;
  EXPECT_NEAR(measures.at("neck_width"), 0.160, 1e-9);
  EXPECT_NEAR(measures.at("shoulder_width"), 0.420, 1e-9);
  EXPECT_NEAR(measures.at("hem_width"), 0.480, 1e-9);
  EXPECT_NEAR(measures.at("chest_width"), 2 * (0.240 - 0.005 * 25.0 / 190.0), 1e-9);
  EXPECT_NEAR(measures.at("waist_width"), 0.470, 1e-9);
  EXPECT_NEAR(measures.at("sleeve_length"), std::hypot(0.150, 0.095), 1e-9);
  EXPECT_NEAR(measures.at("sleeve_opening"), std::hypot(0.040, 0.100), 1e-9);
  EXPECT_NEAR(measures.at("front_length"), 0.680, 1e-9);
  EXPECT_NEAR(measures.at("back_length"), 0.680, 1e-9);
}

}  // namespace
}  // namespace fitroom::shop_catalog
