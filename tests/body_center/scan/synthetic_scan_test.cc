#include "body_center/scan/synthetic_scan.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "body_center/scan/scan_defects.h"
#include "body_center/scan/solved_figure.h"
#include "body_center/scan/synthetic_scan_file.h"
#include "common/scan_file/scan_file.h"
#include "tests/body_center/scan/mesh_topology.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// Coarse enough for a test of under a second; girths of the coarse mesh are short by less than a millimetre.
constexpr int kCoarseCount = 16000;

SyntheticScan Make(const BodySpecification& specification, bool is_clean, int count = kCoarseCount) {
  SyntheticScanOptions options;
  options.is_clean = is_clean;
  options.target_vertex_count = count;
  Result<SyntheticScan> scan = SynthesizeScan(specification, options);
  EXPECT_TRUE(scan.ok()) << scan.status().ToString();
  return std::move(scan).value();
}

BodySpecification SpecificationCm(double stature, double bust, double waist, double hip, double arm_deg = 30.0) {
  BodySpecification specification;
  specification.stature = stature / 100;
  specification.bust = bust / 100;
  specification.waist = waist / 100;
  specification.hip = hip / 100;
  specification.arm_angle = arm_deg * std::numbers::pi / 180;
  return specification;
}

TEST(SolvedFigure, ArmsHangAtTheAngleAskedFor) {
  for (const double degrees : {15.0, 50.0}) {
    const Result<SolvedFigure> solved = SolveFigure(SpecificationCm(168, 88, 70, 95, degrees));
    ASSERT_TRUE(solved.ok()) << solved.status().ToString();
    const Vector3d arm = solved->figure.elbow - solved->figure.shoulder;
    EXPECT_NEAR(std::atan2(arm.x(), -arm.y()) * 180 / std::numbers::pi, degrees, 1e-6);
    // The middle of the forearm is inside the solid where the joints say it is.
    EXPECT_LT(solved->figure.solid.Evaluate(0.5 * (solved->figure.elbow + solved->figure.wrist)), -0.02);
  }
}

TEST(SyntheticScan, HasHolesAndIslandsAndATextureEverywhere) {
  const SyntheticScan scan = Make({}, /*is_clean=*/false);
  EXPECT_GT(testing::BoundaryEdges(scan.mesh), 100);
  EXPECT_GE(testing::ComponentCount(scan.mesh), 3);
  // The hole at the left armpit: nothing of the surface is within a centimetre of it.
  const Vector3d armpit = scan.landmarks[BodyLandmark::kArmpitLeft].position;
  for (const Vector3d& vertex : scan.mesh.vertices) EXPECT_GT((vertex - armpit).norm(), 0.010);

  ASSERT_EQ(scan.texture.triangles.size(), scan.mesh.triangles.size());
  const int count = static_cast<int>(scan.texture.coordinates.size());
  for (const Vector3i& t : scan.texture.triangles) ASSERT_TRUE(t.minCoeff() >= 0 && t.maxCoeff() < count);
  for (const Eigen::Vector2f& uv : scan.texture.coordinates) {
    ASSERT_TRUE(uv.minCoeff() >= 0.0F && uv.maxCoeff() <= 1.0F);
  }
}

TEST(SyntheticScan, SameSeedSameScan) {
  const SyntheticScan first = Make({}, false), again = Make({}, false);
  ASSERT_EQ(first.mesh.vertices.size(), again.mesh.vertices.size());
  for (size_t i = 0; i < first.mesh.vertices.size(); ++i) ASSERT_EQ(first.mesh.vertices[i], again.mesh.vertices[i]);
  EXPECT_EQ(first.mesh.triangles, again.mesh.triangles);
  EXPECT_EQ(first.texture.image.pixels, again.texture.image.pixels);
  EXPECT_NE(AddScanDefects(first.mesh, first.landmarks, 3).vertices,
            AddScanDefects(first.mesh, first.landmarks, 4).vertices);
}

struct BadSpecification {
  BodySpecification specification;
  std::string reason;
  std::string named;
};

TEST(BodySpecification, RefusesWhatNoBodyHasAndNamesTheOption) {
  BodySpecification bad_neck, not_a_number;
  bad_neck.neck = 0.10;
  not_a_number.waist = std::numeric_limits<double>::quiet_NaN();
  const std::vector<BadSpecification> cases = {
      {SpecificationCm(300, 88, 70, 95), "MEASUREMENT_OUT_OF_RANGE", "--stature-cm"},
      {SpecificationCm(168, 20, 70, 95), "MEASUREMENT_OUT_OF_RANGE", "--bust-cm"},
      {SpecificationCm(168, 88, 170, 95), "MEASUREMENT_OUT_OF_RANGE", "--waist-cm"},
      {SpecificationCm(168, 88, 70, 10), "MEASUREMENT_OUT_OF_RANGE", "--hip-cm"},
      {SpecificationCm(168, 88, 70, 95, 80), "MEASUREMENT_OUT_OF_RANGE", "--arm-angle-deg"},
      {bad_neck, "MEASUREMENT_OUT_OF_RANGE", "--neck-cm"},
      {not_a_number, "MEASUREMENT_OUT_OF_RANGE", "--waist-cm"},
      {SpecificationCm(168, 90, 50, 130), "MEASUREMENTS_DO_NOT_GO_TOGETHER", "waist / hip"},
  };
  for (const BadSpecification& bad : cases) {
    const Result<SyntheticScan> scan = SynthesizeScan(bad.specification, {});
    ASSERT_FALSE(scan.ok()) << bad.named;
    EXPECT_EQ(scan.status().code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(scan.status().reason(), bad.reason);
    EXPECT_NE(scan.status().message().find(bad.named), std::string::npos) << scan.status().message();
  }
}

// Written and read back through the product's readers: the same mesh, in the frame that each format promises.
TEST(SyntheticScanFile, ComesBackFromEveryFormat) {
  const testing::TemporaryFolder folder;
  const SyntheticScan scan = Make({}, false, 6000);
  const std::vector<std::pair<SyntheticScanFormat, std::string>> formats = {
      {SyntheticScanFormat::kAse, "a.ase"}, {SyntheticScanFormat::kPly, "b.ply"}, {SyntheticScanFormat::kObj, "c.obj"}};
  for (const auto& [format, name] : formats) {
    ASSERT_TRUE(WriteSyntheticScan(scan, format, folder.path() / name).ok());
    const Result<RawScan> read = ReadScanFile(folder.path() / name);
    ASSERT_TRUE(read.ok()) << read.status().ToString();
    ASSERT_EQ(read->mesh.vertices.size(), scan.mesh.vertices.size());
    EXPECT_EQ(read->mesh.triangles, scan.mesh.triangles);
    EXPECT_EQ(read->has_texture_coordinates(), format != SyntheticScanFormat::kPly);
    const bool is_ase = format == SyntheticScanFormat::kAse;
    for (size_t i = 0; i < scan.mesh.vertices.size(); i += 97) {
      const Vector3d& v = scan.mesh.vertices[i];
      const Vector3d expected = is_ase ? Vector3d(100 * v.x(), -100 * v.z(), 100 * v.y()) : v;
      EXPECT_LT((read->mesh.vertices[i] - expected).norm(), is_ase ? 1e-4 : 1e-6);
    }
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a_skin.jpg"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "c.mtl"));
}

}  // namespace
}  // namespace fitroom::body_center
