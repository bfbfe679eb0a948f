#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/executor.h"
#include "common/base/file.h"
#include "common/garment/garment_folder.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/fit_outfit.h"
#include "shop_catalog/garment/extract_garment.h"
#include "tests/fit_client/fitting/winding_number.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

const std::array<std::string, 7> kShirts = {"ascii-shirt", "blue-polygon-tee",    "dark-polygon-tee", "dash-tee",
                                            "team-tee",    "monospace-white-tee", "white-cubes-tee"};

// Extracts a photographed pair, as a shop would, into a folder, and reads it as a consumer would.
GarmentInput LoadShirt(const std::string& name, double length) {
  const std::filesystem::path photographs = testing::TestDataFolder() / "garments" / "tshirt";
  const std::string front = ReadFile(photographs / ("saleor-" + name + "-front.png"), 20 << 20).value();
  const std::string back = ReadFile(photographs / ("saleor-" + name + "-back.png"), 20 << 20).value();
  shop_catalog::ExtractionRequest request;
  request.id = name;
  request.length = length;
  request.front_photo = front;
  request.back_photo = back;
  const auto extraction = shop_catalog::ExtractGarment(request);
  EXPECT_TRUE(extraction.ok()) << extraction.status().ToString();
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(WriteGarmentFolder(folder.path(), extraction->garment, extraction->files).ok());
  return LoadGarment(folder.path()).value();
}

FittedGarment Wear(const BodyInput& body, const GarmentInput& shirt, Executor& executor) {
  Stopwatch stopwatch;
  Result<Outfit> outfit = FitOutfit(body, {{&shirt, ""}}, FitOptions(), executor, stopwatch, {});
  EXPECT_TRUE(outfit.ok()) << outfit.status().ToString();
  return std::move(outfit->garments.front());
}

// The sewn partners coincide, and no particle and no triangle's middle is inside the body, by the winding number.
void ExpectWorn(const FittedGarment& fit, const TriangleMesh& closed_body, const std::string& what) {
  EXPECT_TRUE(fit.report.finished) << what << ": " << fit.report.finishing_text;
  const std::vector<Eigen::Vector3d>& worn = fit.stages.final;
  for (const SeamPair& pair : fit.cut.cloth.seams) {
    EXPECT_LT((worn[static_cast<size_t>(pair.a)] - worn[static_cast<size_t>(pair.b)]).norm(), 0.0005) << what;
  }
  int inside_count = 0;
  for (size_t i = 0; i < worn.size(); i += 7) inside_count += testing::WindingNumber(closed_body, worn[i]) > 0.5;
  for (size_t i = 0; i < fit.cut.cloth.triangles.size(); i += 11) {
    const Eigen::Vector3i& triangle = fit.cut.cloth.triangles[i];
    const Eigen::Vector3d middle = (worn[static_cast<size_t>(triangle[0])] + worn[static_cast<size_t>(triangle[1])] +
                                    worn[static_cast<size_t>(triangle[2])]) /
                                   3.0;
    inside_count += testing::WindingNumber(closed_body, middle) > 0.5;
  }
  EXPECT_EQ(inside_count, 0) << what;
  EXPECT_EQ(fit.report.euler_characteristic, -2) << what;
}

// Where a worn shirt's named points must be, seen by a person: neck round the neck, sleeves on the arms, hem level.
void ExpectLooksWorn(const FittedGarment& fit, const Body& body, const std::string& what) {
  const auto place = [&](const std::string& name) -> Eigen::Vector3d {
    for (const NamedParticle& named : fit.cut.cloth.named_particles) {
      if (named.name == name) return fit.stages.final[static_cast<size_t>(named.particle)];
    }
    ADD_FAILURE() << what << ": no " << name;
    return Eigen::Vector3d::Zero();
  };
  const double neck_y = body.landmarks[BodyLandmark::kBackNeckC7].position.y();
  for (const char* end : {"front/P1", "front/P2"}) EXPECT_NEAR(place(end).y(), neck_y, 0.06) << what << " " << end;
  const double shoulder_y = body.landmarks[BodyLandmark::kAcromionLeft].position.y();
  const double arm_x = body.arm_left.root.x();
  EXPECT_GT(place("front/e4").x(), arm_x) << what;
  EXPECT_LT(place("front/e8").x(), -arm_x) << what;
  EXPECT_LT(place("front/e4").y(), shoulder_y) << what;
  EXPECT_LT(place("front/underarm_L").y(), body.landmarks[BodyLandmark::kArmpitLeft].position.y() + 0.02) << what;
  EXPECT_NEAR(place("front/hem_L").y(), place("front/hem_R").y(), 0.03) << what << ": hem not level";
  EXPECT_NEAR(place("front/hem_L").y(), place("front/hem_centre").y(), 0.06) << what << ": hem not level";
  EXPECT_LT(place("front/hem_centre").z(), 0.35) << what;
  EXPECT_GT(place("front/hem_centre").z(), place("back/hem_centre").z()) << what;
}

TEST(WornTShirts, SevenRealPairsAreWornOnClosedBodies) {
  FR_REQUIRE_TEST_DATA();
  SerialExecutor executor;
  for (size_t i = 0; i < kShirts.size(); ++i) {
    const std::string body_name = "p00" + std::to_string(i + 1);
    const std::string what = kShirts[i] + " on " + body_name;
    const BodyInput body = LoadScan(testing::TestDataFolder() / "bodies/population" / (body_name + ".ply")).value();
    const FittedGarment fit = Wear(body, LoadShirt(kShirts[i], 0.68), executor);
    ExpectWorn(fit, body.body.mesh, what);
    ExpectLooksWorn(fit, body.body, what);
  }
}

TEST(WornTShirts, RawScansWithHolesAreDressed) {
  FR_REQUIRE_TEST_DATA();
  SerialExecutor executor;
  const GarmentInput shirt = LoadShirt("dash-tee", 0.68);
  for (const char* scan : {"p001_scan.ply", "p002_scan.ply"}) {
    const BodyInput body = LoadScan(testing::TestDataFolder() / "bodies/scans" / scan).value();
    const FittedGarment fit = Wear(body, shirt, executor);
    EXPECT_TRUE(fit.report.finished) << scan << ": " << fit.report.finishing_text;
    EXPECT_EQ(fit.report.penetration.particle_count_inside, 0) << scan;
    ExpectLooksWorn(fit, body.body, scan);
  }
}

TEST(WornTShirts, OneThreadAndTwoGiveTheSameBytes) {
  FR_REQUIRE_TEST_DATA();
  const BodyInput body = LoadScan(testing::TestDataFolder() / "bodies/population/p001.ply").value();
  const GarmentInput shirt = LoadShirt("team-tee", 0.68);
  SerialExecutor one;
  ThreadPool two(2);
  const FittedGarment first = Wear(body, shirt, one);
  const FittedGarment second = Wear(body, shirt, two);
  ASSERT_EQ(first.stages.final.size(), second.stages.final.size());
  for (size_t i = 0; i < first.stages.final.size(); ++i) {
    ASSERT_EQ(first.stages.final[i], second.stages.final[i]) << "particle " << i;
  }
}

// S45: the ease that the drape shows is garment girth minus body girth, and grows with the garment.
TEST(WornTShirts, EaseGrowsWithTheSizeOfTheGarment) {
  FR_REQUIRE_TEST_DATA();
  SerialExecutor executor;
  const BodyInput body = LoadScan(testing::TestDataFolder() / "bodies/population/p006.ply").value();
  std::vector<double> bust;
  for (const double length : {0.66, 0.70, 0.74}) {
    const FittedGarment fit = Wear(body, LoadShirt("dash-tee", length), executor);
    ASSERT_TRUE(fit.report.ease[0].measured);
    bust.push_back(fit.report.ease[0].ease());
  }
  EXPECT_LT(bust[0], bust[1]);
  EXPECT_LT(bust[1], bust[2]);
  // The garment's girth is proportional to its length, the body's is not.
  const double body_girth = body.body.measurements.bust.girth;
  EXPECT_NEAR((bust[2] + body_girth) / (bust[0] + body_girth), 0.74 / 0.66, 0.015);
}

}  // namespace
}  // namespace fitroom
