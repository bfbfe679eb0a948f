#include "fit_client/fit/measure/garment_girth.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kColumns = 180;
constexpr int kRows = 20;

struct Draped {
  ClothMesh cloth;
  std::vector<Eigen::Vector3d> positions;
};

// A tube from y = 1 to y = 2, front panel 0 (z > 0), back panel 1, sewn at both sides. `radius` of height and angle.
// Rest x runs from -0.5 to 0.5 along each panel.
Draped MakeTube(const std::function<double(double y, double angle)>& radius) {
  Draped tube;
  for (int panel = 0; panel < 2; ++panel) {
    const int first = static_cast<int>(tube.positions.size());
    for (int row = 0; row <= kRows; ++row) {
      for (int column = 0; column <= kColumns; ++column) {
        const double u = static_cast<double>(column) / kColumns;
        const double y = 1.0 + static_cast<double>(row) / kRows;
        const double angle = kPi * (u - 0.5) + (panel == 0 ? 0.0 : kPi);
        const double r = radius(y, angle);
        tube.positions.emplace_back(r * std::sin(angle), y, r * std::cos(angle));
        tube.cloth.rest_positions.emplace_back(panel == 0 ? u - 0.5 : 0.5 - u, y, 0.0);
        tube.cloth.panel_of_particle.push_back(panel);
        const int index = first + row * (kColumns + 1) + column;
        if (row == kRows || column == kColumns) continue;
        tube.cloth.triangles.emplace_back(index, index + 1, index + kColumns + 2);
        tube.cloth.triangles.emplace_back(index, index + kColumns + 2, index + kColumns + 1);
      }
    }
  }
  const int panel_size = (kColumns + 1) * (kRows + 1);
  for (int row = 0; row <= kRows; ++row) {
    const int left = row * (kColumns + 1);
    tube.cloth.seams.push_back({left, panel_size + left + kColumns});
    tube.cloth.seams.push_back({left + kColumns, panel_size + left});
  }
  return tube;
}

// The perimeter of a regular polygon that is inscribed in a circle.
double PolygonPerimeter(double radius) { return 2.0 * (2 * kColumns) * radius * std::sin(kPi / (2 * kColumns)); }

TEST(GarmentGirth, OfACylinderIsItsCircumferenceAtEveryHeight) {
  const Draped tube = MakeTube([](double, double) { return 0.15; });
  for (const double height : {1.0 + 1e-12, 1.2, 1.25, 1.5 - 1e-12, 1.5, 1.5 + 1e-12, 1.777, 2.0 - 1e-12}) {
    const GarmentGirth girth = MeasureDrapedGirth(tube.cloth, tube.positions, height, {0.0, 0.0});
    ASSERT_TRUE(girth.found) << height;
    // On the way between two rings a triangle's diagonal cuts the corner: within 1e-5 of the polygon.
    EXPECT_NEAR(girth.girth, PolygonPerimeter(0.15), 1e-5) << height;
    EXPECT_NEAR(girth.hull_girth, PolygonPerimeter(0.15), 1e-4) << height;
    EXPECT_EQ(girth.bridged_length, 0.0);
  }
}

TEST(GarmentGirth, OfAConeGrowsWithItsRadius) {
  const Draped cone = MakeTube([](double y, double) { return 0.1 + 0.1 * (2.0 - y); });
  for (const double height : {1.1, 1.43, 1.9}) {
    const double expected = PolygonPerimeter(0.1 + 0.1 * (2.0 - height));
    EXPECT_NEAR(MeasureDrapedGirth(cone.cloth, cone.positions, height, {0.0, 0.0}).girth, expected, 2e-4 * expected);
  }
}

TEST(GarmentGirth, AFoldLengthensTheCurveAndNotTheTape) {
  // Four lobes inwards: the tape bridges them, the cloth runs along them.
  const Draped folded = MakeTube([](double, double angle) { return 0.15 - 0.02 * (1.0 + std::cos(8.0 * angle)); });
  double along = 0.0;  // The same curve, sampled finely.
  constexpr int kSteps = 100000;
  Eigen::Vector2d last(0.0, 0.15 - 0.04);
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = 2.0 * kPi * i / kSteps;
    const double r = 0.15 - 0.02 * (1.0 + std::cos(8.0 * angle));
    const Eigen::Vector2d point(r * std::sin(angle), r * std::cos(angle));
    along += (point - last).norm();
    last = point;
  }
  const GarmentGirth girth = MeasureDrapedGirth(folded.cloth, folded.positions, 1.5, {0.0, 0.0});
  EXPECT_NEAR(girth.girth, along, 2e-3 * along);
  EXPECT_LT(girth.hull_girth, 2.0 * kPi * 0.15);
  EXPECT_GT(girth.hull_girth, 16.0 * 0.15 * std::sin(kPi / 8.0) - 1e-3);  // The octagon of the lobes' tips.
  EXPECT_LT(girth.hull_girth, girth.girth);
}

TEST(GarmentGirth, AnOpenSeamIsBridgedAndSaidSo) {
  Draped tube = MakeTube([](double, double) { return 0.15; });
  for (size_t i = 0; i < tube.positions.size(); ++i) {
    tube.positions[i].z() += tube.cloth.panel_of_particle[i] == 0 ? 0.02 : -0.02;
  }
  const GarmentGirth girth = MeasureDrapedGirth(tube.cloth, tube.positions, 1.5, {0.0, 0.0});
  ASSERT_TRUE(girth.found);
  EXPECT_NEAR(girth.bridged_length, 0.08, 1e-6);
  EXPECT_NEAR(girth.girth, PolygonPerimeter(0.15) + 0.08, 1e-5);
}

TEST(GarmentGirth, SleevesAreLeftOut) {
  // The tube is torso between rest x -0.25 and 0.25 only: half of each panel's columns, the rest is "sleeve".
  Draped tube = MakeTube([](double, double) { return 0.15; });
  for (const Eigen::Vector3d& rest : tube.cloth.rest_positions) {
    tube.cloth.left_sleeve_weights.push_back(rest.x() > 0.25 ? 1.0 : 0.0);
    tube.cloth.right_sleeve_weights.push_back(rest.x() < -0.25 ? 1.0 : 0.0);
  }
  const GarmentGirth girth = MeasureDrapedGirth(tube.cloth, tube.positions, 1.5, {0.0, 0.0});
  ASSERT_TRUE(girth.found);
  // Two quarter circles, and two straight lines across the other quarters, up to half a column at each of the four
  // ends.
  EXPECT_NEAR(girth.girth, 0.5 * PolygonPerimeter(0.15) + 2.0 * std::sqrt(2.0) * 0.15, 6e-3);
  EXPECT_NEAR(girth.bridged_length, 2.0 * std::sqrt(2.0) * 0.15, 6e-3);
}

TEST(GarmentGirth, AHemThatThePlaneLeavesIsNotBridged) {
  // The lower edge rises to the back: at 1.05 the plane meets the front only.
  Draped tube = MakeTube([](double, double) { return 0.15; });
  for (Eigen::Vector3d& position : tube.positions) position.y() += 0.4 * (0.15 - position.z());
  EXPECT_FALSE(MeasureDrapedGirth(tube.cloth, tube.positions, 1.05, {0.0, 0.0}).found);
  EXPECT_TRUE(MeasureDrapedGirth(tube.cloth, tube.positions, 1.5, {0.0, 0.0}).found);
}

TEST(GarmentGirth, IsNotFoundWhereThereIsNoClothOrItDoesNotGoRound) {
  const Draped tube = MakeTube([](double, double) { return 0.15; });
  EXPECT_FALSE(MeasureDrapedGirth(tube.cloth, tube.positions, 0.9, {0.0, 0.0}).found);
  EXPECT_FALSE(MeasureDrapedGirth(tube.cloth, tube.positions, 2.1, {0.0, 0.0}).found);
  EXPECT_FALSE(MeasureDrapedGirth(tube.cloth, tube.positions, 1.5, {0.5, 0.0}).found);  // Beside the axis.
  EXPECT_FALSE(MeasureDrapedGirth(ClothMesh(), {}, 1.5, {0.0, 0.0}).found);
}

}  // namespace
}  // namespace fitroom
