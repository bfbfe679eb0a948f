#include "tests/fit_client/panels/landmarked_garments.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/support/test_data.h"

// Garments of every kind as shoppers photograph them, of the external test data: outlines of hand-drawn masks.

namespace fitroom {
namespace {

using testing::LandmarkedFile;
using testing::LandmarkedGarment;

std::string FileName(const ::testing::TestParamInfo<LandmarkedFile>& info) {
  const std::string file = info.param.file;
  const size_t slash = file.find('/');
  return file.substr(0, slash) + "_" + file.substr(slash + 1, 8);
}

class LandmarkedGarmentTest : public ::testing::TestWithParam<LandmarkedFile> {};

INSTANTIATE_TEST_SUITE_P(Files, LandmarkedGarmentTest, ::testing::ValuesIn(testing::LandmarkedFiles()), FileName);

TEST_P(LandmarkedGarmentTest, IsCutIntoGoodTrianglesAtEveryPitch) {
  FR_REQUIRE_TEST_DATA();
  const LandmarkedGarment read = testing::ReadLandmarkedGarment(GetParam());
  const Result<GarmentPattern> pattern = ReconcileViews(read.garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  // Legs were turned, by a few degrees in these photographs.
  EXPECT_NEAR(MeasureLength(*pattern), GetParam().length, HasLegs(GetParam().kind) ? 0.01 * GetParam().length : 1e-9);
  for (const double pitch : {0.04, 0.02, 0.01, 0.005}) {
    SCOPED_TRACE(pitch);
    const Result<ClothMesh> mesh = MeshPattern(*pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    EXPECT_EQ(ComputeEulerCharacteristic(*mesh), ExpectedEulerCharacteristic(GetParam().kind));
    double least_angle = 180.0, shortest = 1.0, longest = 0.0;
    int turned_count = 0;
    Eigen::Vector3d sharpest_place = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3i& t : mesh->triangles) {
      const auto texture = [&](int k) { return mesh->texture_coordinates[static_cast<size_t>(t[k])]; };
      const auto rest = [&](int k) { return mesh->rest_positions[static_cast<size_t>(t[k])]; };
      const Eigen::Vector2d u = texture(1) - texture(0), v = texture(2) - texture(0);
      if (u.x() * v.y() - u.y() * v.x() >= 0.0) ++turned_count;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = rest((k + 1) % 3) - rest(k), b = rest((k + 2) % 3) - rest(k);
        shortest = std::min(shortest, a.norm() / pitch);
        longest = std::max(longest, a.norm() / pitch);
        const double angle = std::acos(a.normalized().dot(b.normalized())) * 180.0 / M_PI;
        if (angle < least_angle) sharpest_place = rest(k);
        least_angle = std::min(least_angle, angle);
      }
    }
    EXPECT_EQ(turned_count, 0);
    EXPECT_GE(least_angle, 24.0) << "at " << sharpest_place.transpose();
    EXPECT_GE(shortest, 0.5);
    EXPECT_LE(longest, 1.65);
  }
}

// A second method beside the outline: counting pixels. Left and right are averaged, which keeps the area but for
// creases; the inside of the back neck is not part of the front.
TEST_P(LandmarkedGarmentTest, HasTheAreaOfItsMask) {
  FR_REQUIRE_TEST_DATA();
  const LandmarkedGarment read = testing::ReadLandmarkedGarment(GetParam());
  const Result<GarmentPattern> pattern = ReconcileViews(read.garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  double pixel_count = 0.0;
  for (int y = 0; y < read.mask.height; ++y) {
    for (int x = 0; x < read.mask.width; ++x) pixel_count += read.mask.at(x, y)[0] > 127 ? 1.0 : 0.0;
  }
  const double scale = read.garment.front.metre_per_pixel;
  const double area = panels::SignedArea(JoinedPoints(pattern->front));
  // A hanger's clips cut notches into one skirt's mask, which the smooth outline bridges.
  const bool clipped = read.name.find("6d210194") != std::string::npos;
  EXPECT_NEAR(area / (pixel_count * scale * scale), 1.0, clipped ? 0.06 : 0.025);
}

}  // namespace
}  // namespace fitroom
