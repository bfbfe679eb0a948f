#include "fit_client/fit/stages/panel_outline.h"

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// A front panel of `columns` x `rows` unit squares, particles row by row, corners named.
ClothMesh MakeSheet(int columns, int rows) {
  ClothMesh cloth;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      cloth.rest_positions.emplace_back(i, j, 0.0);
      cloth.panel_of_particle.push_back(0);
    }
  }
  const auto at = [columns](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      cloth.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      cloth.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  cloth.named_particles = {{"front/a", at(0, 0)}, {"front/b", at(columns, 0)}, {"front/c", at(columns, rows)}};
  return cloth;
}

TEST(PanelOutline, SectionTakesTheShorterWayInTheOrderAsked) {
  const ClothMesh cloth = MakeSheet(4, 2);
  const auto outline = PanelOutline::Trace(cloth, 0);
  ASSERT_TRUE(outline.ok());
  EXPECT_EQ(outline->Section("a", "b").value(), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(outline->Section("b", "a").value(), (std::vector<int>{4, 3, 2, 1, 0}));
  EXPECT_EQ(outline->Section("b", "c").value(), (std::vector<int>{4, 9, 14}));
  EXPECT_EQ(RestArcLengths(cloth, outline->Section("b", "c").value()), (std::vector<double>{0.0, 1.0, 2.0}));
}

TEST(PanelOutline, SaysWhichPointIsMissing) {
  const ClothMesh cloth = MakeSheet(2, 2);
  const auto outline = PanelOutline::Trace(cloth, 0);
  ASSERT_TRUE(outline.ok());
  const Status status = outline->Section("a", "underarm_L").status();
  EXPECT_EQ(status.reason(), "POINT_MISSING");
  EXPECT_NE(status.message().find("front/underarm_L"), std::string::npos);
}

TEST(PanelOutline, RefusesAPanelInTwoPiecesAndAnAbsentOne) {
  ClothMesh cloth = MakeSheet(1, 1);
  const ClothMesh second = MakeSheet(1, 1);
  for (const Eigen::Vector3i& triangle : second.triangles) cloth.triangles.emplace_back(triangle.array() + 4);
  cloth.rest_positions.insert(cloth.rest_positions.end(), second.rest_positions.begin(), second.rest_positions.end());
  cloth.panel_of_particle.insert(cloth.panel_of_particle.end(), 4, 0);
  EXPECT_EQ(PanelOutline::Trace(cloth, 0).status().reason(), "PANEL_OUTLINE");
  EXPECT_EQ(PanelOutline::Trace(cloth, 1).status().reason(), "PANEL_OUTLINE");
}

}  // namespace
}  // namespace fitroom
