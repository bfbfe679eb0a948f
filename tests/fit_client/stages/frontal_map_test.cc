#include "fit_client/fit/stages/frontal_map.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// A sphere of radius r about `centre` as a latitude-longitude mesh.
TriangleMesh MakeSphere(const Eigen::Vector3d& centre, double r) {
  constexpr int kRings = 60;
  constexpr int kSegments = 120;
  TriangleMesh mesh;
  for (int i = 0; i <= kRings; ++i) {
    for (int j = 0; j < kSegments; ++j) {
      const double theta = std::numbers::pi * i / kRings;
      const double phi = 2.0 * std::numbers::pi * j / kSegments;
      mesh.vertices.emplace_back(centre + r * Eigen::Vector3d(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                              std::sin(theta) * std::sin(phi)));
    }
  }
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSegments; ++j) {
      const int a = i * kSegments + j;
      const int b = i * kSegments + (j + 1) % kSegments;
      mesh.triangles.emplace_back(a, b, a + kSegments);
      mesh.triangles.emplace_back(b, b + kSegments, a + kSegments);
    }
  }
  return mesh;
}

TEST(FrontalMap, DepthOfASphereIsItsEquation) {
  const Eigen::Vector3d centre(0.1, 1.0, 0.05);
  const FrontalMap map(MakeSphere(centre, 0.2), 0.002);
  for (const double dx : {-0.1, 0.0, 0.05}) {
    for (const double dy : {-0.12, 0.0, 0.08}) {
      const double z = std::sqrt(0.04 - dx * dx - dy * dy);
      EXPECT_NEAR(map.FrontDepth(centre.x() + dx, centre.y() + dy, 0.0).value(), centre.z() + z, 0.003);
      EXPECT_NEAR(map.BackDepth(centre.x() + dx, centre.y() + dy, 0.0).value(), centre.z() - z, 0.003);
    }
  }
  EXPECT_FALSE(map.FrontDepth(centre.x() + 0.25, centre.y(), 0.0).has_value());
}

TEST(FrontalMap, DepthOverADiscIsTheExtremeInIt) {
  const FrontalMap map(MakeSphere({0.0, 1.0, 0.0}, 0.2), 0.002);
  const double at_edge = map.FrontDepth(0.1, 1.0, 0.0).value();
  EXPECT_NEAR(map.FrontDepth(0.1, 1.0, 0.03).value(), std::sqrt(0.04 - 0.07 * 0.07), 0.003);
  EXPECT_GT(map.FrontDepth(0.1, 1.0, 0.03).value(), at_edge);
}

TEST(FrontalMap, RowRunsAreTheChordsOfTheSpheresTheyCross) {
  TriangleMesh two = MakeSphere({-0.3, 1.0, 0.0}, 0.1);
  const TriangleMesh right = MakeSphere({0.3, 1.0, 0.0}, 0.15);
  const int offset = static_cast<int>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), right.vertices.begin(), right.vertices.end());
  for (const Eigen::Vector3i& triangle : right.triangles) two.triangles.emplace_back(triangle.array() + offset);
  const FrontalMap map(two, 0.002);
  const auto runs = map.RowRuns(1.0);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_NEAR(runs[0].begin, -0.4, 0.004);
  EXPECT_NEAR(runs[0].end, -0.2, 0.004);
  EXPECT_NEAR(runs[1].end - runs[1].begin, 0.3, 0.006);
  EXPECT_EQ(map.RowRuns(1.12).size(), 1u);
  EXPECT_NEAR(map.ColumnTop(0.3, 2.0).value(), 1.15, 0.004);
  EXPECT_NEAR(map.ColumnTop(0.3, 1.0).value(), 1.0, 0.004);
  EXPECT_FALSE(map.ColumnTop(0.0, 2.0).has_value());
}

}  // namespace
}  // namespace fitroom
