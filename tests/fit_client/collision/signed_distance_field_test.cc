#include "fit_client/fit/collision/signed_distance_field.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"

namespace fitroom {
namespace {

SignedDistanceField BuildField(const TriangleMesh& body, double pitch = 0.004) {
  SerialExecutor serial;
  SignedDistanceFieldOptions options;
  options.pitch = pitch;
  Result<SignedDistanceField> field = SignedDistanceField::Build(body, options, serial);
  EXPECT_TRUE(field.ok()) << field.status().ToString();
  return std::move(field).value();
}

TEST(SignedDistanceField, OfASphereIsDistanceToCentreMinusRadius) {
  const Eigen::Vector3d centre(0.1, -0.2, 0.05);
  const double radius = 0.1;
  const SignedDistanceField field = BuildField(testing::MakeSphere(centre, radius, 5));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.13, 0.13);
  for (int index = 0; index < 5000; ++index) {
    const Eigen::Vector3d point = centre + Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random));
    const double expected = (point - centre).norm() - radius;
    const SignedDistanceField::Sample sample = field.Query(point);
    const bool is_near = std::abs(expected) < 0.004;
    EXPECT_NEAR(sample.distance, expected, is_near ? 3e-4 : 5e-3) << point.transpose();
    if (is_near) {
      EXPECT_NEAR(field.ExactDistance(point), expected, 1e-4);
      EXPECT_GT(sample.gradient.normalized().dot((point - centre).normalized()), 0.995) << point.transpose();
    }
  }
}

TEST(SignedDistanceField, OfABoxKeepsSharpEdgesAndSigns) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.05, -0.04, -0.03), Eigen::Vector3d(0.06, 0.05, 0.04));
  const SignedDistanceField field = BuildField(testing::MakeBox(box, 7));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-0.08, 0.08);
  for (int index = 0; index < 5000; ++index) {
    const Eigen::Vector3d point(coordinate(random), coordinate(random), coordinate(random));
    const Eigen::Vector3d outside = (box.min() - point).cwiseMax(point - box.max());
    const double expected = (outside.array() > 0.0).any() ? outside.cwiseMax(0.0).norm() : outside.maxCoeff();
    if (std::abs(expected) < 0.004) {
      EXPECT_NEAR(field.ExactDistance(point), expected, 1e-5) << point.transpose();
      EXPECT_NEAR(field.Distance(point), expected, 1.5e-3) << point.transpose();
    } else {
      EXPECT_EQ(field.Distance(point) < 0.0, expected < 0.0) << point.transpose();
    }
  }
}

TEST(SignedDistanceField, OfATorusKnowsItsHoleFromItsTube) {
  const SignedDistanceField field = BuildField(testing::MakeTorus(0.1, 0.03, 160, 48));
  for (int step = 0; step < 400; ++step) {
    const double angle = 0.37 * step;
    const double r = 0.16 * step / 400.0;
    const double y = 0.035 * std::sin(1.7 * step);
    const Eigen::Vector3d point(r * std::cos(angle), y, r * std::sin(angle));
    const double expected = std::hypot(r - 0.1, y) - 0.03;
    EXPECT_NEAR(field.Distance(point), expected, std::abs(expected) < 0.004 ? 3e-4 : 5e-3) << point.transpose();
  }
}

TEST(SignedDistanceField, AFloorIsTheNearerOfBodyAndPlane) {
  const double radius = 0.1, floor = -0.06;
  SignedDistanceField field = BuildField(testing::MakeSphere(Eigen::Vector3d::Zero(), radius, 5));
  field.LayFloor(floor);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> coordinate(-0.13, 0.13);
  for (int index = 0; index < 2000; ++index) {
    const Eigen::Vector3d point(coordinate(random), coordinate(random), coordinate(random));
    const double to_sphere = point.norm() - radius, to_floor = point.y() - floor;
    const double expected = std::min(to_sphere, to_floor);
    if (std::abs(expected) > 0.004 || std::abs(to_sphere - to_floor) < 1e-3) continue;
    const SignedDistanceField::Sample sample = field.Query(point);
    EXPECT_NEAR(sample.distance, expected, 3e-4) << point.transpose();
    EXPECT_NEAR(field.ExactDistance(point), expected, 1e-4) << point.transpose();
    const Eigen::Vector3d away = to_floor < to_sphere ? Eigen::Vector3d::UnitY() : point.normalized();
    EXPECT_GT(sample.gradient.normalized().dot(away), 0.995) << point.transpose();
  }
}

TEST(SignedDistanceField, IsTheSameForAnyThreadCount) {
  const TriangleMesh body = testing::MakeTorus(0.1, 0.03, 60, 24);
  const SignedDistanceField serial = BuildField(body);
  for (const int thread_count : {2, 3}) {
    ThreadPool pool(thread_count);
    const Result<SignedDistanceField> parallel = SignedDistanceField::Build(body, {}, pool);
    ASSERT_TRUE(parallel.ok());
    for (int step = 0; step < 2000; ++step) {
      const Eigen::Vector3d point(0.15 * std::sin(step), 0.05 * std::sin(1.3 * step), 0.15 * std::cos(1.1 * step));
      ASSERT_EQ(serial.Distance(point), parallel->Distance(point));
    }
  }
}

TEST(SignedDistanceField, ARegionCutsTheFieldAndNotTheAnswers) {
  const Eigen::Vector3d centre(0.0, 0.0, 0.0);
  SerialExecutor serial;
  SignedDistanceFieldOptions options;
  options.region = Eigen::AlignedBox3d(Eigen::Vector3d(-0.2, 0.02, -0.2), Eigen::Vector3d(0.2, 0.2, 0.2));
  const TriangleMesh sphere = testing::MakeSphere(centre, 0.1, 5);
  const Result<SignedDistanceField> field = SignedDistanceField::Build(sphere, options, serial);
  ASSERT_TRUE(field.ok());
  for (double y = 0.03; y < 0.12; y += 0.01) {
    EXPECT_NEAR(field->Distance({0.0, y, 0.0}), y - 0.1, 3e-3);
    EXPECT_NEAR(field->Distance({0.03, y, 0.0}), std::hypot(y, 0.03) - 0.1, 3e-3);
  }
}

TEST(SignedDistanceField, RefusesWhatIsNotABody) {
  SerialExecutor serial;
  EXPECT_EQ(SignedDistanceField::Build({}, {}, serial).status().reason(), "BODY_WITHOUT_TRIANGLES");
  TriangleMesh body = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 1);
  body.triangles[3][1] = 100000;
  EXPECT_EQ(SignedDistanceField::Build(body, {}, serial).status().reason(), "BODY_INDEX_OUT_OF_RANGE");
  body = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 1);
  body.vertices[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(SignedDistanceField::Build(body, {}, serial).status().reason(), "BODY_COORDINATE_OUT_OF_RANGE");
  body = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 1);
  SignedDistanceFieldOptions options;
  options.region = Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
  EXPECT_EQ(SignedDistanceField::Build(body, options, serial).status().reason(), "BODY_OUT_OF_REACH");
}

}  // namespace
}  // namespace fitroom
