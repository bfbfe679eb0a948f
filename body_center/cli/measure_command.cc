#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "body_center/cli/commands.h"
#include "common/base/exit_code.h"
#include "common/body/analyse_scan.h"
#include "common/scan_file/scan_file.h"

namespace fitroom::body_center {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureOptions {
  std::string scan;
  std::string up;
  std::string facing;
  std::string unit;
  bool as_json = false;
};

// Reads all of standard input, but never more than a scan may have.
Result<std::string> ReadStandardInput(size_t max_size) {
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  while (const size_t count = std::fread(buffer.data(), 1, buffer.size(), stdin)) {
    if (bytes.size() + count > max_size) {
      return ResourceExhausted("FILE_TOO_LARGE", "standard input is longer than a scan may be");
    }
    bytes.append(buffer.data(), count);
  }
  if (std::ferror(stdin) != 0) return Unavailable("FILE_IO", "standard input cannot be read to its end");
  return bytes;
}

Result<RawScan> ReadInput(const std::string& scan) {
  if (scan != "-") return ReadScanFile(scan);
  FR_ASSIGN_OR_RETURN(const std::string bytes, ReadStandardInput(ReadScanLimits().max_file_size));
  return ReadScan(bytes, "standard input");
}

Result<FrameOverrides> ParseOverrides(const MeasureOptions& options) {
  FrameOverrides overrides;
  if (!options.up.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.up, ParseAxis(options.up));
  }
  if (!options.facing.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.facing, ParseAxis(options.facing));
  }
  if (!options.unit.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.unit, ParseUnit(options.unit));
  }
  return overrides;
}

Json ToJson(const Eigen::Vector3d& p) { return Json::array({p.x(), p.y(), p.z()}); }

// The document that scripts read. Landmarks that were not found are left out.
Json ToJson(const BodyAnalysis& analysis) {
  Json document;
  document["frame"] = {{"up", analysis.frame.up},
                       {"facing", analysis.frame.facing},
                       {"unit", analysis.frame.unit},
                       {"reasons", analysis.frame.reasons}};
  const Similarity file_from_canonical = analysis.canonical_from_file.Inverse();
  Json& landmarks = document["landmarks"] = Json::object();
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = analysis.body.landmarks[landmark];
    if (estimate.confidence <= 0.0) continue;
    landmarks[std::string(LandmarkName(landmark))] = {{"file", ToJson(file_from_canonical * estimate.position)},
                                                      {"canonical_m", ToJson(estimate.position)},
                                                      {"confidence", estimate.confidence}};
  }
  const BodyMeasurements& measured = analysis.body.measurements;
  document["girths_cm"] = {{"bust", 100.0 * measured.bust.girth},
                           {"waist", 100.0 * measured.waist.girth},
                           {"hip", 100.0 * measured.hip.girth}};
  return document;
}

void PrintTable(const BodyAnalysis& analysis) {
  std::printf("up %s, facing %s, unit %s\n", analysis.frame.up.c_str(), analysis.frame.facing.c_str(),
              analysis.frame.unit.c_str());
  for (const std::string& reason : analysis.frame.reasons) std::printf("  %s\n", reason.c_str());
  const BodyMeasurements& measured = analysis.body.measurements;
  std::printf("\n%-18s %8s %10s\n", "measure", "cm", "height cm");
  std::printf("%-18s %8.1f\n", "stature", 100.0 * measured.stature);
  const auto girth = [](const char* name, const GirthMeasurement& m) {
    std::printf("%-18s %8.1f %10.1f\n", name, 100.0 * m.girth, 100.0 * m.height);
  };
  girth("bust girth", measured.bust);
  girth("waist girth", measured.waist);
  girth("hip girth", measured.hip);
  std::printf("\n%-18s %8s %8s %8s  %s\n", "landmark", "left cm", "up cm", "front cm", "confidence");
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = analysis.body.landmarks[landmark];
    if (estimate.confidence <= 0.0) continue;
    const Eigen::Vector3d p = 100.0 * estimate.position;
    std::printf("%-18s %8.1f %8.1f %8.1f  %10.2f\n", std::string(LandmarkName(landmark)).c_str(), p.x(), p.y(), p.z(),
                estimate.confidence);
  }
}

Status Measure(const MeasureOptions& options) {
  FR_ASSIGN_OR_RETURN(const FrameOverrides overrides, ParseOverrides(options));
  FR_ASSIGN_OR_RETURN(const RawScan scan, ReadInput(options.scan));
  const Result<BodyAnalysis> analysis = AnalyseScan(scan.mesh, overrides);
  if (!analysis.ok()) return analysis.status().At(options.scan);
  if (options.as_json) {
    std::printf("%s\n", ToJson(*analysis).dump(2).c_str());
  } else {
    PrintTable(*analysis);
  }
  return {};
}

}  // namespace

void AddMeasureCommand(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = app.add_subcommand("measure", "Finds landmarks and girths on a scan, without a server");
  command->add_option("SCAN", options->scan, "Scan file (ASE, PLY or OBJ, also inside zstd); - for standard input")
      ->required();
  command->add_flag("--json", options->as_json, "Prints JSON instead of a table");
  command->add_option("--up", options->up, "The file's axis that points up: x, y, z, -x, -y or -z (default: found)");
  command->add_option("--facing", options->facing, "The file's axis that the body looks along (default: found)");
  command->add_option("--unit", options->unit, "The file's unit: m, dm, cm, mm, in or ft (default: found)");
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("body_center", Measure(*options)); });
}

}  // namespace fitroom::body_center
