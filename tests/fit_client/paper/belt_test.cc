#include "fit_client/fit/paper/belt.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/scan_file/scan_file.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/paper/common_case.h"
#include "tests/support/test_data.h"

namespace fitroom::paper {
namespace {

TEST(Belt, S30_TapeOfAnEllipseHasItsPerimeter) {
  const TriangleMesh cone = testing::MakeEllipticCone(0.10, 0.20, 0.6, 0.0, 1.0, 360, 20);
  for (const double height : {0.21, 0.5, 0.77}) {
    const Result<Belt> belt = LayBelt(cone, height, PaperFrame::YUp());
    ASSERT_TRUE(belt.ok());
    const double a = 0.20 - 0.10 * height;
    EXPECT_NEAR(belt->length, testing::EllipsePerimeter(a, 0.6 * a), 2e-4 * belt->length);
    EXPECT_LT((belt->tape.front() - Eigen::Vector3d(0.0, height, 0.6 * a)).norm(), 1e-4);  // Centre front.
    EXPECT_GT(belt->At(0.01).x(), 0.0);                                                    // Over the left.
    EXPECT_LT((belt->At(0.25 * belt->length) - Eigen::Vector3d(a, height, 0.0)).norm(), 2e-3);
    EXPECT_LT((belt->At(0.5 * belt->length) - Eigen::Vector3d(0.0, height, -0.6 * a)).norm(), 1e-3);
    EXPECT_LT((belt->At(-0.25 * belt->length) - belt->At(0.75 * belt->length)).norm(), 1e-9);
  }
}

// The same body turned into a file's frame gives the same tape, turned.
TEST(Belt, S30_FollowsTheFrame) {
  const TriangleMesh cone = testing::MakeEllipticCone(0.10, 0.20, 0.6, 0.0, 1.0, 90, 10);
  TriangleMesh z_up = cone;
  for (Eigen::Vector3d& v : z_up.vertices) v = Eigen::Vector3d(v.x(), -v.z(), v.y());
  const Belt canonical = LayBelt(cone, 0.4, PaperFrame::YUp()).value();
  const Belt file = LayBelt(z_up, 0.4, PaperFrame::ZUp()).value();
  EXPECT_NEAR(file.length, canonical.length, 1e-9);
  for (const double distance : {0.0, 0.05, 0.2, 0.31}) {
    const Eigen::Vector3d p = canonical.At(distance);
    EXPECT_LT((file.At(distance) - Eigen::Vector3d(p.x(), -p.z(), p.y())).norm(), 1e-9);
  }
}

// A tape does not follow hollows and does not go round arms: of two columns the larger is taken.
TEST(Belt, S30_TakesTheOuterLoop) {
  TriangleMesh body = testing::MakeCylinder(0.1, 0.0, 1.0, 180, 4);
  const TriangleMesh arm = testing::MakeCylinder(0.03, 0.0, 1.0, 60, 4);
  const int first = static_cast<int>(body.vertices.size());
  for (const Eigen::Vector3d& v : arm.vertices) body.vertices.emplace_back(v + Eigen::Vector3d(0.2, 0.0, 0.0));
  for (const Eigen::Vector3i& t : arm.triangles) body.triangles.emplace_back(t + Eigen::Vector3i::Constant(first));
  EXPECT_NEAR(LayBelt(body, 0.5, PaperFrame::YUp())->length, 0.2 * M_PI, 1e-3);
  EXPECT_EQ(LayBelt(body, 1.5, PaperFrame::YUp()).status().reason(), "NO_BODY_AT_BELT");
}

TEST(Belt, S30_TheTopEdgeIsPlacedByItsShareOfTheWayRound) {
  const TriangleMesh column = testing::MakeCylinder(0.1, 0.0, 1.0, 360, 4);
  const Belt belt = LayBelt(column, 0.5, PaperFrame::YUp()).value();
  const std::vector<double> distances = {0.0, 0.2, 0.4, 0.7};  // On an edge of 0.8 m.
  const std::vector<Eigen::Vector3d> places = PlaceOnBelt(belt, distances, 0.8);
  for (size_t i = 0; i < places.size(); ++i) {
    const double angle = 2.0 * M_PI * distances[i] / 0.8;
    EXPECT_LT((places[i] - Eigen::Vector3d(0.1 * std::sin(angle), 0.5, 0.1 * std::cos(angle))).norm(), 1e-3) << i;
  }
}

// Cauchy's formula, a second method: the perimeter of a convex hull is the integral of its support function.
TEST(Belt, S30_TapeOfABodySectionHasTheLengthCauchySays) {
  FR_REQUIRE_TEST_DATA();
  const std::filesystem::path file = testing::TestDataFolder() / ".." / "peers" / "body13k.obj.zst";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Result<RawScan> scan = ReadScanFile(file);
  ASSERT_TRUE(scan.ok());
  const double height = 1.02;
  const Belt belt = LayBelt(scan->mesh, height, PaperFrame::ZUp()).value();
  std::vector<Eigen::Vector2d> cut;  // Where edges of the trunk pass the plane; arms hang farther out.
  for (const Eigen::Vector3i& t : scan->mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& p = scan->mesh.vertices[static_cast<size_t>(t[i])];
      const Eigen::Vector3d& q = scan->mesh.vertices[static_cast<size_t>(t[(i + 1) % 3])];
      if ((p.z() - height) * (q.z() - height) >= 0.0) continue;
      const Eigen::Vector3d place = p + (q - p) * ((height - p.z()) / (q.z() - p.z()));
      if (std::abs(place.x()) < 0.2) cut.emplace_back(place.x(), place.y());
    }
  }
  double perimeter = 0.0;
  const int directions = 3600;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * M_PI * i / directions;
    double support = -1e9;
    for (const Eigen::Vector2d& p : cut) support = std::max(support, p.x() * std::cos(angle) + p.y() * std::sin(angle));
    perimeter += support * 2.0 * M_PI / directions;
  }
  EXPECT_NEAR(belt.length, perimeter, 1e-4);
  EXPECT_GT(belt.length, 0.5);
  EXPECT_LT(belt.length, 1.1);
}

}  // namespace
}  // namespace fitroom::paper
