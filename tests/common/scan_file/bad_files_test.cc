// Every bad file is refused: by a typed error that names the file, the line (or byte) and a remedy, in bounded time and
// memory, and never by a crash.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scan_file/ase_writer.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/bad_files.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom {
namespace {

using ::testing::AnyOf;
using testing::BadFile;
using ::testing::Contains;
using ::testing::HasSubstr;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kMeasuresMemory = false;  // The sanitizer keeps freed memory.
constexpr double kMaxSeconds = 20.0;
#else
constexpr bool kMeasuresMemory = true;
constexpr double kMaxSeconds = 2.0;  // On a machine that does other things besides.
#endif

// Returns the line "name: value kB" of the process's status, or -1 (unit: byte).
int64_t StatusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return 1024 * std::stoll(line.substr(name.size() + 1));
  }
  return -1;
}

// Sets the peak of resident memory back to what is resident now; false where the system does not allow it.
bool ResetPeakMemory() {
  std::ofstream file("/proc/self/clear_refs");
  return static_cast<bool>(file << "5" << std::flush);
}

std::vector<BadFile> AllBadFiles() {
  std::vector<BadFile> all;
  for (std::vector<BadFile> (*make)() : {testing::MakeBadAseFiles, testing::MakeBadPlyFiles, testing::MakeBadObjFiles,
                                         testing::MakeForeignFiles, testing::MakeBadPackedFiles}) {
    for (BadFile& file : make()) all.push_back(std::move(file));
  }
  return all;
}

// Says whether the message begins with "file:12: " or "file:byte 12: ".
bool NamesPlace(std::string_view message, std::string_view file_name) {
  message.remove_prefix(std::min(message.size(), file_name.size() + 1));
  if (message.starts_with("byte ")) message.remove_prefix(5);
  const size_t digit_count = message.find_first_not_of("0123456789");
  return digit_count != std::string_view::npos && digit_count > 0 && message.substr(digit_count).starts_with(": ");
}

void ExpectRefused(const BadFile& file) {
  SCOPED_TRACE(file.name);
  const std::string bytes = file.make();
  const bool can_measure = kMeasuresMemory && ResetPeakMemory();
  const int64_t memory_before = StatusBytes("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  const Result<RawScan> scan = ReadScan(bytes, file.name);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const int64_t peak = StatusBytes("VmHWM") - memory_before;

  ASSERT_FALSE(scan.ok()) << "was read, with " << scan->mesh.triangles.size() << " triangles";
  const Status status = scan.status();
  EXPECT_THAT(file.reasons, Contains(status.reason())) << status.ToString();
  EXPECT_THAT(status.code(), AnyOf(StatusCode::kInvalidArgument, StatusCode::kResourceExhausted));
  EXPECT_TRUE(status.message().starts_with(file.name + ":")) << status.message();
  const bool is_packed = status.reason().starts_with("ZSTD_") || status.reason() == "ODD_UTF16";
  EXPECT_TRUE(is_packed || NamesPlace(status.message(), file.name)) << status.message();
  EXPECT_THAT(status.message(), AnyOf(HasSubstr("again"), HasSubstr("export"), HasSubstr("thin"), HasSubstr("accepted"),
                                      HasSubstr("a scan is an ASE")))
      << "names no remedy";
  EXPECT_LT(status.message().size(), 400U) << status.message();
  for (const char c : status.message()) ASSERT_TRUE(c >= 0x20 && c < 0x7F) << "not printable: " << int{c};
  EXPECT_LT(seconds.count(), kMaxSeconds);
  if (can_measure) {
    EXPECT_LE(peak, 2 * static_cast<int64_t>(bytes.size()) + (int64_t{64} << 20)) << bytes.size();
  }
}

TEST(BadFiles, AreAtLeastTwoHundredAndHaveTheirOwnNames) {
  std::set<std::string> names;
  size_t truncation_count = 0;
  for (const BadFile& file : AllBadFiles()) {
    EXPECT_TRUE(names.insert(file.name).second) << file.name << " is there twice";
    if (file.name.find("cut_at") != std::string::npos) ++truncation_count;
  }
  EXPECT_GE(names.size() - truncation_count, 200U);
  EXPECT_GE(truncation_count, 100U);
}

TEST(BadFiles, OfAseAreRefused) {
  for (const BadFile& file : testing::MakeBadAseFiles()) ExpectRefused(file);
}

TEST(BadFiles, OfPlyAreRefused) {
  for (const BadFile& file : testing::MakeBadPlyFiles()) ExpectRefused(file);
}

TEST(BadFiles, OfObjAreRefused) {
  for (const BadFile& file : testing::MakeBadObjFiles()) ExpectRefused(file);
}

TEST(BadFiles, ThatAreNoScansAreRefused) {
  for (const BadFile& file : testing::MakeForeignFiles()) ExpectRefused(file);
}

TEST(BadFiles, ThatArePackedAreRefused) {
  for (const BadFile& file : testing::MakeBadPackedFiles()) ExpectRefused(file);
}

// The line is counted by the test itself: the number of line ends before the fault, and one.
TEST(BadFiles, TheErrorNamesTheLine) {
  const TriangleMesh mesh = testing::MakeSphere(12, 17);
  const std::string good = FormatAse(mesh, testing::MakeTexturedContent(mesh));
  const std::string bad = testing::ReplaceFirst(good, "*MESH_VERTEX   33\t", "*MESH_VERTEX   33\tnan");
  int64_t line = 1;
  for (size_t i = 0; i < bad.find("nan"); ++i) line += bad[i] == '\n';
  const std::string place = "scan.ase:" + std::to_string(line) + ": ";
  for (const std::string& bytes : {bad, testing::Replace(bad, "\r\n", "\n"), testing::Replace(bad, "\r\n", "\r"),
                                   "\xEF\xBB\xBF" + bad, testing::ToUtf16(bad, false), testing::ToUtf16(bad, true)}) {
    const Result<RawScan> scan = ReadScan(bytes, "scan.ase");
    ASSERT_FALSE(scan.ok());
    EXPECT_TRUE(scan.status().message().starts_with(place)) << scan.status().message() << ", not " << place;
  }
}

TEST(BadFiles, LimitsAreKept) {
  const TriangleMesh mesh = testing::MakeSphere(12, 17);
  const std::string good = FormatAse(mesh, testing::MakeTexturedContent(mesh));
  ReadScanLimits limits;
  limits.max_vertex_count = static_cast<int64_t>(mesh.vertices.size());
  limits.max_triangle_count = static_cast<int64_t>(mesh.triangles.size());
  limits.max_file_size = good.size();
  limits.max_object_count = 1;
  EXPECT_TRUE(ReadScan(good, "scan.ase", limits).ok());
  const auto refused_with = [&](auto change) {
    ReadScanLimits less = limits;
    change(less);
    return ReadScan(good, "scan.ase", less).status();
  };
  EXPECT_EQ(refused_with([](ReadScanLimits& less) { --less.max_vertex_count; }).reason(), "TOO_MANY_VERTICES");
  EXPECT_EQ(refused_with([](ReadScanLimits& less) { --less.max_triangle_count; }).reason(), "TOO_MANY_TRIANGLES");
  EXPECT_EQ(refused_with([](ReadScanLimits& less) { --less.max_file_size; }).reason(), "FILE_TOO_LARGE");
  EXPECT_EQ(refused_with([](ReadScanLimits& less) { --less.max_object_count; }).reason(), "TOO_MANY_OBJECTS");
}

}  // namespace
}  // namespace fitroom
