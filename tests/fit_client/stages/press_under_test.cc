#include "fit_client/fit/stages/press_under.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/body/body.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/stages/tube_skirt.h"

namespace fitroom {
namespace {

using Eigen::Vector3d;

// A tube of cloth that stands round the Y axis from `top` downwards.
struct Tube {
  Tube(double radius, double top, double length, int rows)
      : cloth(testing::MakeTubeSkirt(M_PI * radius, M_PI * radius, length, 36, rows)) {
    for (size_t i = 0; i < cloth.rest_positions.size(); ++i) {
      const Vector3d& rest = cloth.rest_positions[i];
      const double angle = rest.x() / radius + 0.5 * M_PI;
      const double outward = cloth.panel_of_particle[i] == 0 ? 1.0 : -1.0;
      places.emplace_back(-radius * std::cos(angle), rest.y() + top, outward * radius * std::sin(angle));
    }
  }
  ClothMesh cloth;
  std::vector<Vector3d> places;
};

double FromAxis(const Vector3d& place) { return std::hypot(place.x(), place.z()); }

// A column of 8 cm, cloth of 12 cm that reaches 15 cm lower than the cloth of 10 cm over it.
struct ColumnInTwoTubes {
  TriangleMesh column = testing::MakeCylinder(0.08, -0.5, 0.5, 64, 40);
  Body body;
  Tube inner{0.12, 0.15, 0.35, 35};
  Tube outer{0.10, 0.15, 0.20, 20};
  std::vector<Vector3d> Press(const Tube& over) {
    SerialExecutor serial;
    return PressUnder({inner.cloth, inner.places}, {over.cloth, over.places}, {body, column, {}}, 0.004, serial)
        .value();
  }
};

TEST(PressUnder, WhatIsCoveredEndsBetweenBodyAndCover) {
  ColumnInTwoTubes all;
  const std::vector<Vector3d> pressed = all.Press(all.outer);
  int covered = 0;
  for (size_t i = 0; i < pressed.size(); ++i) {
    if (all.inner.places[i].y() < -0.03) continue;
    ++covered;
    EXPECT_LT(FromAxis(pressed[i]), 0.10) << i;
    EXPECT_GT(FromAxis(pressed[i]), 0.08) << i;
    EXPECT_NEAR(pressed[i].y(), all.inner.places[i].y(), 0.005) << i;
  }
  EXPECT_GT(covered, 500);
}

TEST(PressUnder, WhatHangsOutBelowStaysAndNothingIsTorn) {
  ColumnInTwoTubes all;
  const std::vector<Vector3d> pressed = all.Press(all.outer);
  for (size_t i = 0; i < pressed.size(); ++i) {
    if (all.inner.places[i].y() >= -0.12) continue;
    EXPECT_NEAR(FromAxis(pressed[i]), 0.12, 0.002) << i;
  }
  for (const Eigen::Vector3i& triangle : all.inner.cloth.triangles) {
    for (int k = 0; k < 3; ++k) {
      const size_t a = static_cast<size_t>(triangle[k]);
      const size_t b = static_cast<size_t>(triangle[(k + 1) % 3]);
      EXPECT_LT((pressed[a] - pressed[b]).norm(),
                1.5 * (all.inner.cloth.rest_positions[a] - all.inner.cloth.rest_positions[b]).norm());
    }
  }
}

TEST(PressUnder, UnderAWiderGarmentNothingMoves) {
  ColumnInTwoTubes all;
  const std::vector<Vector3d> pressed = all.Press(Tube(0.13, 0.15, 0.20, 20));
  for (size_t i = 0; i < pressed.size(); ++i) EXPECT_LT((pressed[i] - all.inner.places[i]).norm(), 1e-9) << i;
}

}  // namespace
}  // namespace fitroom
