#include "fit_client/fit/measure/cloth_strain.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace fitroom {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

ClothMesh OneTriangle() {
  ClothMesh cloth;
  cloth.rest_positions = {{0.0, 0.0, 0.0}, {0.011, 0.002, 0.0}, {0.004, 0.009, 0.0}};
  cloth.triangles = {{0, 1, 2}};
  cloth.panel_of_particle = {0, 0, 0};
  return cloth;
}

// Stretches the flat triangle by (1 + a) along `angle` and (1 + b) across, then turns it in space.
std::vector<Eigen::Vector3d> Stretched(const ClothMesh& cloth, double angle, double a, double b,
                                       const Eigen::Matrix3d& turn) {
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Matrix2d stretch = axes * Eigen::Vector2d(1.0 + a, 1.0 + b).asDiagonal() * axes.transpose();
  std::vector<Eigen::Vector3d> worn;
  for (const Eigen::Vector3d& p : cloth.rest_positions) {
    const Eigen::Vector2d flat = stretch * p.head<2>();
    worn.push_back(turn * Eigen::Vector3d(flat.x(), flat.y(), 0.0) + Eigen::Vector3d(1.0, 2.0, 3.0));
  }
  return worn;
}

TEST(ClothStrain, FindsTheStretchAndItsDirectionHoweverTheTriangleLies) {
  const ClothMesh cloth = OneTriangle();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (double angle_deg = -85.0; angle_deg < 90.0; angle_deg += 10.0) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized().toRotationMatrix();
    const auto worn = Stretched(cloth, angle_deg * kDegree, 0.12, -0.03, turn);
    const TriangleStrain strain = ComputeStrain(cloth, worn).front();
    EXPECT_NEAR(strain.largest, 0.12, 1e-9);
    EXPECT_NEAR(strain.smallest, -0.03, 1e-9);
    EXPECT_NEAR(strain.rest_angle, angle_deg * kDegree, 1e-7);
    const Eigen::Vector3d along =
        turn * Eigen::Vector3d(std::cos(angle_deg * kDegree), std::sin(angle_deg * kDegree), 0.0);
    EXPECT_NEAR(std::abs(strain.largest_direction.dot(along)), 1.0, 1e-9);
    EXPECT_NEAR(strain.smallest_direction.dot(along), 0.0, 1e-9);
  }
}

TEST(ClothStrain, OfARigidMotionIsNone) {
  const ClothMesh cloth = OneTriangle();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const TriangleStrain strain = ComputeStrain(cloth, Stretched(cloth, 0.3, 0.0, 0.0, turn)).front();
  EXPECT_NEAR(strain.largest, 0.0, 1e-7);
  EXPECT_NEAR(strain.smallest, 0.0, 1e-7);
}

TEST(ClothStrain, OfATriangleWithoutAreaOrPlaceIsZero) {
  ClothMesh cloth = OneTriangle();
  cloth.rest_positions[2] = 2.0 * cloth.rest_positions[1];
  EXPECT_EQ(ComputeStrain(cloth, cloth.rest_positions).front().rest_area, 0.0);
  cloth = OneTriangle();
  std::vector<Eigen::Vector3d> worn = cloth.rest_positions;
  worn[1].x() = std::nan("");
  EXPECT_EQ(ComputeStrain(cloth, worn).front().largest, 0.0);
  EXPECT_EQ(ComputeStrain(cloth, {}).size(), 1U);
}

// Plane stress of a sheet with Poisson's ratio nu = 1/3: T1 = Y (e1 + nu e2) / (1 - nu^2).
TEST(ClothTension, FollowsHookesLawInThePlaneAndNeverPushes) {
  TriangleStrain strain;
  strain.largest = 0.06;
  strain.smallest = -0.02;  // Free contraction: the strip's uniaxial law T = Y e.
  EXPECT_NEAR(ComputeTension(strain, 1000.0).largest, 60.0, 1e-9);
  EXPECT_NEAR(ComputeTension(strain, 1000.0).smallest, 0.0, 1e-9);
  strain.smallest = 0.06;  // Equal both ways: T = Y e / (1 - nu).
  EXPECT_NEAR(ComputeTension(strain, 1000.0).largest, 90.0, 1e-9);
  EXPECT_NEAR(ComputeTension(strain, 1000.0).smallest, 90.0, 1e-9);
  strain.smallest = -0.2;  // Wrinkled across: still the strip's law.
  EXPECT_NEAR(ComputeTension(strain, 1000.0).largest, 60.0, 1e-9);
  EXPECT_EQ(ComputeTension(strain, 1000.0).smallest, 0.0);
  strain.largest = -0.01;
  EXPECT_EQ(ComputeTension(strain, 1000.0).largest, 0.0);
}

}  // namespace
}  // namespace fitroom
