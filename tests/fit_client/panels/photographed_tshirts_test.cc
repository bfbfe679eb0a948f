#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/file.h"
#include "common/image/decode.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "shop_catalog/garment/extract_garment.h"
#include "tests/support/test_data.h"

// Seven T-shirts photographed from both sides, of the external test data: extracted, reconciled and cut.

namespace fitroom {
namespace {

constexpr double kLength = 0.68;  // (unit: metre)

std::string Bytes(const std::string& file) {
  Result<std::string> bytes = ReadFile(testing::TestDataFolder() / "garments" / "tshirt" / file, 50'000'000);
  EXPECT_TRUE(bytes.ok()) << bytes.status().ToString();
  return bytes.ok() ? *bytes : std::string();
}

Garment Extracted(const std::string& name) {
  const std::string front = Bytes(name + "-front.png"), back = Bytes(name + "-back.png");
  shop_catalog::ExtractionRequest request;
  request.id = name;
  request.length = kLength;
  request.front_photo = front;
  request.back_photo = back;
  Result<shop_catalog::GarmentExtraction> extraction = shop_catalog::ExtractGarment(request);
  EXPECT_TRUE(extraction.ok()) << extraction.status().ToString();
  return extraction.ok() ? extraction->garment : Garment();
}

// Between these shares of the height there is torso alone, from below the sleeves to above the hem.
constexpr double kTorsoTop = 0.7;
constexpr double kTorsoBottom = 0.9;

// What counting the pixels of a mask gives: a second method beside the outline.
struct CountedMask {
  double height = 0.0;       // From the highest point of each half straight down to the hem, mean (unit: pixel).
  double torso_width = 0.0;  // Mean (unit: pixel).
};

CountedMask CountMask(const std::string& mask_file) {
  CountedMask counted;
  Result<Image> mask = DecodeImage(Bytes(mask_file));
  EXPECT_TRUE(mask.ok()) << mask.status().ToString();
  if (!mask.ok()) return counted;
  std::vector<int> widths;  // Of the rows with any garment, from the top.
  for (int y = 0; y < mask->height; ++y) {
    int width = 0;
    for (int x = 0; x < mask->width; ++x) width += mask->at(x, y)[0] > 127 ? 1 : 0;
    if (width > 0) widths.push_back(width);
  }
  for (int half = 0; half < 2; ++half) {
    int best_top = mask->height, best_bottom = 0;
    for (int x = half * mask->width / 2; x < (half + 1) * mask->width / 2; ++x) {
      int top = mask->height, bottom = 0;
      for (int y = 0; y < mask->height; ++y) {
        if (mask->at(x, y)[0] <= 127) continue;
        top = std::min(top, y);
        bottom = y + 1;
      }
      if (top < best_top) std::tie(best_top, best_bottom) = std::pair(top, bottom);
    }
    counted.height += 0.5 * (best_bottom - best_top);
  }
  double count = 0.0;
  for (double row = kTorsoTop * counted.height; row < kTorsoBottom * counted.height; ++row) {
    counted.torso_width += widths[static_cast<size_t>(row)];
    ++count;
  }
  counted.torso_width /= count;
  return counted;
}

// The mean width of the pattern over the torso (unit: metre).
double PatternTorsoWidth(const GarmentPattern& pattern) {
  double sum = 0.0, count = 0.0;
  for (const Eigen::Vector2d& p : FindSection(pattern.front, "side_L")->points) {
    if (p.y() > -kTorsoTop * kLength || p.y() < -kTorsoBottom * kLength) continue;
    sum += 2.0 * p.x();  // Left and right mirror each other.
    ++count;
  }
  return sum / count;
}

class PhotographedTShirt : public ::testing::TestWithParam<const char*> {};

// One test a shirt, because the extraction takes far longer than everything after it.
TEST_P(PhotographedTShirt, BecomesOneGarmentOfPlausibleSizeThatShowsOnlyItself) {
  FR_REQUIRE_TEST_DATA();
  const std::string name = std::string("saleor-") + GetParam();
  const Garment garment = Extracted(name);
  const Result<GarmentPattern> pattern = ReconcileViews(garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  EXPECT_FALSE(pattern->asymmetric_by_design);

  const std::vector<GarmentMeasure> measures = MeasurePattern(*pattern);
  EXPECT_NEAR(MeasureLength(*pattern) / kLength, 1.0, 0.01);
  const CountedMask front = CountMask(name + "-front.mask.png"), back = CountMask(name + "-back.mask.png");
  const double counted = 0.5 * kLength * (front.torso_width / front.height + back.torso_width / back.height);
  // The pixels are counted down to the hem below the shoulder; the length reaches to the hem's corners.
  EXPECT_NEAR(PatternTorsoWidth(*pattern) / counted, 1.0, 0.015);
  EXPECT_GT(MeasureValue(measures, "sleeve_length"), 0.12);
  EXPECT_LT(MeasureValue(measures, "sleeve_length"), 0.28);
  const double upper_arm = panels::DistanceToChain(*FindPatternPoint(pattern->front, "underarm_L"),
                                                   FindSection(pattern->front, "shoulder_L")->points);
  EXPECT_GT(upper_arm, 0.14);
  EXPECT_LT(upper_arm, 0.23);

  for (double pitch : {0.02, 0.01}) {
    const Result<ClothMesh> mesh = MeshPattern(*pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    EXPECT_EQ(ComputeEulerCharacteristic(*mesh), -2);
    for (const Eigen::Vector3i& t : mesh->triangles) {
      const auto texture = [&](int k) { return mesh->texture_coordinates[static_cast<size_t>(t[k])]; };
      const auto rest = [&](int k) { return mesh->rest_positions[static_cast<size_t>(t[k])]; };
      const Eigen::Vector2d u = texture(1) - texture(0), v = texture(2) - texture(0);
      EXPECT_LT(u.x() * v.y() - u.y() * v.x(), 0.0) << "turned over at " << rest(0).transpose();
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = rest((k + 1) % 3) - rest(k), b = rest((k + 2) % 3) - rest(k);
        EXPECT_GE(a.norm(), 0.55 * pitch);
        EXPECT_LE(a.norm(), 1.6 * pitch);
        // At 2 cm the acute corners beside the neck are coarser than the shirt's own angles.
        EXPECT_GE(std::acos(a.normalized().dot(b.normalized())) * 180.0 / M_PI, pitch > 0.015 ? 20.0 : 25.0);
      }
    }
    for (size_t i = 0; i < mesh->texture_coordinates.size(); ++i) {
      const GarmentView& view = mesh->panel_of_particle[i] == 0 ? garment.front : *garment.back;
      const Eigen::Vector2d pixel =
          (mesh->texture_coordinates[i].array() * Eigen::Array2d(view.image_width, view.image_height)).matrix();
      if (panels::PolygonContains(view.outline, pixel)) continue;
      panels::Polyline closed = view.outline;
      closed.push_back(closed.front());
      EXPECT_LT(panels::DistanceToChain(pixel, closed), 2.0) << "particle " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Saleor, PhotographedTShirt,
                         ::testing::Values("ascii-shirt", "blue-polygon-tee", "dark-polygon-tee", "dash-tee",
                                           "monospace-white-tee", "team-tee", "white-cubes-tee"));

}  // namespace
}  // namespace fitroom
