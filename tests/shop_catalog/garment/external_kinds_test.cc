// Extraction of every kind on real photographs. Limits are what the method reaches today, with a little room: a change
// that makes one of them worse must say why.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/base/file.h"
#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/garment/kind_frame.h"
#include "tests/support/test_data.h"

namespace fitroom::shop_catalog {
namespace {

namespace fs = std::filesystem;

std::string Read(const fs::path& path) {
  Result<std::string> bytes = ReadFile(path, 64u << 20);
  EXPECT_TRUE(bytes.ok()) << path;
  return bytes.ok() ? *bytes : std::string();
}

std::vector<fs::path> PhotosOf(const std::string& folder) {
  std::vector<fs::path> photos;
  for (const auto& entry : fs::directory_iterator(testing::TestDataFolder() / "garments" / folder)) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(".mask.png") && !name.ends_with(".json")) photos.push_back(entry.path());
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

double UsualLength(GarmentKind kind) {
  if (kind == GarmentKind::kPants) return 1.0;
  if (kind == GarmentKind::kShorts) return 0.45;
  if (kind == GarmentKind::kSkirt) return 0.55;
  return kind == GarmentKind::kOnePiece ? 0.95 : 0.66;
}

Result<GarmentExtraction> Extract(const std::string& photo, GarmentKind kind) {
  ExtractionRequest request;
  request.id = "external";
  request.kind = kind;
  request.length = UsualLength(kind);
  request.front_photo = photo;
  return ExtractGarment(request);
}

// The names of the hand-made landmarks (by the image's left and right) that a front view's points answer to.
std::map<std::string, std::string> MarkedNames(GarmentKind kind) {
  if (HasLegs(kind)) {
    return {{"waistL", "e3"}, {"waistR", "e1"},     {"waistM", "waist_centre"}, {"outL", "e4"},
            {"outR", "e2"},   {"crotch", "crotch"}, {"inL", "hem_inner_R"},     {"inR", "hem_inner_L"}};
  }
  if (kind == GarmentKind::kSkirt) {
    return {{"waistL", "e3"}, {"waistR", "e1"}, {"waistM", "waist_centre"},
            {"hemL", "e4"},   {"hemR", "e2"},   {"hemM", "hem_centre"}};
  }
  std::map<std::string, std::string> names = {{"neckL", "P1"},        {"neckR", "P2"},   {"armL", "underarm_R"},
                                              {"armR", "underarm_L"}, {"hemL", "hem_R"}, {"hemR", "hem_L"},
                                              {"hemM", "hem_centre"}};
  if (kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece) {
    names.insert({{"shL", "e6"}, {"shR", "e2"}});
  }
  if (kind == GarmentKind::kSleevedOnePiece) {
    names.insert({{"slLo", "sleeve_top_R"}, {"slRo", "sleeve_top_L"}});
  } else if (kind == GarmentKind::kLongSleeve) {
    names.insert({{"slLo", "e8"}, {"slRo", "e4"}, {"shL", "e7"}, {"shR", "e3"}});
  }
  if (HasSleeves(kind)) names.insert({{"slLi", "sleeve_bottom_R"}, {"slRi", "sleeve_bottom_L"}});
  return names;
}

TEST(ExternalKinds, PointsLieWhereTheyWereMarkedByHand) {
  FR_REQUIRE_TEST_DATA();
  const std::vector<std::pair<const char*, GarmentKind>> folders = {{"trousers", GarmentKind::kPants},
                                                                    {"shorts", GarmentKind::kShorts},
                                                                    {"skirt", GarmentKind::kSkirt},
                                                                    {"dress", GarmentKind::kOnePiece},
                                                                    {"longsleeve", GarmentKind::kLongSleeve}};
  std::vector<double> errors;
  int garments = 0, refused = 0;
  for (const auto& [folder, kind] : folders) {
    for (const fs::path& photo : PhotosOf(folder)) {
      const fs::path landmarks = photo.parent_path() / (photo.stem().string() + ".landmarks.json");
      if (!fs::exists(landmarks)) continue;
      ++garments;
      const Result<GarmentExtraction> extraction = Extract(Read(photo), kind);
      if (!extraction.ok()) {
        ++refused;
        std::printf("%s/%s: %s\n", folder, photo.stem().c_str(), extraction.status().ToString().c_str());
        continue;
      }
      const GarmentView& view = extraction->garment.front;
      const double height = LengthInPixels(extraction->garment.kind, view.points);
      const auto json = nlohmann::json::parse(Read(landmarks))["landmarks"];
      for (const auto& [marked, ours] : MarkedNames(extraction->garment.kind)) {
        if (!json.contains(marked)) continue;
        const Eigen::Vector2d truth(json[marked][0].get<double>(), json[marked][1].get<double>());
        errors.push_back((FindPoint(view, ours)->pixel - truth).norm() / height);
        if (errors.back() > 0.05) {
          std::printf("%s/%s (%s) %s: off by %.1f %% of the height\n", folder, photo.stem().c_str(),
                      std::string(GarmentKindName(extraction->garment.kind)).c_str(), ours.c_str(),
                      100 * errors.back());
        }
      }
    }
  }
  ASSERT_GE(garments, 12);
  ASSERT_FALSE(errors.empty());
  std::sort(errors.begin(), errors.end());
  const double median = errors[errors.size() / 2];
  const double far =
      static_cast<double>(std::count_if(errors.begin(), errors.end(), [](double e) { return e > 0.05; })) /
      static_cast<double>(errors.size());
  std::printf("%d garments, %d refused, %zu points: median %.2f %%, more than 5 %% off: %.1f %%\n", garments, refused,
              errors.size(), 100 * median, 100 * far);
  EXPECT_LE(refused, 2);
  EXPECT_LE(median, 0.008);
  EXPECT_LE(far, 0.12);
}

// Every photograph under its own kind and under another, in turn: the right one should be taken, others refused.
// Each takes seconds: a third of the photographs.
TEST(ExternalKinds, TheWrongKindIsRefused) {
  FR_REQUIRE_TEST_DATA();
  constexpr int kEvery = 3;
  const std::vector<std::pair<const char*, GarmentKind>> folders = {
      {"trousers", GarmentKind::kPants}, {"shorts", GarmentKind::kShorts}, {"skirt", GarmentKind::kSkirt},
      {"dress", GarmentKind::kOnePiece}, {"tshirt", GarmentKind::kTShirt}, {"longsleeve", GarmentKind::kLongSleeve}};
  int right = 0, right_taken = 0, wrong = 0, wrong_taken = 0;
  for (size_t f = 0; f < folders.size(); ++f) {
    const auto& [folder, truth] = folders[f];
    std::map<std::string, int> outcome;
    int count = 0;
    for (const fs::path& photo : PhotosOf(folder)) {
      if (++count % kEvery != 0) continue;
      const std::string bytes = Read(photo);
      const size_t step = 1 + static_cast<size_t>(count / kEvery) % (folders.size() - 1);
      for (const size_t k : {f, (f + step) % folders.size()}) {
        const auto& [other, kind] = folders[k];
        const Result<GarmentExtraction> extraction = Extract(bytes, kind);
        (kind == truth ? right : wrong) += 1;
        if (!extraction.ok()) {
          if (kind == truth) outcome["refused " + std::string(extraction.status().reason())]++;
          continue;
        }
        (kind == truth ? right_taken : wrong_taken) += 1;
        outcome[std::string("as ") + other]++;
        if (kind != truth) std::printf("  %s/%s taken as %s\n", folder, photo.stem().c_str(), other);
      }
    }
    std::printf("%-10s %3d:", folder, count);
    for (const auto& [what, times] : outcome) std::printf(" %s %d;", what.c_str(), times);
    std::printf("\n");
  }
  std::printf("right kind taken %d of %d, wrong kind taken %d of %d\n", right_taken, right, wrong_taken, wrong);
  EXPECT_LE(wrong_taken, wrong / 15);
  EXPECT_GE(right_taken, right / 2);
}

}  // namespace
}  // namespace fitroom::shop_catalog
