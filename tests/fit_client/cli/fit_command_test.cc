// The programs as a shopper runs them: a drawn body and a drawn skirt with a chart of three sizes.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/base/file.h"
#include "common/image/decode.h"
#include "tests/support/temporary_folder.h"

namespace fitroom {
namespace {

namespace fs = std::filesystem;

class FitCommandTest : public ::testing::Test {
 protected:
  // Runs a program and returns its exit code; what it says goes into files.
  int Run(const std::string& program, const std::string& words) {
    const std::string command =
        std::string(FITROOM_PROGRAMS) + "/" + program + " " + words + " >" + Path("out.txt") + " 2>" + Path("err.txt");
    const int status = std::system(command.c_str());
    return status < 0 || !WIFEXITED(status) ? -1 : WEXITSTATUS(status);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string Read(const std::string& name) const {
    const Result<std::string> bytes = ReadFile(folder_.path() / name, 64u << 20);
    EXPECT_TRUE(bytes.ok()) << name;
    return bytes.ok() ? *bytes : std::string();
  }

  void DrawBodyAndSkirt() {
    ASSERT_EQ(Run("body_center", "synthesize --clean --out " + Path("body.ply")), 0) << Read("err.txt");
    const std::string photos = Path("photos");
    ASSERT_EQ(Run("shop_catalog", "synthesize --kind skirt --size 12 --image-side 700 --out " + photos), 0);
    nlohmann::json chart = nlohmann::json::parse(Read("photos/chart.json"));
    nlohmann::json sizes = nlohmann::json::array();
    std::string length;
    for (const nlohmann::json& size : chart["sizes"]) {
      const std::string name = size["name"];
      if (kSizes.contains(name)) sizes.push_back(size);
      if (name == "12") length = std::to_string(size["measures_cm"]["length"].get<double>());
    }
    chart["sizes"] = sizes;
    std::ofstream(Path("chart.json")) << chart.dump();
    ASSERT_EQ(
        Run("shop_catalog", "extract " + photos + "/front.png " + photos + "/back.png --kind skirt --annotation " +
                                photos + "/truth.json --chart " + Path("chart.json") + " --length-cm " + length +
                                " --id skirt --out " + Path("skirt")),
        0)
        << Read("err.txt");
  }

  const std::set<std::string> kSizes = {"10", "12", "14"};
  testing::TemporaryFolder folder_;
};

TEST_F(FitCommandTest, AllSizesWithMapsAndFilmAreDrawnAndListed) {
  DrawBodyAndSkirt();
  if (HasFatalFailure()) return;
  ASSERT_EQ(Run("fit_client", "fit --all-sizes --maps --film --pitch-cm 2 --scan " + Path("body.ply") + " --garment " +
                                  Path("skirt") + " --out " + Path("worn")),
            0)
      << Read("err.txt");
  const nlohmann::json report = nlohmann::json::parse(Read("worn/report.json"));

  // The report lists what lies in the folder, no more and no less, and with its size: 0 for what is made of the report
  // itself, after it.
  const std::set<std::string> made_of_report = {"report.json", "report.txt", "index.html"};
  std::set<std::string> listed, there;
  for (const nlohmann::json& file : report["files"]) {
    const std::string name = file["name"];
    EXPECT_TRUE(listed.insert(name).second) << name << " is listed twice";
    if (made_of_report.contains(name)) continue;
    EXPECT_EQ(file["size_bytes"], Read("worn/" + name).size()) << name;
  }
  for (const auto& entry : fs::directory_iterator(Path("worn"))) there.insert(entry.path().filename());
  EXPECT_EQ(listed, there);
  for (const char* name : {"sizes.png", "map_strain.png", "map_pressure.png", "map_gap.png", "dressing.webp"}) {
    EXPECT_TRUE(listed.contains(name)) << name;
  }
  for (const std::string& name : there) {
    if (!name.ends_with(".png")) continue;
    const Result<Image> picture = DecodeImage(Read("worn/" + name));
    ASSERT_TRUE(picture.ok()) << name << picture.status().ToString();
    EXPECT_GE(picture->width, 300) << name;
  }
  // A film: an extended WebP with the chunk that says how it is animated, and more than one frame.
  const std::string film = Read("worn/dressing.webp");
  EXPECT_EQ(film.substr(0, 4) + film.substr(8, 8), "RIFFWEBPVP8X");
  EXPECT_NE(film.find("ANIM"), std::string::npos);
  EXPECT_NE(film.find("ANMF"), film.rfind("ANMF"));

  // Laws of sizes: all of the chart are judged, one of them is recommended, and a larger one is never the tighter.
  ASSERT_EQ(report["sizes"].size(), kSizes.size());
  double offset_before = std::numeric_limits<double>::infinity();
  std::map<std::string, double> tightness_before;  // By zone (unit: millimetre).
  for (const nlohmann::json& size : report["sizes"]) {
    EXPECT_TRUE(kSizes.contains(size["size"].get<std::string>()));
    // The body is the smaller against what a size is cut for, the larger the size.
    EXPECT_LT(size["primary_offset_cm"].get<double>(), offset_before) << size["size"];
    offset_before = size["primary_offset_cm"];
    for (const nlohmann::json& zone : size["zones"]) {
      const std::string verdict = zone["verdict"];
      const double tightness = verdict == "tight" || verdict == "does_not_fit" ? zone["amount_mm"].get<double>() : 0.0;
      const auto found = tightness_before.find(zone["zone"]);
      if (found != tightness_before.end()) {
        EXPECT_LE(tightness, found->second) << size["size"] << zone["zone"];
      }
      tightness_before[zone["zone"]] = tightness;
    }
  }
  EXPECT_TRUE(report["recommendation"]["found"]);
  EXPECT_TRUE(kSizes.contains(report["recommendation"]["size"].get<std::string>()));
}

// The size that the chart names for this body, by both profiles: the report says which, and that it was worn.
TEST_F(FitCommandTest, TheOwnSizeIsWornByBothProfiles) {
  DrawBodyAndSkirt();
  if (HasFatalFailure()) return;
  std::set<std::string> sizes;
  for (const std::string profile : {"standard", "paper"}) {
    const std::string out = "worn-" + profile;
    ASSERT_EQ(Run("fit_client", "fit --size auto --no-model --pitch-cm 2 --profile " + profile + " --scan " +
                                    Path("body.ply") + " --garment " + Path("skirt") + " --out " + Path(out)),
              0)
        << profile << ": " << Read("err.txt");
    const nlohmann::json report = nlohmann::json::parse(Read(out + "/report.json"));
    EXPECT_EQ(report["profile"], profile);
    // As printed, the method leaves cloth a voxel's corner deep in the body, which is said.
    const std::string reason = report["finishing_reason"];
    EXPECT_TRUE(reason == "AT_REST" || (profile == "paper" && reason == "CAUGHT_ON_BODY")) << profile << reason;
    sizes.insert(report["verdict"]["size"].get<std::string>());
    // Of all sizes its body is the nearest to this one.
    double own = std::numeric_limits<double>::infinity(), nearest = own;
    for (const nlohmann::json& size : report["sizes"]) {
      const double off = std::abs(size["primary_offset_cm"].get<double>());
      nearest = std::min(nearest, off);
      if (size["size"] == report["verdict"]["size"]) own = off;
    }
    EXPECT_NEAR(own, nearest, 1e-9) << profile;
    // The page shows the same garment and links every picture.
    const std::string page = Read(out + "/index.html");
    for (const nlohmann::json& file : report["files"]) {
      const std::string name = file["name"];
      if (name.ends_with(".png") && !name.starts_with("stage_")) {
        EXPECT_NE(page.find(name), std::string::npos) << name;
      }
    }
  }
  EXPECT_EQ(sizes.size(), 1U);
}

// What cannot be is refused before anything is drawn, with a word on what to do.
TEST_F(FitCommandTest, WhatCannotBeIsRefused) {
  DrawBodyAndSkirt();
  if (HasFatalFailure()) return;
  const std::string both = " --scan " + Path("body.ply") + " --garment " + Path("skirt") + " --out " + Path("worn");
  EXPECT_NE(Run("fit_client", "fit --all-sizes --size 12" + both), 0);
  EXPECT_NE(Read("err.txt").find("ONE_GARMENT_ONLY"), std::string::npos) << Read("err.txt");
  EXPECT_NE(Run("fit_client", "fit --profile paper --pitch-cm 1" + both), 0);
  EXPECT_NE(Read("err.txt").find("2"), std::string::npos) << Read("err.txt");
  EXPECT_NE(Run("fit_client", "fit --size 99" + both), 0);
  EXPECT_NE(Read("err.txt").find("99"), std::string::npos) << Read("err.txt");
  EXPECT_FALSE(fs::exists(Path("worn")));
}

}  // namespace
}  // namespace fitroom
