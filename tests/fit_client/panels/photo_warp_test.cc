#include "fit_client/fit/panels/photo_warp.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "tests/fit_client/panels/drawn_tshirt.h"

namespace fitroom {
namespace {

using testing::DrawGarment;
using testing::DrawnTShirt;

// Points inside a panel on a grid of the given step, at least half a step from the outline.
std::vector<Eigen::Vector2d> InsidePoints(const PanelPattern& panel, double step) {
  std::vector<Eigen::Vector2d> outline = JoinedPoints(panel);
  std::vector<Eigen::Vector2d> inside;
  for (double x = -0.5; x < 0.5; x += step) {
    for (double y = -0.8; y < 0.1; y += step) {
      if (panels::PolygonContains(outline, {x, y})) inside.emplace_back(x, y);
    }
  }
  return inside;
}

TEST(PhotoWarp, CarriesASimilarityOfTheOutlineOnToTheInside) {
  PanelPattern panel;
  panel.sections.resize(1);
  OutlineSection& section = panel.sections[0];
  section.points = {{0.3, 0.0}, {0.1, -0.1}, {-0.3, 0.0}, {-0.2, -0.5}, {0.25, -0.6}, {0.3, 0.0}};
  const auto photograph = [](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(400 + 900 * p.x() - 80 * p.y(), 50 - 80 * p.x() - 900 * p.y());
  };
  for (const Eigen::Vector2d& p : section.points) section.pixels.push_back(photograph(p));
  const PhotoWarp warp(panel);
  for (const Eigen::Vector2d& p : InsidePoints(panel, 0.03)) {
    EXPECT_NEAR((warp.PixelAt(p) - photograph(p)).norm(), 0.0, 1e-9) << p.transpose();
  }
}

TEST(PhotoWarp, PutsOutlineOnOutlineAndPointsOnPoints) {
  const Garment garment = DrawGarment(DrawnTShirt(), {.tilt_deg = 5, .crumple = 0.001}, {.tilt_deg = -4});
  const Result<GarmentPattern> pattern = ReconcileViews(garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  for (const auto& [panel, view] :
       {std::pair(&pattern->front, &garment.front), std::pair(&pattern->back, &*garment.back)}) {
    const PhotoWarp warp(*panel);
    for (const OutlinePoint& point : view->points) {
      const Eigen::Vector2d* place = FindPatternPoint(*panel, point.name);
      ASSERT_NE(place, nullptr) << point.name;
      EXPECT_NEAR((warp.PixelAt(*place) - point.pixel).norm(), 0.0, 1e-6) << point.name;
    }
    panels::Polyline drawn = view->outline;
    drawn.push_back(drawn.front());
    std::vector<Eigen::Vector2d> outline = JoinedPoints(*panel);
    outline.push_back(outline.front());
    for (size_t i = 1; i < outline.size(); ++i) {
      for (double t : {0.0, 0.3, 0.5}) {
        const Eigen::Vector2d pixel = warp.PixelAt((1.0 - t) * outline[i - 1] + t * outline[i]);
        EXPECT_LT(panels::DistanceToChain(pixel, drawn), 2.0) << outline[i].transpose();
      }
    }
  }
}

TEST(PhotoWarp, DoesNotFoldForAnOrdinaryLay) {
  const Garment garment =
      DrawGarment(DrawnTShirt(), {.tilt_deg = 5, .sway = 0.005, .crumple = 0.001, .sleeve_turn_deg = 6},
                  {.tilt_deg = -4, .pixels_per_metre = 600, .sway = -0.005, .crumple = 0.001, .sleeve_turn_deg = -6});
  const Result<GarmentPattern> pattern = ReconcileViews(garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  for (const PanelPattern* panel : {&pattern->front, &pattern->back}) {
    const PhotoWarp warp(*panel);
    // Pixels run down and, on the back, the other way: the front's map reverses the sense of turning, the back's not.
    const double sense = panel->side == GarmentSide::kFront ? -1.0 : 1.0;
    const double scale = panel->side == GarmentSide::kFront ? 1000.0 : 600.0;
    int count = 0;
    for (const Eigen::Vector2d& p : InsidePoints(*panel, 0.008)) {
      const double h = 1e-5;
      const Eigen::Vector2d dx = (warp.PixelAt(p + Eigen::Vector2d(h, 0)) - warp.PixelAt(p)) / h;
      const Eigen::Vector2d dy = (warp.PixelAt(p + Eigen::Vector2d(0, h)) - warp.PixelAt(p)) / h;
      const double jacobian = sense * (dx.x() * dy.y() - dx.y() * dy.x()) / (scale * scale);
      EXPECT_GT(jacobian, 0.3) << p.transpose();
      EXPECT_LT(jacobian, 3.0) << p.transpose();
      ++count;
    }
    EXPECT_GT(count, 3000);
  }
}

}  // namespace
}  // namespace fitroom
