#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "body_center/scan/synthetic_scan.h"
#include "common/body/analyse_scan.h"
#include "tests/body_center/scan/mesh_section.h"
#include "tests/body_center/scan/mesh_topology.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;

BodySpecification SpecificationCm(double stature, double bust, double waist, double hip, double arm_deg = 30.0) {
  BodySpecification specification;
  specification.stature = stature / 100;
  specification.bust = bust / 100;
  specification.waist = waist / 100;
  specification.hip = hip / 100;
  specification.arm_angle = arm_deg * std::numbers::pi / 180;
  return specification;
}

class SyntheticBody : public ::testing::TestWithParam<BodySpecification> {};

// Waist: the smallest girth between bust and hip. Hip: the largest between waist and crotch. Bust: at the
// bust points. All measured on the mesh by a second method.
TEST_P(SyntheticBody, IsClosedAndHasTheGirthsAndTheStatureAskedFor) {
  const BodySpecification asked = GetParam();
  SyntheticScanOptions options;
  options.is_clean = true;
  const Result<SyntheticScan> made = SynthesizeScan(asked, options);
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  const TriangleMesh& mesh = made->mesh;
  const double scale = asked.stature / 1.68;
  const double armpit = made->landmarks[BodyLandmark::kArmpitLeft].position.y();
  double waist = 1e9, hip = 0.0;
  for (double y = 1.00; y <= 1.14; y += 0.01) waist = std::min(waist, testing::TrunkGirth(mesh, y * scale));
  for (double y = 0.83; y <= 0.98; y += 0.01) hip = std::max(hip, testing::TrunkGirth(mesh, y * scale));
  // Arms that hang close, or are thick, are part of the section at the bust: there is no loop to measure then.
  const double bust_height = made->landmarks[BodyLandmark::kBustPointLeft].position.y();
  if (bust_height < armpit - 0.005) {
    EXPECT_NEAR(testing::TrunkGirth(mesh, bust_height), asked.bust, 0.005);
  } else {
    EXPECT_TRUE(asked.arm_angle < 0.35 || asked.bust > 1.1);
  }
  EXPECT_NEAR(waist, asked.waist, 0.005);
  EXPECT_NEAR(hip, asked.hip, 0.005);
  const Eigen::AlignedBox3d bounds = ComputeBounds(mesh);
  EXPECT_NEAR(bounds.sizes().y(), asked.stature, 0.002);
  EXPECT_NEAR(bounds.min().y(), 0.0, 0.001);

  const testing::EdgeCounts edges = testing::CountEdges(mesh);
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(testing::ComponentCount(mesh), 1);

  // At the density of water the body weighs what a woman of that height does: body mass index 15 to 45.
  double volume = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto at = [&](int i) -> const Vector3d& { return mesh.vertices[static_cast<size_t>(t[i])]; };
    volume += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  EXPECT_GT(1000.0 * volume / (asked.stature * asked.stature), 15.0);
  EXPECT_LT(1000.0 * volume / (asked.stature * asked.stature), 45.0);
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), edges.size() / 2 + 2) << "not a sphere";
}

INSTANTIATE_TEST_SUITE_P(Specifications, SyntheticBody,
                         ::testing::Values(SpecificationCm(168, 88, 70, 95), SpecificationCm(150, 76, 58, 84),
                                           SpecificationCm(160, 92, 64, 100), SpecificationCm(180, 100, 85, 110),
                                           SpecificationCm(165, 120, 105, 125), SpecificationCm(190, 84, 66, 92, 15),
                                           SpecificationCm(168, 88, 70, 95, 60)));

// The whole scan, as the command makes it, and as the finder of landmarks sees it, who knows nothing of how it is made.
TEST(SyntheticScanWhole, HasTheCountsOfAScanAndItsLandmarksAreFound) {
  const Result<SyntheticScan> made = SynthesizeScan({}, {});
  ASSERT_TRUE(made.ok()) << made.status().ToString();
  const SyntheticScan& scan = *made;
  EXPECT_NEAR(static_cast<double>(scan.mesh.vertices.size()), 121000, 4000);
  EXPECT_GE(scan.mesh.triangles.size(), 240000u);
  EXPECT_LE(scan.mesh.triangles.size(), 260000u);
  const Result<BodyAnalysis> analysis = AnalyseScan(scan.mesh, {});
  ASSERT_TRUE(analysis.ok()) << analysis.status().ToString();
  EXPECT_NEAR(analysis->body.measurements.bust.girth, 0.88, 0.009);
  EXPECT_NEAR(analysis->body.measurements.waist.girth, 0.70, 0.009);
  EXPECT_NEAR(analysis->body.measurements.hip.girth, 0.95, 0.009);
  const Similarity file_from_canonical = analysis->canonical_from_file.Inverse();
  for (const auto& [landmark, limit] :
       std::vector<std::pair<BodyLandmark, double>>{{BodyLandmark::kFrontNeck, 0.035},
                                                    {BodyLandmark::kCrotch, 0.015},
                                                    {BodyLandmark::kArmpitLeft, 0.025},
                                                    {BodyLandmark::kAcromionRight, 0.025}}) {
    const Vector3d found = file_from_canonical * analysis->body.landmarks[landmark].position;
    EXPECT_LT((found - scan.landmarks[landmark].position).norm(), limit) << LandmarkName(landmark);
  }
}

}  // namespace
}  // namespace fitroom::body_center
