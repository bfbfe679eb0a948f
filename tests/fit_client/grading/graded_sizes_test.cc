#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/grading/grade.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/garment_shape.h"

// Sets of sizes with a known truth: the shop draws every size of a kind from its own measures. What is graded from size
// 12 must be what is drawn in the other size.

namespace fitroom {
namespace {

using shop_catalog::DrawnSizeChart;
using shop_catalog::GarmentShape;

constexpr double kPixelsPerCm = 12.0;

Eigen::Vector2d PixelOf(const Eigen::Vector2d& place) { return kPixelsPerCm * (place + Eigen::Vector2d(100.0, 10.0)); }

// A photograph without ground, folds or tilt: the shape's own outline.
GarmentView ViewOf(const GarmentShape& shape, GarmentSide side) {
  const bool front = side == GarmentSide::kFront;
  GarmentView view;
  view.side = side;
  view.metre_per_pixel = 0.01 / kPixelsPerCm;
  view.image_width = view.image_height = static_cast<int>(200 * kPixelsPerCm);
  std::vector<Eigen::Vector2d> outline = shape.outline;
  // The silhouette runs along the back neckline.
  if (front && !shape.front_neckline.empty()) {
    outline.erase(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(shape.back_neckline.size()));
    outline.insert(outline.begin(), shape.front_neckline.begin(), shape.front_neckline.end());
  }
  for (const Eigen::Vector2d& place : outline)
    view.outline.push_back(PixelOf({front ? place.x() : -place.x(), place.y()}));
  if (!front) std::reverse(view.outline.begin(), view.outline.end());
  for (const auto& [name, place] : PointsOnShape(shape, side)) view.points.push_back({name, PixelOf(place), 1.0});
  return view;
}

Result<GarmentPattern> DrawnPattern(GarmentKind kind, const GarmentSize& size) {
  const GarmentShape shape = shop_catalog::MakeGarmentShape(kind, size.measures);
  Garment garment;
  garment.kind = kind;
  garment.length = 0.01 * shape.length;
  garment.front = ViewOf(shape, GarmentSide::kFront);
  garment.back = ViewOf(shape, GarmentSide::kBack);
  return ReconcileViews(garment);
}

std::string KindName(const ::testing::TestParamInfo<GarmentKind>& info) {
  return std::string(GarmentKindName(info.param));
}

class GradedSizes : public ::testing::TestWithParam<GarmentKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, GradedSizes,
                         ::testing::Values(GarmentKind::kTShirt, GarmentKind::kLongSleeve, GarmentKind::kOnePiece,
                                           GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts,
                                           GarmentKind::kSleevedOnePiece),
                         KindName);

TEST_P(GradedSizes, AreThoseThatAreDrawn) {
  const Result<SizeChart> chart = DrawnSizeChart(GetParam(), "12", shop_catalog::ForkRule::kTrouser);
  ASSERT_TRUE(chart.ok()) << chart.status().ToString();
  const GarmentSize& from = *FindSize(*chart, "12");
  const Result<GarmentPattern> photographed = DrawnPattern(GetParam(), from);
  ASSERT_TRUE(photographed.ok()) << photographed.status().ToString();
  int compared = 0;
  for (const GarmentSize& to : chart->sizes) {
    const Result<GradedPattern> graded = GradePatternInDetail(*photographed, from, to);
    ASSERT_TRUE(graded.ok()) << to.name << " " << graded.status().ToString();
    EXPECT_TRUE(MeshPattern(graded->pattern, 0.02).ok()) << to.name;
    for (const GradedMeasure& measure : graded->measures) {
      if (!measure.given || measure.hidden) continue;
      EXPECT_LE(std::abs(measure.residual()), 0.002) << to.name << " " << measure.name;
    }
    // Drawn flat, the sleeves of the largest one-pieces lie on the torso: no outline to compare with.
    const Result<GarmentPattern> drawn = DrawnPattern(GetParam(), to);
    if (!drawn.ok()) continue;
    const std::vector<GarmentMeasure> truth = MeasurePattern(*drawn), made = MeasurePattern(graded->pattern);
    ++compared;
    double worst = 0.0;
    std::string worst_name;
    for (const GradedMeasure& measure : graded->measures) {
      if (!measure.given || measure.hidden) continue;
      const double error = MeasureValue(made, measure.name) - MeasureValue(truth, measure.name);
      EXPECT_NEAR(error, 0.0, 0.002) << to.name << " " << measure.name;
      if (std::abs(error) < std::abs(worst)) continue;
      worst = error;
      worst_name = measure.name;
    }
    std::printf("%-18s %2s  worst %5.1f mm %s\n", std::string(GarmentKindName(GetParam())).c_str(), to.name.c_str(),
                1000.0 * worst, worst_name.c_str());
  }
  EXPECT_GE(compared, 6);
}

// Trousers of every size: the fork from the size's stated measures, on the pattern graded to it.
TEST(GradedForks, AreBuiltInEverySizeByEveryRule) {
  for (const auto rule :
       {shop_catalog::ForkRule::kClose, shop_catalog::ForkRule::kTrouser, shop_catalog::ForkRule::kClassic}) {
    for (const GarmentKind kind : {GarmentKind::kPants, GarmentKind::kShorts}) {
      SCOPED_TRACE(std::string(GarmentKindName(kind)) + ", rule " + std::to_string(static_cast<int>(rule)));
      const Result<SizeChart> chart = DrawnSizeChart(kind, "12", rule);
      ASSERT_TRUE(chart.ok());
      const GarmentSize& from = *FindSize(*chart, "12");
      const Result<GarmentPattern> photographed = DrawnPattern(kind, from);
      ASSERT_TRUE(photographed.ok()) << photographed.status().ToString();
      Garment garment;
      garment.kind = kind;
      garment.chart = *chart;
      for (const GarmentSize& to : chart->sizes) {
        const Result<GarmentPattern> graded = GradePattern(*photographed, from, to);
        ASSERT_TRUE(graded.ok()) << graded.status().ToString();
        const Result<ForkedPattern> forked = BuildFork(*graded, EvidenceFrom(garment, &to));
        ASSERT_TRUE(forked.ok()) << to.name << " " << forked.status().ToString();
        EXPECT_FALSE(forked->extension_clamped) << to.name;
        EXPECT_LT(std::abs(forked->front_waist_raise), 0.01) << to.name;
        EXPECT_LT(std::abs(forked->back_waist_raise), 0.02) << to.name;
        for (const char* name : {"thigh_width", "front_rise", "back_rise"}) {
          EXPECT_NEAR(FindMeasure(forked->measures, name)->value, FindMeasure(to.measures, name)->value, 0.001) << name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace fitroom
