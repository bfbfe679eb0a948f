#include "fit_client/fit/paper/voxel_grid.h"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "fit_client/fit/paper/collision_rule.h"
#include "tests/fit_client/collision/shapes.h"

namespace fitroom::paper {
namespace {

bool Holds(std::span<const int32_t> triangles, int32_t triangle) {
  return std::find(triangles.begin(), triangles.end(), triangle) != triangles.end();
}

TriangleMesh OneTriangle() {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.0, -0.1}};  // Faces up.
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(VoxelGrid, S25_ACentroidIsRegisteredInItsVoxelOnly) {
  const TriangleMesh mesh = OneTriangle();
  const Result<VoxelGrid> grid = VoxelGrid::Build(mesh, 0.01, Registration::kCentroid, 0.0);
  ASSERT_TRUE(grid.ok());
  const Eigen::Vector3d centroid(0.1 / 3.0, 0.0, -0.1 / 3.0);
  EXPECT_TRUE(Holds(grid->TrianglesAt(centroid), 0));
  EXPECT_TRUE(grid->TrianglesAt({0.001, 0.0, -0.001}).empty());
  EXPECT_TRUE(grid->TrianglesAt({5.0, 0.0, 0.0}).empty());
  EXPECT_EQ(grid->VoxelOf({5.0, 0.0, 0.0}), -1);
}

TEST(VoxelGrid, S25_OverlapFindsAtEveryPlaceOfATriangleThatTriangle) {
  const TriangleMesh sphere = testing::MakeSphere({0.1, 0.2, 0.3}, 0.1, 2);
  const Result<VoxelGrid> grid = VoxelGrid::Build(sphere, 0.007, Registration::kOverlap, 0.0);
  ASSERT_TRUE(grid.ok());
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (size_t triangle = 0; triangle < sphere.triangles.size(); ++triangle) {
    for (int sample = 0; sample < 5; ++sample) {
      const double u = uniform(random);
      const double v = uniform(random) * (1.0 - u);
      const Eigen::Vector3i& t = sphere.triangles[triangle];
      const Eigen::Vector3d place = (1.0 - u - v) * sphere.vertices[static_cast<size_t>(t[0])] +
                                    u * sphere.vertices[static_cast<size_t>(t[1])] +
                                    v * sphere.vertices[static_cast<size_t>(t[2])];
      EXPECT_TRUE(Holds(grid->TrianglesAt(place), static_cast<int32_t>(triangle))) << "seed 20";
    }
  }
}

// What the printed registration misses: a particle just under the corner of a polygon larger than a voxel.
TEST(VoxelGrid, S25_CentroidRegistrationMissesAContactThatOverlapFinds) {
  const TriangleMesh mesh = OneTriangle();
  const Eigen::Vector3d above(0.005, 0.001, -0.005);
  const Eigen::Vector3d below(0.005, -0.001, -0.005);
  const BodyCollider printed = BodyCollider::Build(mesh, 0.02, {Registration::kCentroid, false, 0.0}).value();
  const BodyCollider overlap = BodyCollider::Build(mesh, 0.02, {Registration::kOverlap, false, 0.0}).value();
  EXPECT_DOUBLE_EQ(printed.grid().voxel_size(), 0.01);  // Half of the cloth's pitch.
  EXPECT_FALSE(printed.FindContact(above, below).has_value());
  ASSERT_TRUE(overlap.FindContact(above, below).has_value());
  EXPECT_NEAR(overlap.FindContact(above, below)->distance, -0.001, 1e-12);
  const Eigen::Vector3d under_centroid(0.1 / 3.0, -0.001, -0.1 / 3.0);
  EXPECT_TRUE(printed.FindContact(under_centroid + Eigen::Vector3d(0, 0.002, 0), under_centroid).has_value() ||
              printed.grid().TrianglesAt(under_centroid).empty());
}

TEST(VoxelGrid, S25_RefusesWhatCannotBeHeld) {
  const TriangleMesh sphere = testing::MakeSphere({0.0, 0.0, 0.0}, 1.0, 1);
  EXPECT_EQ(VoxelGrid::Build(sphere, 1e-5, Registration::kCentroid, 0.0).status().reason(), "TOO_MANY_VOXELS");
  EXPECT_EQ(VoxelGrid::Build(sphere, 0.0, Registration::kCentroid, 0.0).status().reason(), "VOXEL_SIZE");
  EXPECT_EQ(VoxelGrid::Build({}, 0.01, Registration::kCentroid, 0.0).status().reason(), "BODY_EMPTY");
  TriangleMesh broken = sphere;
  broken.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(VoxelGrid::Build(broken, 0.01, Registration::kCentroid, 0.0).status().reason(), "BODY_NOT_FINITE");
  broken = sphere;
  broken.triangles[0][1] = 100000;
  EXPECT_EQ(VoxelGrid::Build(broken, 0.01, Registration::kCentroid, 0.0).status().reason(), "BODY_INDEX_OUT_OF_RANGE");
}

}  // namespace
}  // namespace fitroom::paper
