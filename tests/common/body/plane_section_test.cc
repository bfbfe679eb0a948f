#include "common/body/plane_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "common/body/polygon.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;

// An open tube round the Y axis through (x, z), with `side_count` sides and rings at every `pitch`.
void AddTube(TriangleMesh& mesh, Eigen::Vector2d centre, double radius, double height, int side_count, double pitch) {
  const int ring_count = static_cast<int>(std::lround(height / pitch)) + 1;
  const int base = static_cast<int>(mesh.vertices.size());
  for (int ring = 0; ring < ring_count; ++ring) {
    for (int side = 0; side < side_count; ++side) {
      const double angle = 2.0 * kPi * side / side_count;
      mesh.vertices.emplace_back(centre.x() + radius * std::cos(angle), ring * pitch,
                                 centre.y() + radius * std::sin(angle));
    }
  }
  for (int ring = 0; ring + 1 < ring_count; ++ring) {
    for (int side = 0; side < side_count; ++side) {
      const int a = base + ring * side_count + side;
      const int b = base + ring * side_count + (side + 1) % side_count;
      mesh.triangles.emplace_back(a, a + side_count, b);
      mesh.triangles.emplace_back(b, a + side_count, b + side_count);
    }
  }
}

double PolygonGirth(double radius, int side_count) { return 2.0 * side_count * radius * std::sin(kPi / side_count); }

std::vector<int> AllTriangles(const TriangleMesh& mesh) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(PlaneSection, OfACylinderHasItsGirthAndArea) {
  TriangleMesh mesh;
  AddTube(mesh, {0.1, -0.2}, 0.15, 1.0, 720, 0.02);
  const HeightIndex index(mesh, 50);
  for (const double height : {0.011, 0.5, 0.731, 0.999}) {
    const std::vector<SectionLoop> loops = index.CutAt(height, {});
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_NEAR(TapeLength(loops[0].points), 2.0 * kPi * 0.15, 1e-5);
    EXPECT_NEAR(loops[0].area, kPi * 0.15 * 0.15, 1e-5);
    EXPECT_NEAR((loops[0].centroid - Eigen::Vector2d(0.1, -0.2)).norm(), 0.0, 1e-9);
    EXPECT_EQ(loops[0].bridge_length, 0.0);
  }
}

TEST(PlaneSection, ThroughAnObliquePlaneIsAnEllipse) {
  TriangleMesh mesh;
  AddTube(mesh, {0.0, 0.0}, 0.1, 2.0, 720, 0.05);
  const double tilt = kPi / 3.0;
  SectionPlane plane;
  plane.origin = Eigen::Vector3d(0.0, 1.0, 0.0);
  plane.u = Eigen::Vector3d(std::cos(tilt), std::sin(tilt), 0.0);
  const std::vector<SectionLoop> loops = CutByPlane(mesh, AllTriangles(mesh), plane, {});
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(loops[0].area, kPi * 0.1 * 0.1 / std::cos(tilt), 1e-5);
  EXPECT_NEAR(loops[0].bounds.sizes().x(), 0.2 / std::cos(tilt), 1e-5);
  EXPECT_NEAR(loops[0].bounds.sizes().y(), 0.2, 1e-5);
}

TEST(PlaneSection, ThroughVerticesAndEdgesStaysClosed) {
  TriangleMesh mesh;
  AddTube(mesh, {0.0, 0.0}, 0.15, 1.0, 24, 0.25);
  const HeightIndex index(mesh, 7);
  for (const double height : {0.25, 0.25 + 1e-12, 0.25 - 1e-12, 0.5, 0.75}) {
    const std::vector<SectionLoop> loops = index.CutAt(height, {});
    ASSERT_EQ(loops.size(), 1u) << height;
    EXPECT_EQ(loops[0].bridge_length, 0.0) << height;
    EXPECT_NEAR(TapeLength(loops[0].points), PolygonGirth(0.15, 24), 1e-9) << height;
  }
}

TEST(PlaneSection, IgnoresDuplicateTrianglesAndWinding) {
  TriangleMesh mesh;
  AddTube(mesh, {0.0, 0.0}, 0.15, 1.0, 36, 0.1);
  const std::vector<SectionLoop> clean = HeightIndex(mesh, 20).CutAt(0.53, {});
  const size_t count = mesh.triangles.size();
  for (size_t i = 0; i < count; i += 3) mesh.triangles.push_back(mesh.triangles[i]);
  for (size_t i = 0; i < count; i += 2) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const std::vector<SectionLoop> torn = HeightIndex(mesh, 20).CutAt(0.53, {});
  ASSERT_EQ(torn.size(), 1u);
  EXPECT_NEAR(torn[0].area, clean[0].area, 1e-12);
  EXPECT_NEAR(ClosedLength(torn[0].points), ClosedLength(clean[0].points), 1e-12);
}

TEST(PlaneSection, ClosesHolesOfEachOutlineByItself) {
  // Two tubes 10 cm apart, each with a hole of 4 cm on the side that faces the other.
  TriangleMesh mesh;
  AddTube(mesh, {-0.15, 0.0}, 0.1, 0.5, 360, 0.1);
  AddTube(mesh, {0.15, 0.0}, 0.1, 0.5, 360, 0.1);
  std::erase_if(mesh.triangles, [&mesh](const Eigen::Vector3i& t) {
    const Eigen::Vector3d middle =
        (mesh.vertices[static_cast<size_t>(t[0])] + mesh.vertices[static_cast<size_t>(t[1])] +
         mesh.vertices[static_cast<size_t>(t[2])]) /
        3.0;
    return std::abs(middle.z()) < 0.02 && std::abs(middle.x()) < 0.15;
  });
  const std::vector<SectionLoop> loops = HeightIndex(mesh, 20).CutAt(0.25, {});
  ASSERT_EQ(loops.size(), 2u);
  for (const SectionLoop& loop : loops) {
    EXPECT_NEAR(loop.bridge_length, 0.04, 0.004);
    EXPECT_NEAR(loop.area, kPi * 0.01, 0.001);
  }
}

TEST(PlaneSection, DropsOutlinesBelowTheMinimum) {
  TriangleMesh mesh;
  AddTube(mesh, {0.0, 0.0}, 0.1, 0.5, 36, 0.1);
  AddTube(mesh, {1.0, 0.0}, 0.01, 0.5, 36, 0.1);
  SectionOptions options;
  options.min_area = 0.001;
  EXPECT_EQ(HeightIndex(mesh, 20).CutAt(0.25, options).size(), 1u);
  EXPECT_EQ(HeightIndex(mesh, 20).CutAt(0.25, {}).size(), 2u);
  EXPECT_TRUE(HeightIndex(mesh, 20).CutAt(0.75, {}).empty());
}

TEST(HeightIndex, FindsEveryTriangleOfARange) {
  TriangleMesh mesh;
  AddTube(mesh, {0.0, 0.0}, 0.1, 1.0, 12, 0.1);
  const HeightIndex index(mesh, 33);
  const std::vector<int> found = index.TrianglesBetween(0.42, 0.58);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    double low = 1e9;
    double high = -1e9;
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, mesh.vertices[static_cast<size_t>(mesh.triangles[i][k])].y());
      high = std::max(high, mesh.vertices[static_cast<size_t>(mesh.triangles[i][k])].y());
    }
    if (high >= 0.42 && low <= 0.58) {
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<int>(i)));
    }
  }
}

TEST(HeightIndex, TakesMeshesOfNothingOrWithoutHeight) {
  TriangleMesh mesh;
  EXPECT_TRUE(HeightIndex(mesh, 10).CutAt(0.0, {}).empty());
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(HeightIndex(mesh, 10).CutAt(0.0, {}).empty());
}

}  // namespace
}  // namespace fitroom
