#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "body_center/cli/commands.h"
#include "common/base/exit_code.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace fitroom::body_center {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string output;
  std::string messages;
};

// Runs `body_center measure` with the given words, as main() would.
Outcome Measure(std::vector<std::string> words) {
  CLI::App app;
  Outcome outcome;
  AddMeasureCommand(app, outcome.exit_code);
  words.insert(words.begin(), "measure");
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // As CLI11 takes them.
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  app.parse(reversed);
  outcome.output = ::testing::internal::GetCapturedStdout();
  outcome.messages = ::testing::internal::GetCapturedStderr();
  return outcome;
}

std::string PopulationBody(const char* id) {
  return (testing::TestDataFolder() / "bodies" / "population" / (std::string(id) + ".ply")).string();
}

TEST(MeasureCommand, WritesTheDocumentedJson) {
  FR_REQUIRE_TEST_DATA();
  const Outcome outcome = Measure({PopulationBody("p001"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.messages;
  EXPECT_EQ(outcome.messages, "");
  const nlohmann::json document = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(document.size(), 3u);
  EXPECT_EQ(document["frame"]["up"], "+y");
  EXPECT_EQ(document["frame"]["facing"], "+z");
  EXPECT_EQ(document["frame"]["unit"], "cm");
  EXPECT_GE(document["frame"]["reasons"].size(), 3u);
  for (const char* name : {"front_neck", "back_neck_c7", "side_neck_L", "acromion_R", "armpit_L", "crotch", "knee_R",
                           "ankle_lateral_L", "bust_point_R", "hip_side_L", "wrist_R", "crown"}) {
    ASSERT_TRUE(document["landmarks"].contains(name)) << name;
    const nlohmann::json& landmark = document["landmarks"][name];
    EXPECT_EQ(landmark["file"].size(), 3u);
    EXPECT_EQ(landmark["canonical_m"].size(), 3u);
    EXPECT_GT(landmark["confidence"].get<double>(), 0.0);
    EXPECT_LE(landmark["confidence"].get<double>(), 1.0);
    // Centimetres above the file's floor are metres above the canonical one.
    EXPECT_NEAR(landmark["file"][1].get<double>(), 100.0 * landmark["canonical_m"][1].get<double>(), 0.01) << name;
  }
  // The tables of the external test data: p001.
  EXPECT_NEAR(document["girths_cm"]["bust"].get<double>(), 76.0, 0.9);
  EXPECT_NEAR(document["girths_cm"]["waist"].get<double>(), 65.9, 0.9);
  EXPECT_NEAR(document["girths_cm"]["hip"].get<double>(), 94.4, 0.9);
}

TEST(MeasureCommand, TakesOverridesAndPrintsATable) {
  FR_REQUIRE_TEST_DATA();
  const Outcome outcome = Measure({PopulationBody("p002"), "--up", "y", "--facing", "-z", "--unit", "cm"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.messages;
  EXPECT_NE(outcome.output.find("facing -z"), std::string::npos);
  EXPECT_NE(outcome.output.find("given by the operator"), std::string::npos);
  EXPECT_NE(outcome.output.find("front_neck"), std::string::npos);
}

TEST(MeasureCommand, FailsWithTheCodeOfTheCauseAndNoOutput) {
  const Outcome missing = Measure({"no-such-scan.ply", "--json"});
  EXPECT_EQ(missing.exit_code, static_cast<int>(ExitCode::kNotFound));
  EXPECT_EQ(missing.output, "");
  const testing::TemporaryFolder folder;
  const std::string path = (folder.path() / "triangle.obj").string();
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Outcome triangle = Measure({path, "--json"});
  EXPECT_EQ(triangle.exit_code, static_cast<int>(ExitCode::kInvalidInput));
  EXPECT_EQ(triangle.output, "");
  EXPECT_NE(triangle.messages.find("NOT_A_BODY"), std::string::npos);
  EXPECT_NE(triangle.messages.find(path), std::string::npos);
  const Outcome bad_axis = Measure({path, "--up", "upwards"});
  EXPECT_NE(bad_axis.messages.find("BAD_AXIS"), std::string::npos);
}

}  // namespace
}  // namespace fitroom::body_center
