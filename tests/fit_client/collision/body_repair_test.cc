#include "fit_client/fit/collision/body_repair.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "fit_client/fit/collision/half_edges.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "tests/fit_client/collision/shapes.h"

namespace fitroom {
namespace {

bool IsClosedMesh(const TriangleMesh& mesh) { return IsClosed(mesh.triangles, mesh.vertices.size()); }

TEST(BodyRepair, LeavesAClosedSurfaceAlone) {
  const TriangleMesh sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 3);
  const Result<TriangleMesh> repaired = RepairBody(sphere);
  ASSERT_TRUE(repaired.ok());
  EXPECT_EQ(repaired->triangles, sphere.triangles);
}

TEST(BodyRepair, ClosesHolesDropsIslandsAndDoubles) {
  TriangleMesh sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 4);
  std::mt19937 random(3);
  // Holes: three caps, one of them large, and single triangles here and there.
  std::erase_if(sphere.triangles, [&](const Eigen::Vector3i& t) {
    const Eigen::Vector3d p = sphere.vertices[static_cast<size_t>(t[0])].normalized();
    return p.y() > 0.93 || p.x() < -0.98 || (p - Eigen::Vector3d(0.6, -0.8, 0)).norm() < 0.15 || random() % 211 == 0;
  });
  for (int index = 0; index < 20; ++index)
    sphere.triangles.push_back(sphere.triangles[static_cast<size_t>(index) * 31]);
  std::swap(sphere.triangles[5][0], sphere.triangles[5][1]);
  sphere.triangles.emplace_back(4, 4, 9);
  const TriangleMesh island = testing::MakeSphere({0.0, 0.0, 0.13}, 0.004, 1);
  for (const Eigen::Vector3i& t : island.triangles) {
    sphere.triangles.push_back(t.array() + static_cast<int>(sphere.vertices.size()));
  }
  sphere.vertices.insert(sphere.vertices.end(), island.vertices.begin(), island.vertices.end());

  const Result<TriangleMesh> repaired = RepairBody(sphere);
  ASSERT_TRUE(repaired.ok());
  EXPECT_TRUE(IsClosedMesh(*repaired));
  SerialExecutor serial;
  const Result<SignedDistanceField> field = SignedDistanceField::Build(*repaired, {}, serial);
  ASSERT_TRUE(field.ok());
  // The large cap is filled flat at y = 0.093; elsewhere the sphere is back. The island is gone.
  EXPECT_LT(field->Distance(Eigen::Vector3d::Zero()), -0.08);
  EXPECT_LT(field->Distance({0.0, 0.085, 0.0}), 0.0);
  EXPECT_GT(field->Distance({0.0, 0.0, 0.13}), 0.025);
  for (int step = 0; step < 500; ++step) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(std::sin(step * 1.7), std::cos(step * 0.9) * 0.8 - 0.15, std::cos(step * 2.3)).normalized();
    EXPECT_GT(field->Distance(direction * 0.104), 0.0) << direction.transpose();
    EXPECT_LT(field->Distance(direction * 0.088), 0.0) << direction.transpose();
  }
}

TEST(BodyRepair, JoinsVerticesThatAFormatHasSplit) {
  const TriangleMesh sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 3);
  TriangleMesh soup;
  for (const Eigen::Vector3i& t : sphere.triangles) {
    for (const int corner : t) soup.vertices.push_back(sphere.vertices[static_cast<size_t>(corner)]);
    const int last = static_cast<int>(soup.vertices.size());
    soup.triangles.emplace_back(last - 3, last - 2, last - 1);
  }
  const Result<TriangleMesh> repaired = RepairBody(soup);
  ASSERT_TRUE(repaired.ok());
  EXPECT_TRUE(IsClosedMesh(*repaired));
  EXPECT_EQ(repaired->triangles.size(), sphere.triangles.size());
}

TEST(BodyRepair, TurnsASurfaceThatFacesInwards) {
  TriangleMesh sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 3);
  for (Eigen::Vector3i& t : sphere.triangles) std::swap(t[0], t[1]);
  const Result<TriangleMesh> repaired = RepairBody(sphere);
  ASSERT_TRUE(repaired.ok());
  const Eigen::Vector3i& t = repaired->triangles.front();
  const Eigen::Vector3d& a = repaired->vertices[static_cast<size_t>(t[0])];
  const Eigen::Vector3d& b = repaired->vertices[static_cast<size_t>(t[1])];
  const Eigen::Vector3d& c = repaired->vertices[static_cast<size_t>(t[2])];
  EXPECT_GT((b - a).cross(c - a).dot(a), 0.0);
}

TEST(BodyRepair, RefusesWhatIsNotASurface) {
  EXPECT_EQ(RepairBody({}).status().reason(), "BODY_WITHOUT_TRIANGLES");
  TriangleMesh sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 1);
  sphere.triangles[0][0] = -1;
  EXPECT_EQ(RepairBody(sphere).status().reason(), "BODY_INDEX_OUT_OF_RANGE");
  sphere = testing::MakeSphere(Eigen::Vector3d::Zero(), 0.1, 1);
  sphere.vertices[2].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(RepairBody(sphere).status().reason(), "BODY_COORDINATE_OUT_OF_RANGE");
}

}  // namespace
}  // namespace fitroom
