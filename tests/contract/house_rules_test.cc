#include <algorithm>
#include <cctype>
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

// The headers that builds with precompiled headers read for everybody, and names that each of them defines.
const std::map<std::string, std::vector<std::string>> kPrecompiled = {
    {"algorithm", {"min",           "max",         "clamp",       "sort",        "stable_sort", "find",
                   "find_if",       "copy",        "fill",        "reverse",     "count",       "count_if",
                   "all_of",        "any_of",      "none_of",     "max_element", "min_element", "minmax_element",
                   "lower_bound",   "upper_bound", "nth_element", "transform",   "rotate",      "unique",
                   "binary_search", "replace",     "equal",       "remove_if",   "partition",   "minmax"}},
    {"array", {"array"}},
    {"cmath", {"sqrt", "cos", "sin",      "tan",   "atan", "atan2", "hypot", "lround", "floor", "ceil", "pow",
               "exp",  "log", "isfinite", "isnan", "acos", "asin",  "fmod",  "round",  "cbrt",  "expm1"}},
    {"filesystem", {"filesystem"}},
    {"functional", {"function"}},
    {"map", {"map", "multimap"}},
    {"memory", {"unique_ptr", "shared_ptr", "weak_ptr", "make_unique", "make_shared"}},
    {"optional", {"optional", "nullopt"}},
    {"span", {"span"}},
    {"string", {"string", "to_string", "stod", "stoi"}},
    {"string_view", {"string_view"}},
    {"vector", {"vector"}}};

// What a source names, without its comments: "std::min", "Eigen::Vector3d".
std::set<std::string> NamesIn(const fs::path& file) {
  std::set<std::string> names;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    line = line.substr(0, line.find("//"));
    for (const std::string space : {"std::", "Eigen::"}) {
      for (size_t at = line.find(space); at != std::string::npos; at = line.find(space, at + 1)) {
        size_t end = at + space.size();
        while (end < line.size() && (std::isalnum(static_cast<unsigned char>(line[end])) || line[end] == '_')) ++end;
        names.insert(line.substr(at, end - at));
      }
    }
  }
  return names;
}

// Everything that a source includes, directly or through the project's own headers.
std::set<std::string> ReachedFrom(const fs::path& root, const std::string& source,
                                  std::map<std::string, std::set<std::string>>& known) {
  const auto [entry, is_new] = known.try_emplace(source);
  if (!is_new) return entry->second;
  std::set<std::string> reached;
  for (const std::string& include : IncludesOf(root / source)) {
    reached.insert(include);
    if (fs::exists(root / include)) reached.merge(ReachedFrom(root, include, known));
  }
  return known[source] = reached;
}

// Where headers are precompiled, the compiler does not miss an include that was forgotten. This does.
TEST(HouseRules, WhatIsNamedIsIncludedThoughHeadersArePrecompiled) {
  const fs::path root = FITROOM_SOURCE_DIR;
  std::map<std::string, std::set<std::string>> known;
  int file_count = 0;
  for (const char* folder : {"common", "body_center", "shop_catalog", "fit_client"}) {
    for (const fs::path& file : SourcesBelow(root / folder)) {
      ++file_count;
      const std::string source = fs::relative(file, root);
      const std::set<std::string> names = NamesIn(file), reached = ReachedFrom(root, source, known);
      for (const auto& [header, defined] : kPrecompiled) {
        for (const std::string& name : defined) {
          EXPECT_TRUE(!names.contains("std::" + name) || reached.contains(header))
              << source << " names std::" << name << " and does not reach <" << header << ">";
        }
      }
      const auto is_eigen = [](const std::string& text) { return text.starts_with("Eigen"); };
      EXPECT_TRUE(std::none_of(names.begin(), names.end(), is_eigen) ||
                  std::any_of(reached.begin(), reached.end(), is_eigen))
          << source << " names Eigen's types and reaches none of its headers";
    }
  }
  EXPECT_GT(file_count, 300);
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
