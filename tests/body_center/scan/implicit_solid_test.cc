#include "body_center/scan/implicit_solid.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "body_center/scan/random_source.h"
#include "body_center/scan/surface_nets.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

ImplicitSolid SolidOf(std::shared_ptr<const Shape> shape) {
  ImplicitSolid solid;
  solid.AddGroup(ImplicitSolid::Region::kTorso, 0.0);
  solid.Add(std::move(shape), 0.0);
  return solid;
}

double EnclosedVolume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const Vector3i& t : mesh.triangles) {
    const auto at = [&](int i) -> const Vector3d& { return mesh.vertices[static_cast<size_t>(t[i])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return volume;
}

TEST(Shapes, BallIsAnExactDistance) {
  const auto ball = MakeRoundCone({0, 1, 0}, 0.2, {0, 1.0001, 0}, 0.2);
  EXPECT_NEAR(ball->Evaluate({0.5, 1, 0}), 0.3, 1e-9);
  EXPECT_NEAR(ball->Evaluate({0, 1, 0.1}), -0.1, 1e-9);
}

TEST(Shapes, EllipsoidIsZeroOnItsSurfaceOnly) {
  const auto ellipsoid = MakeEllipsoid({1, 2, 3}, {0.1, 0.2, 0.3});
  for (const double angle : {0.0, 0.7, 1.9, 3.1}) {
    const Vector3d on(1 + 0.1 * std::cos(angle), 2 + 0.2 * std::sin(angle), 3);
    EXPECT_NEAR(ellipsoid->Evaluate(on), 0.0, 1e-12);
    EXPECT_LT(ellipsoid->Evaluate(Vector3d(1, 2, 3) + 0.9 * (on - Vector3d(1, 2, 3))), 0.0);
    EXPECT_GT(ellipsoid->Evaluate(Vector3d(1, 2, 3) + 1.1 * (on - Vector3d(1, 2, 3))), 0.0);
  }
}

// A sweep of equal circles is a cylinder: distance to its side and to its ends.
TEST(Shapes, SweepOfEqualCirclesIsACylinder) {
  const SweptSection low{0.0, Eigen::Vector2d::Zero(), 0.1, 0.1, 0.1, 2.0, 2.0};
  SweptSection high = low;
  high.position = 1.0;
  const auto cylinder = MakeSweep(Eigen::Isometry3d::Identity(), {low, high});
  EXPECT_NEAR(cylinder->Evaluate({0.3, 0.4, 0.5}), 0.4, 1e-12);
  EXPECT_NEAR(cylinder->Evaluate({0.06, 0.08, 0.5}), 0.0, 1e-12);
  EXPECT_NEAR(cylinder->Evaluate({0.05, 0.0, 0.5}), -0.05, 1e-12);
  EXPECT_NEAR(cylinder->Evaluate({0.0, 0.05, 1.2}), 0.2, 1e-12);
  EXPECT_NEAR(cylinder->Evaluate({0.4, 0.0, 1.4}), 0.5, 1e-12);
}

// A superellipse passes through (a cos^(2/n), b sin^(2/n)); front and back have their own depth and exponent.
TEST(Shapes, SweptSectionIsASuperellipse) {
  const SweptSection low{0.0, {0.02, -0.01}, 0.2, 0.15, 0.1, 2.6, 2.0};
  SweptSection high = low;
  high.position = 1.0;
  const auto sweep = MakeSweep(Eigen::Isometry3d::Identity(), {low, high});
  for (const double angle : {0.1, 0.6, 1.2, 1.5}) {
    const double power = 2.0 / 2.6;
    EXPECT_NEAR(sweep->Evaluate({0.02 + 0.2 * std::pow(std::cos(angle), power),
                                 -0.01 + 0.15 * std::pow(std::sin(angle), power), 0.5}),
                0.0, 1e-12);
    EXPECT_NEAR(sweep->Evaluate({0.02 - 0.2 * std::cos(angle), -0.01 - 0.1 * std::sin(angle), 0.5}), 0.0, 1e-12);
  }
}

TEST(ImplicitSolid, RestrictedSolidIsTheSameInsideItsBox) {
  ImplicitSolid solid;
  solid.AddGroup(ImplicitSolid::Region::kTorso, 0.0);
  solid.Add(MakeRoundCone({0, 0.5, 0}, 0.1, {0, 1.5, 0}, 0.05), 0.0);
  solid.AddGroup(ImplicitSolid::Region::kArm, 0.02);
  solid.Add(MakeRoundCone({0, 1.2, 0}, 0.04, {0.5, 0.9, 0}, 0.03), 0.0);
  const Eigen::AlignedBox3d box(Vector3d(-0.1, 0.5, -0.1), Vector3d(0.1, 0.6, 0.1));
  const ImplicitSolid local = solid.RestrictedTo(box);
  RandomSource random(3);
  for (int i = 0; i < 200; ++i) {
    const Vector3d point =
        box.min() + box.sizes().cwiseProduct(Vector3d(random.Uniform(), random.Uniform(), random.Uniform()));
    EXPECT_DOUBLE_EQ(local.Evaluate(point), solid.Evaluate(point));
  }
  EXPECT_EQ(solid.RegionAt({0.4, 0.95, 0}), ImplicitSolid::Region::kArm);
}

TEST(ImplicitSolid, EndsAtTheFloor) {
  const ImplicitSolid solid = SolidOf(MakeRoundCone({0, 0, 0}, 0.1, {0, 0.001, 0}, 0.1));
  EXPECT_NEAR(solid.Evaluate({0.0, -0.03, 0.0}), 0.03, 1e-9);
  EXPECT_LT(solid.Evaluate({0.0, 0.03, 0.0}), 0.0);
}

TEST(SurfaceNets, BallIsClosedRoundAndOfItsVolume) {
  constexpr double kRadius = 0.2;
  const TriangleMesh mesh =
      PolygoniseSurface(SolidOf(MakeEllipsoid({0.01, 0.5, 0.02}, Vector3d::Constant(kRadius))), 0.01);
  std::map<std::pair<int, int>, int> edges;
  for (const Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), edges.size() / 2 + 2);
  for (const Vector3d& vertex : mesh.vertices) {
    EXPECT_NEAR((vertex - Vector3d(0.01, 0.5, 0.02)).norm(), kRadius, 1e-5);
  }
  // Triangles' corners lie on the ball, so the mesh encloses a little less: about (spacing / radius)^2 / 4.
  const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  EXPECT_LT(EnclosedVolume(mesh), volume);
  EXPECT_GT(EnclosedVolume(mesh), 0.997 * volume);
}

// The generator's first numbers for the seed 1234567, from its authors' reference implementation.
TEST(RandomSource, IsSplitMix64) {
  RandomSource random(1234567);
  EXPECT_EQ(random.Uniform(), static_cast<double>(6457827717110365317u >> 11) * 0x1.0p-53);
  EXPECT_EQ(random.Uniform(), static_cast<double>(3203168211198807973u >> 11) * 0x1.0p-53);
}

}  // namespace
}  // namespace fitroom::body_center
