#include "fit_client/fit/panels/mesh_pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/photo_warp.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/panels/drawn_tshirt.h"

namespace fitroom {
namespace {

using testing::DrawGarment;
using testing::DrawnTShirt;

GarmentPattern CrumpledPattern() {
  Result<GarmentPattern> pattern = ReconcileViews(DrawGarment(
      DrawnTShirt(), {.tilt_deg = 5, .pixels_per_metre = 900, .sway = 0.004, .crumple = 0.001, .sleeve_turn_deg = 6},
      {.tilt_deg = -3, .pixels_per_metre = 1100, .sway = -0.003, .crumple = 0.001, .sleeve_turn_deg = -4}));
  EXPECT_TRUE(pattern.ok()) << pattern.status().ToString();
  return std::move(pattern).value();
}

struct Quality {
  double least_angle_deg = 180.0;
  double shortest_edge = std::numeric_limits<double>::infinity();
  double longest_edge = 0.0;
};

Quality QualityOf(const ClothMesh& mesh) {
  Quality quality;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = mesh.rest_positions[static_cast<size_t>(t[k])];
      const Eigen::Vector3d& b = mesh.rest_positions[static_cast<size_t>(t[(k + 1) % 3])];
      const Eigen::Vector3d& c = mesh.rest_positions[static_cast<size_t>(t[(k + 2) % 3])];
      quality.shortest_edge = std::min(quality.shortest_edge, (b - a).norm());
      quality.longest_edge = std::max(quality.longest_edge, (b - a).norm());
      const double cosine = (b - a).normalized().dot((c - a).normalized());
      quality.least_angle_deg = std::min(quality.least_angle_deg, std::acos(cosine) * 180.0 / M_PI);
    }
  }
  return quality;
}

class MeshPatternAtPitch : public ::testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    pattern_ = CrumpledPattern();
    Result<ClothMesh> mesh = MeshPattern(pattern_, GetParam());
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    mesh_ = std::move(mesh).value();
  }
  GarmentPattern pattern_;
  ClothMesh mesh_;
};

TEST_P(MeshPatternAtPitch, IsASphereWithFourHolesOnceSewn) {
  const ClothTopology topology = ComputeWeldedTopology(mesh_);
  EXPECT_EQ(topology.euler_characteristic(), -2);
  EXPECT_EQ(topology.boundary_loop_count, 4);
  EXPECT_EQ(topology.component_count, 1);
  EXPECT_TRUE(topology.is_manifold);
}

TEST_P(MeshPatternAtPitch, HasNoSliversAndEdgesOfAboutThePitch) {
  const Quality quality = QualityOf(mesh_);
  RecordProperty("particles", static_cast<int>(mesh_.rest_positions.size()));
  std::printf("pitch %.3f: %zu particles, %zu triangles, least angle %.1f, edges %.2f..%.2f\n", GetParam(),
              mesh_.rest_positions.size(), mesh_.triangles.size(), quality.least_angle_deg,
              quality.shortest_edge / GetParam(), quality.longest_edge / GetParam());
  EXPECT_GE(quality.least_angle_deg, 25.0);
  EXPECT_GE(quality.shortest_edge, 0.55 * GetParam());
  EXPECT_LE(quality.longest_edge, 1.6 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Pitches, MeshPatternAtPitch, ::testing::Values(0.02, 0.01, 0.005));

}  // namespace
}  // namespace fitroom
