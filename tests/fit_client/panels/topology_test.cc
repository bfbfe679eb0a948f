#include "fit_client/fit/panels/topology.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// Two squares of two triangles each, one on the other:  3--2   7--6
//                                                       | /|   | /|
//                                                       0--1   4--5
ClothMesh TwoSquares() {
  ClothMesh mesh;
  for (int panel = 0; panel < 2; ++panel) {
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      mesh.rest_positions.emplace_back(x, y, 0);
      mesh.panel_of_particle.push_back(panel);
    }
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
  return mesh;
}

TEST(WeldedTopology, TwoDiscsBeforeSewing) {
  const ClothTopology topology = ComputeWeldedTopology(TwoSquares());
  EXPECT_EQ(topology.component_count, 2);
  EXPECT_EQ(topology.boundary_loop_count, 2);
  EXPECT_EQ(topology.euler_characteristic(), 2);  // 1 a disc.
}

TEST(WeldedTopology, OneSeamMakesADisc) {
  ClothMesh mesh = TwoSquares();
  mesh.seams = {{0, 4}, {1, 5}};
  const ClothTopology topology = ComputeWeldedTopology(mesh);
  EXPECT_EQ(topology.particle_count, 6);
  EXPECT_EQ(topology.component_count, 1);
  EXPECT_EQ(topology.boundary_loop_count, 1);
  EXPECT_EQ(topology.euler_characteristic(), 1);
  EXPECT_TRUE(topology.is_manifold);
}

TEST(WeldedTopology, TellsAnEdgeThatClosesOnItself) {
  ClothMesh mesh = TwoSquares();
  mesh.seams = {{0, 1}, {3, 2}};
  EXPECT_FALSE(ComputeWeldedTopology(mesh).is_manifold);
}

TEST(WeldedTopology, AStripSewnToItselfIsATube) {
  ClothMesh mesh;
  for (int i = 0; i < 4; ++i) {
    mesh.rest_positions.emplace_back(i, 0, 0);
    mesh.rest_positions.emplace_back(i, 1, 0);
  }
  for (int i = 0; i < 3; ++i) {
    mesh.triangles.emplace_back(2 * i, 2 * i + 2, 2 * i + 3);
    mesh.triangles.emplace_back(2 * i, 2 * i + 3, 2 * i + 1);
  }
  mesh.seams = {{0, 6}, {1, 7}};
  const ClothTopology tube = ComputeWeldedTopology(mesh);
  EXPECT_EQ(tube.boundary_loop_count, 2);
  EXPECT_EQ(tube.euler_characteristic(), 0);
  EXPECT_TRUE(tube.is_manifold);
}

TEST(WeldedTopology, AllSidesSewnMakeASphere) {
  ClothMesh mesh = TwoSquares();
  mesh.rest_positions.emplace_back(0.5, 0.5, 0);  // A middle each, so that the diagonals do not fall on each other.
  mesh.rest_positions.emplace_back(0.5, 0.5, 0);
  mesh.triangles = {{0, 1, 8}, {1, 2, 8}, {2, 3, 8}, {3, 0, 8}, {5, 4, 9}, {6, 5, 9}, {7, 6, 9}, {4, 7, 9}};
  mesh.seams = {{0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const ClothTopology topology = ComputeWeldedTopology(mesh);
  EXPECT_EQ(topology.boundary_loop_count, 0);
  EXPECT_EQ(topology.euler_characteristic(), 2);
  EXPECT_TRUE(topology.is_manifold);
  EXPECT_EQ(ComputeEulerCharacteristic(mesh), 2);
}

TEST(WeldedParticles, FollowsChainsOfSeamsToTheSmallest) {
  ClothMesh mesh = TwoSquares();
  mesh.seams = {{3, 7}, {7, 5}, {6, 2}};
  EXPECT_EQ(WeldedParticles(mesh), (std::vector<int>{0, 1, 2, 3, 4, 3, 2, 3}));
}

}  // namespace
}  // namespace fitroom
