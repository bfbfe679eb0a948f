#include <charconv>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "common/scan_file/scan_file.h"
#include "fit_client/fit/solver/drape.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

// The T-shirt of two flat panels that other programs are measured on, at 2 cm and 1 cm.
class DrapePeers : public ::testing::TestWithParam<const char*> {};

TEST_P(DrapePeers, TheShirtIsWorn) {
  FR_REQUIRE_TEST_DATA();
  const std::filesystem::path folder = testing::TestDataFolder() / ".." / "peers";
  if (!std::filesystem::exists(folder)) {
    ASSERT_EQ(std::getenv("FITROOM_REQUIRE_TEST_DATA"), nullptr) << "required but missing: " << folder;
    GTEST_SKIP() << "no folder of other programs' cases: " << folder;
  }
  const Result<RawScan> body = ReadScanFile(folder / "body13k.obj.zst");
  const Result<RawScan> panels = ReadScanFile(folder / (std::string("shirt_") + GetParam() + ".obj"));
  ASSERT_TRUE(body.ok() && panels.ok());
  ClothMesh mesh;
  mesh.rest_positions = panels->mesh.vertices;
  mesh.triangles = panels->mesh.triangles;
  std::ifstream seams(folder / (std::string("shirt_") + GetParam() + "_seams.txt"));
  for (SeamPair pair; seams >> pair.a >> pair.b;) mesh.seams.push_back(pair);
  ASSERT_GT(mesh.seams.size(), 50u);

  ThreadPool pool(2);
  const Result<SignedDistanceField> field = SignedDistanceField::Build(body->mesh, {}, pool);
  ASSERT_TRUE(field.ok());
  DrapeOptions options;
  options.gravity = -9.81 * Eigen::Vector3d::UnitZ();
  const Result<DrapeResult> result = Drape(mesh, mesh.rest_positions, *field, options, pool, {});
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  const DrapeReport& report = result->report;
  EXPECT_EQ(report.outcome, DrapeOutcome::kAtRest) << report.finishing_reason;
  EXPECT_EQ(report.particles_inside + report.samples_inside, 0);
  EXPECT_LT(report.final_seam_gap_max, 0.0005);
  EXPECT_LT(report.strain_max, 0.08);
  EXPECT_LT(report.strain_p95, 0.02);
  EXPECT_LT(report.speed_p99, 0.02);
  EXPECT_LE(report.self_crossing_count, 10);
  // Worn: the shoulders lie on the shoulders, and the hem hangs level. The body's shoulders are about 1.45 m high.
  double top = -1.0;
  double lowest = 10.0;
  double highest_hem = -1.0;
  for (size_t vertex = 0; vertex < mesh.rest_positions.size(); ++vertex) {
    top = std::max(top, result->positions[vertex].z());
    lowest = std::min(lowest, result->positions[vertex].z());
  }
  double rest_hem = 10.0;
  for (const Eigen::Vector3d& rest : mesh.rest_positions) rest_hem = std::min(rest_hem, rest.z());
  for (size_t vertex = 0; vertex < mesh.rest_positions.size(); ++vertex) {
    if (mesh.rest_positions[vertex].z() < rest_hem + 1e-6) {
      highest_hem = std::max(highest_hem, result->positions[vertex].z());
    }
  }
  EXPECT_LT(highest_hem - lowest, 0.03);
  EXPECT_NEAR(top, 1.5, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Pitch, DrapePeers, ::testing::Values("0.02", "0.01"));

}  // namespace
}  // namespace fitroom
