#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fit_client/render/scene.h"
#include "fit_client/render/sky_visibility.h"

namespace fitroom::render {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A sphere of radius 0.5 m of 2 x rings x sectors triangles.
TriangleMesh MakeSphere(int rings, int sectors) {
  TriangleMesh mesh;
  for (int r = 0; r <= rings; ++r) {
    const double a = kPi * (static_cast<double>(r) / rings - 0.5);
    for (int s = 0; s < sectors; ++s) {
      const double b = 2.0 * kPi * s / sectors;
      mesh.vertices.emplace_back(0.5 * std::cos(a) * std::sin(b), 0.5 * std::sin(a), 0.5 * std::cos(a) * std::cos(b));
    }
  }
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      const int v = r * sectors + s;
      const int w = r * sectors + (s + 1) % sectors;
      mesh.triangles.emplace_back(v, w, w + sectors);
      mesh.triangles.emplace_back(v, w + sectors, v + sectors);
    }
  }
  return mesh;
}

TEST(DisplayBody, ALargeMeshIsReducedAndStaysOnItsSurface) {
  const TriangleMesh sphere = MakeSphere(200, 400);  // 160,000 triangles.
  const DisplayBody body = PrepareBody(sphere, 20000);
  EXPECT_LE(body.mesh.triangles.size(), 20500U);
  EXPECT_GE(body.mesh.triangles.size(), 15000U);
  ASSERT_EQ(body.normals.size(), body.mesh.vertices.size());
  for (const Eigen::Vector3i& t : body.mesh.triangles) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int corner : t) middle += body.mesh.vertices[static_cast<size_t>(corner)] / 3.0;
    EXPECT_NEAR(middle.norm(), 0.5, 1e-3);
  }
  for (size_t i = 0; i < body.normals.size(); ++i) {
    EXPECT_GT(body.normals[i].dot(body.mesh.vertices[i].normalized()), 0.99);
  }
}

TEST(DisplayBody, ASmallMeshIsKeptAndFloatingIslandsAreNot) {
  TriangleMesh mesh = MakeSphere(40, 80);
  const size_t triangle_count = mesh.triangles.size();
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{2.0, 2.0, 2.0}, {2.1, 2.0, 2.0}, {2.0, 2.1, 2.0}});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  const DisplayBody body = PrepareBody(mesh);
  EXPECT_EQ(body.mesh.triangles.size(), triangle_count);
  EXPECT_LT(ComputeBounds(body.mesh).max().x(), 0.6);
}

TEST(DisplayBody, NothingBecomesNothing) { EXPECT_TRUE(PrepareBody(TriangleMesh()).mesh.triangles.empty()); }

TEST(SkyVisibility, IsWholeOnAConvexBodyAndHalfBesideAWall) {
  const TriangleMesh sphere = MakeSphere(60, 120);
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(sphere);
  SkyVisibility alone(Eigen::Vector3d(-1.5, -1.5, -1.5), Eigen::Vector3d(1.5, 1.5, 1.5));
  alone.AddOccluder(sphere.vertices, sphere.triangles);
  for (const float value : alone.Compute(sphere.vertices, normals)) EXPECT_GT(value, 0.97F);

  // A high wall at z = 0 that looks at a point on the floor before it: half of the sky is gone, up to the directions'
  // weights.
  SkyVisibility walled(Eigen::Vector3d(-1.5, -1.5, -1.5), Eigen::Vector3d(1.5, 1.5, 1.5));
  std::vector<Eigen::Vector3d> wall;
  std::vector<Eigen::Vector3i> wall_triangles;
  constexpr int kSide = 28;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) wall.emplace_back(-1.4 + 0.1 * x, 0.05 * y, 0.0);
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x;
      wall_triangles.emplace_back(a, a + 1, a + kSide + 2);
      wall_triangles.emplace_back(a, a + kSide + 2, a + kSide + 1);
    }
  }
  walled.AddOccluder(wall, wall_triangles);
  const std::vector<Eigen::Vector3d> floor_point = {{0.0, 0.0, 0.05}};
  const std::vector<Eigen::Vector3d> up = {Eigen::Vector3d::UnitY()};
  EXPECT_NEAR(walled.Compute(floor_point, up)[0], 0.5F, 0.15F);
  // Far from the wall most of it is back.
  const std::vector<Eigen::Vector3d> far_point = {{0.0, 0.0, 1.4}};
  EXPECT_GT(walled.Compute(far_point, up)[0], 0.75F);
}

}  // namespace
}  // namespace fitroom::render
