#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

namespace fs = std::filesystem;

// What the files below a folder may never include. The link graph keeps most of this; #include lines show it at once.
struct Rule {
  std::string folder;
  std::vector<std::string> forbidden;  // Regular expressions over the included path.
};

const std::string kGrpc = R"(^(grpc|grpcpp|google/protobuf)/|\.pb\.h$|^common/(rpc|transfer)/)";
const std::string kOpenCv = R"(^opencv2/)";
const std::string kSqlite = R"(^sqlite3\.h$|^common/(sqlite|store)/)";
// Bodies, in every form that they have: the shop's side sees none of it.
const std::string kBodies = R"(^common/(body|scan_record|scan_file)/|^common/remote/body|^fitroom/body/)";
const std::string kPrograms = R"(^(body_center|shop_catalog|fit_client)/)";

const std::vector<Rule> kRules = {
    {"common", {kPrograms, R"(^tests/)"}},
    {"common/base", {R"(^common/(?!base/))", R"(^Eigen/)", kGrpc, kOpenCv, kSqlite}},
    {"common/geometry", {R"(^common/(?!base/|geometry/))", kGrpc, kOpenCv, kSqlite}},
    {"common/body", {R"(^common/(?!base/|geometry/|body/))", kGrpc, kOpenCv, kSqlite}},
    {"common/codec", {R"(^common/(?!base/|geometry/|codec/))", kGrpc, kOpenCv, kSqlite}},
    {"common/scan_file", {R"(^common/(?!base/|geometry/|codec/|scan_file/))", kGrpc, kOpenCv, kSqlite}},
    {"common/garment", {R"(^common/(?!base/|geometry/|image/|garment/))", kGrpc, kOpenCv, kSqlite, kBodies}},
    {"common/image", {R"(^common/(?!base/|image/))", kGrpc, kSqlite}},
    {"common/sqlite", {R"(^common/(?!base/|sqlite/))", kGrpc, kOpenCv}},
    {"common/store", {R"(^common/(?!base/|codec/|sqlite/|store/))", kGrpc, kOpenCv, R"(^sqlite3\.h$)"}},
    {"common/rpc", {R"(^common/(?!base/|rpc/))", kOpenCv, R"(^sqlite3\.h$)"}},
    {"common/transfer", {R"(^common/(?!base/|codec/|rpc/|transfer/))", R"(^fitroom/(?!common/))", kOpenCv, kSqlite}},
    {"common/remote", {kOpenCv, kSqlite}},
    {"common/scan_record", {kGrpc, kOpenCv, kSqlite}},
    {"common/garment_record", {kGrpc, kOpenCv, kSqlite, kBodies}},
    {"body_center", {R"(^(shop_catalog|fit_client)/)", kOpenCv}},
    {"shop_catalog", {R"(^(body_center|fit_client)/)", kBodies}},
    {"fit_client", {R"(^(body_center|shop_catalog)/)", kSqlite}},
    {"body_center/scan", {kGrpc, kSqlite}},
    {"shop_catalog/garment", {kGrpc, kSqlite}},
    {"body_center/store", {kGrpc, kOpenCv}},
    {"shop_catalog/store", {kGrpc, kOpenCv}},
    {"body_center/service", {kSqlite, kOpenCv}},
    {"shop_catalog/service", {kSqlite, kOpenCv}},
    {"fit_client/cache", {kGrpc, kOpenCv}},
    {"fit_client/fit",
     {kGrpc, kOpenCv, kSqlite, R"(^(CLI|spdlog|nlohmann|GL|tbb|oneapi)/)", R"(^(chrono|thread)$)",
      R"(^fit_client/(?!fit/))"}},
    {"fit_client/fit/panels", {R"(^fit_client/fit/(?!panels/|cloth_mesh\.h))"}},
    {"fit_client/fit/grading", {R"(^fit_client/fit/(?!panels/|grading/|cloth_mesh\.h))"}},
    {"fit_client/fit/fork", {R"(^fit_client/fit/(?!panels/|fork/|cloth_mesh\.h))"}},
    {"fit_client/render", {kGrpc, kSqlite}},
    {"fit_client/report", {kGrpc, kSqlite}},
};

bool IsSource(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cc"; }

std::vector<fs::path> SourcesBelow(const fs::path& folder) {
  std::vector<fs::path> sources;
  if (!fs::exists(folder)) return sources;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && IsSource(entry.path())) sources.push_back(entry.path());
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

std::vector<std::string> IncludesOf(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> includes;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) includes.push_back(match[1]);
  }
  return includes;
}

TEST(HouseRules, NobodyIncludesWhatTheirRoomMustNotSee) {
  const fs::path root = FITROOM_SOURCE_DIR;
  for (const Rule& rule : kRules) {
    const std::vector<fs::path> sources = SourcesBelow(root / rule.folder);
    EXPECT_FALSE(sources.empty()) << "the rule for " << rule.folder << " keeps nothing: the folder has moved";
    for (const fs::path& file : sources) {
      for (const std::string& include : IncludesOf(file)) {
        for (const std::string& forbidden : rule.forbidden) {
          EXPECT_FALSE(std::regex_search(include, std::regex(forbidden)))
              << fs::relative(file, root) << " includes " << include << ", which " << rule.folder << " must not see";
        }
      }
    }
  }
}

TEST(HouseRules, TheShopsClientSeesNoBodies) {
  const fs::path root = FITROOM_SOURCE_DIR;
  int file_count = 0;
  for (const fs::path& file : SourcesBelow(root / "common/remote")) {
    if (!file.filename().string().starts_with("shop_")) continue;
    ++file_count;
    for (const std::string& include : IncludesOf(file)) {
      EXPECT_FALSE(std::regex_search(include, std::regex(kBodies))) << file << " includes " << include;
    }
  }
  EXPECT_EQ(file_count, 4);
}

TEST(HouseRules, HeadersStartWithPragmaOnce) {
  const fs::path root = FITROOM_SOURCE_DIR;
  for (const char* folder : {"common", "body_center", "shop_catalog", "fit_client", "tests"}) {
    for (const fs::path& file : SourcesBelow(root / folder)) {
      if (file.extension() != ".h") continue;
      std::ifstream stream(file);
      std::string first;
      std::getline(stream, first);
      EXPECT_EQ(first, "#pragma once") << fs::relative(file, root);
    }
  }
}

TEST(HouseRules, MainStaysUnderAHundredLines) {
  const fs::path root = FITROOM_SOURCE_DIR;
  for (const char* program : {"body_center", "shop_catalog", "fit_client"}) {
    std::ifstream stream(root / program / "main.cc");
    ASSERT_TRUE(stream) << program;
    EXPECT_LT(std::count(std::istreambuf_iterator<char>(stream), {}, '\n'), 100) << program;
  }
}

TEST(HouseRules, TheTopLevelHoldsNothingElse) {
  const std::set<std::string> allowed = {
      "CMakeLists.txt", "CMakePresets.json", "README.md",  "LICENSE", "proto",  "common",
      "body_center",    "shop_catalog",      "fit_client", "tests",   "deploy", "build"};
  for (const auto& entry : fs::directory_iterator(FITROOM_SOURCE_DIR)) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(name.front() == '.' || allowed.contains(name)) << name;
  }
}

}  // namespace
}  // namespace fitroom
