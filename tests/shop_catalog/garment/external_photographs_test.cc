// Extraction on real photographs with known masks and landmarks. Limits are what the methods reach today, with a little
// room: a change that makes one of them worse must say why.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "common/base/file.h"
#include "common/image/decode.h"
#include "shop_catalog/garment/cv_image.h"
#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/garment/segmentation.h"
#include "shop_catalog/garment/top_corners.h"
#include "tests/support/test_data.h"

namespace fitroom::shop_catalog {
namespace {

namespace fs = std::filesystem;

fs::path GarmentsFolder() { return testing::TestDataFolder() / "garments"; }

std::string Read(const fs::path& path) {
  Result<std::string> bytes = ReadFile(path, 64u << 20);
  EXPECT_TRUE(bytes.ok()) << path;
  return bytes.ok() ? *bytes : std::string();
}

fs::path TruthMaskOf(const fs::path& photo) { return photo.parent_path() / (photo.stem().string() + ".mask.png"); }

// All photographs of the given folders that come with a mask.
std::vector<fs::path> PhotosWithMask(const std::vector<std::string>& kinds) {
  std::vector<fs::path> photos;
  for (const std::string& kind : kinds) {
    for (const auto& entry : fs::directory_iterator(GarmentsFolder() / kind)) {
      const std::string name = entry.path().filename();
      if (name.ends_with(".mask.png") || name.ends_with(".json")) continue;
      if (fs::exists(TruthMaskOf(entry.path()))) photos.push_back(entry.path());
    }
  }
  std::sort(photos.begin(), photos.end());
  return photos;
}

cv::Mat MaskOf(const std::string& png) {
  const Image grey = ConvertChannels(*DecodeImage(png), 1);
  return ViewOf(grey) >= 128;
}

double IouWithTruth(const std::string& mask_png, const fs::path& photo) {
  return IntersectionOverUnion(MaskOf(mask_png), MaskOf(Read(TruthMaskOf(photo))));
}

Result<GarmentExtraction> Extract(const std::string& front, const std::string& back) {
  ExtractionRequest request;
  request.id = "external";
  request.length = 0.68;
  request.front_photo = front;
  request.back_photo = back;
  return ExtractGarment(request);
}

std::string FileOf(const GarmentExtraction& extraction, const std::string& name) {
  for (const GarmentFile& file : extraction.files) {
    if (file.name == name) return file.bytes;
  }
  return "";
}

TEST(ExternalPhotographs, AllStudioPairsOfTShirtsAreExtractedWithoutHelp) {
  FR_REQUIRE_TEST_DATA();
  for (const char* name : {"ascii-shirt", "blue-polygon-tee", "dark-polygon-tee", "dash-tee", "monospace-white-tee",
                           "team-tee", "white-cubes-tee"}) {
    const fs::path base = GarmentsFolder() / "tshirt" / (std::string("saleor-") + name);
    const Result<GarmentExtraction> extraction =
        Extract(Read(base.string() + "-front.png"), Read(base.string() + "-back.png"));
    ASSERT_TRUE(extraction.ok()) << name << ": " << extraction.status().ToString();
    EXPECT_GE(IouWithTruth(FileOf(*extraction, "front_mask.png"), base.string() + "-front.png"), 0.98) << name;
    EXPECT_GE(IouWithTruth(FileOf(*extraction, "back_mask.png"), base.string() + "-back.png"), 0.98) << name;
    EXPECT_GE(extraction->front.points, 0.85) << name;
    EXPECT_GE(extraction->back->points, 0.85) << name;
  }
}

TEST(ExternalPhotographs, MasksAgreeWithThoseDrawnByHand) {
  FR_REQUIRE_TEST_DATA();
  std::map<std::string, std::vector<double>> by_origin;
  for (const fs::path& photo :
       PhotosWithMask({"dress", "hoodie", "longsleeve", "shirt", "shorts", "skirt", "trousers", "tshirt"})) {
    const Image rgb = ConvertChannels(*DecodeImage(Read(photo)), 3);
    const std::vector<MaskCandidate> candidates =
        SegmentGarment(ViewOf(rgb), [](const MaskCandidate&) { return true; });
    const double iou = candidates.empty()
                           ? 0.0
                           : IntersectionOverUnion(RefineCoverage(ViewOf(rgb), candidates[0].mask) >= 128,
                                                   MaskOf(Read(TruthMaskOf(photo))));
    const std::string name = photo.filename();
    by_origin[name.starts_with("saleor") ? "saleor" : name.starts_with("solidus") ? "solidus" : "phone"].push_back(iou);
  }
  for (const auto& [origin, ious] : by_origin) {
    double sum = 0.0;
    for (const double iou : ious) sum += iou;
    const auto good = std::count_if(ious.begin(), ious.end(), [](double iou) { return iou >= 0.95; });
    const double mean = sum / static_cast<double>(ious.size());
    std::printf("%s: %zu masks, mean IoU %.4f, %ld of at least 0.95\n", origin.c_str(), ious.size(), mean,
                static_cast<long>(good));
    EXPECT_GE(mean, origin == "phone" ? 0.93 : 0.975) << origin;
    EXPECT_GE(static_cast<double>(good) / static_cast<double>(ious.size()), origin == "phone" ? 0.72 : 0.9) << origin;
  }
}

// Landmarks drawn by hand on phone photographs of T-shirts, named by the image's left and right.
TEST(ExternalPhotographs, PointsLieWhereTheyWereMarkedByHand) {
  FR_REQUIRE_TEST_DATA();
  const std::map<std::string, std::string> names = {{"neckL", "P1"},
                                                    {"neckR", "P2"},
                                                    {"slRo", "e4"},
                                                    {"slLo", "e8"},
                                                    {"slRi", "sleeve_bottom_L"},
                                                    {"slLi", "sleeve_bottom_R"},
                                                    {"armR", "underarm_L"},
                                                    {"armL", "underarm_R"},
                                                    {"hemR", "hem_L"},
                                                    {"hemL", "hem_R"},
                                                    {"shR", "e3"},
                                                    {"shL", "e7"}};
  std::vector<double> errors;
  for (const fs::path& photo : PhotosWithMask({"tshirt"})) {
    const fs::path landmarks = photo.parent_path() / (photo.stem().string() + ".landmarks.json");
    if (!fs::exists(landmarks)) continue;
    const Result<GarmentExtraction> extraction = Extract(Read(photo), "");
    ASSERT_TRUE(extraction.ok()) << photo << extraction.status().ToString();
    const GarmentView& view = extraction->garment.front;
    const double height = 0.68 / view.metre_per_pixel;
    const auto json = nlohmann::json::parse(Read(landmarks));
    for (const auto& [marked, ours] : names) {
      const auto& pixel = json["landmarks"][marked];
      const Eigen::Vector2d truth(pixel[0].get<double>(), pixel[1].get<double>());
      errors.push_back((FindPoint(view, ours)->pixel - truth).norm() / height);
      if (errors.back() > 0.05) {
        std::printf("%s %s: off by %.1f %% of the height\n", photo.stem().c_str(), ours.c_str(), 100 * errors.back());
      }
    }
  }
  ASSERT_GE(errors.size(), 36u);
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  for (const double error : errors) sum += error;
  const double mean = sum / static_cast<double>(errors.size());
  const double median = errors[errors.size() / 2];
  std::printf("%zu points by hand: median %.2f %%, mean %.2f %%, worst %.1f %% of the height\n", errors.size(),
              100 * median, 100 * mean, 100 * errors.back());
  EXPECT_LE(median, 0.022);
  EXPECT_LE(mean, 0.034);
}

// 210 outlines of crumpled T-shirts with 12 marked points, turned upright give or take 20 degrees.
TEST(ExternalPhotographs, CornersOfMarkedOutlinesAreFound) {
  FR_REQUIRE_TEST_DATA();
  std::ifstream lines(GarmentsFolder() / "annotations" / "artf_tshirts_train.jsonl");
  const std::vector<std::pair<std::string, int>> names = {{"waist", kHemLeft},
                                                          {"armpit", kUnderarmLeft},
                                                          {"sleeve#bottom", kSleeveBottomLeft},
                                                          {"sleeve#top", kSleeveTopLeft},
                                                          {"neck", kNeckLeft}};
  std::vector<double> errors;
  std::map<std::string, std::vector<double>> by_name;
  int shirt_count = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    const auto marked = [&](const std::string& name, const char* side) {
      std::string key = name;
      if (const size_t hash = key.find('#'); hash != std::string::npos) {
        key = key.substr(0, hash) + "_" + side + "_" + key.substr(hash + 1);
      } else {
        key += std::string("_") + side;
      }
      return Eigen::Vector2d(json["landmarks"][key][0].get<double>(), json["landmarks"][key][1].get<double>());
    };
    if (json["landmarks"].size() != 12) continue;
    const Eigen::Vector2d up =
        marked("neck", "left") + marked("neck", "right") - marked("waist", "left") - marked("waist", "right");
    const double tilt = (shirt_count % 5 - 2) * 10.0 * 3.14159265358979 / 180.0;
    const double angle = std::atan2(up.x(), -up.y()) - tilt;
    Eigen::Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const double height = 0.5 * up.norm();
    Polygon corners;
    for (const auto& p : json["polygon"]) {
      corners.push_back(turn * Eigen::Vector2d(p[0].get<double>(), p[1].get<double>()) * (500.0 / height));
    }
    if (SignedArea(corners) < 0) std::reverse(corners.begin(), corners.end());
    Polygon outline;
    for (int i = 0; i < 800; ++i) outline.push_back(PlaceAt(corners, i * Perimeter(corners) / 800).pixel);
    const std::optional<TopCorners> found = FindTopCorners(outline);
    ++shirt_count;
    ASSERT_TRUE(found.has_value());
    for (const auto& [name, left_corner] : names) {
      Eigen::Vector2d a = turn * marked(name, "left") * (500.0 / height);
      Eigen::Vector2d b = turn * marked(name, "right") * (500.0 / height);
      const Eigen::Vector2d right(std::cos(tilt), std::sin(tilt));
      if (a.dot(right) > b.dot(right)) std::swap(a, b);
      const int right_corner = kTopCornerCount - 1 - left_corner;
      for (const double error : {(found->pixel[static_cast<size_t>(left_corner)] - a).norm() / 500.0,
                                 (found->pixel[static_cast<size_t>(right_corner)] - b).norm() / 500.0}) {
        errors.push_back(error);
        by_name[name].push_back(error);
      }
    }
  }
  ASSERT_GE(shirt_count, 150);
  const auto describe = [](const char* name, std::vector<double> values) {
    std::sort(values.begin(), values.end());
    double sum = 0.0;
    for (const double value : values) sum += value;
    const auto far = std::count_if(values.begin(), values.end(), [](double value) { return value > 0.05; });
    std::printf("%-14s %5zu points: median %.2f %%, mean %.2f %%, more than 5 %% off: %.1f %%\n", name, values.size(),
                100 * values[values.size() / 2], 100 * sum / static_cast<double>(values.size()),
                100.0 * static_cast<double>(far) / static_cast<double>(values.size()));
    return std::pair(values[values.size() / 2], sum / static_cast<double>(values.size()));
  };
  for (const auto& [name, values] : by_name) describe(name.c_str(), values);
  const auto [median, mean] = describe("all", errors);
  // Extremes and concavities reached a median of 0.87 % and a mean of 9.5 %, template transfer 2.2 and 3.4 %.
  EXPECT_LE(median, 0.015);
  EXPECT_LE(mean, 0.034);
}

TEST(ExternalPhotographs, OtherKindsGivenAsTShirtsAreRefused) {
  FR_REQUIRE_TEST_DATA();
  int accepted = 0;
  int count = 0;
  for (const char* kind : {"trousers", "skirt", "shorts", "dress", "hoodie"}) {
    for (const auto& entry : fs::directory_iterator(GarmentsFolder() / kind)) {
      const std::string name = entry.path().filename();
      if (name.ends_with(".mask.png") || name.ends_with(".json")) continue;
      ++count;
      const Result<GarmentExtraction> extraction = Extract(Read(entry.path()), "");
      if (!extraction.ok()) continue;
      ++accepted;
      std::printf("accepted: %s/%s\n", kind, name.c_str());
    }
  }
  EXPECT_GE(count, 60);
  EXPECT_LE(accepted, 1);
}

}  // namespace
}  // namespace fitroom::shop_catalog
