#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "body_center/cli/commands.h"
#include "body_center/scan/synthetic_scan.h"
#include "body_center/scan/synthetic_scan_file.h"
#include "common/base/exit_code.h"
#include "common/base/file.h"

namespace fitroom::body_center {
namespace {

struct SynthesizeArguments {
  std::string out;
  std::string truth;
  std::string format;
  double stature_cm = 168.0;
  double bust_cm = 88.0;
  double waist_cm = 70.0;
  double hip_cm = 95.0;
  std::optional<double> neck_cm;
  double arm_angle_deg = 30.0;
  SyntheticScanOptions options;
};

Result<SyntheticScanFormat> FormatOf(const SynthesizeArguments& arguments) {
  std::string name = arguments.format;
  if (name.empty()) {
    const std::string extension = std::filesystem::path(arguments.out).extension().string();
    name = extension.empty() ? "ase" : extension.substr(1);
  }
  if (name == "ase" || name == "ASE") return SyntheticScanFormat::kAse;
  if (name == "ply") return SyntheticScanFormat::kPly;
  if (name == "obj") return SyntheticScanFormat::kObj;
  return InvalidArgument("FORMAT_UNKNOWN", "format '" + name + "' is not known: give --format ase, ply or obj");
}

Status Synthesize(const SynthesizeArguments& arguments) {
  FR_ASSIGN_OR_RETURN(const SyntheticScanFormat format, FormatOf(arguments));
  BodySpecification specification;
  specification.stature = arguments.stature_cm / 100.0;
  specification.bust = arguments.bust_cm / 100.0;
  specification.waist = arguments.waist_cm / 100.0;
  specification.hip = arguments.hip_cm / 100.0;
  if (arguments.neck_cm) specification.neck = *arguments.neck_cm / 100.0;
  specification.arm_angle = arguments.arm_angle_deg * std::numbers::pi / 180.0;
  FR_ASSIGN_OR_RETURN(const SyntheticScan scan, SynthesizeScan(specification, arguments.options));
  FR_RETURN_IF_ERROR(WriteSyntheticScan(scan, format, arguments.out));
  if (!arguments.truth.empty()) FR_RETURN_IF_ERROR(WriteFileAtomically(arguments.truth, TruthAsJson(scan)));
  std::cout << arguments.out << ": " << scan.mesh.vertices.size() << " points, " << scan.mesh.triangles.size()
            << " polygons\n";
  return {};
}

}  // namespace

void AddSynthesizeCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("synthesize", "Makes a plausible woman's body from measurements, as a scan");
  auto arguments = std::make_shared<SynthesizeArguments>();
  command->add_option("--out", arguments->out, "File to write; a texture is written beside it")->required();
  command->add_option("--format", arguments->format, "ase, ply or obj; without it the file name's ending decides");
  command->add_option("--truth", arguments->truth, "File for landmarks and girths as constructed (JSON)");
  command->add_option("--stature-cm", arguments->stature_cm, "140 to 195")->capture_default_str();
  command->add_option("--bust-cm", arguments->bust_cm, "70 to 140")->capture_default_str();
  command->add_option("--waist-cm", arguments->waist_cm, "50 to 130")->capture_default_str();
  command->add_option("--hip-cm", arguments->hip_cm, "75 to 150")->capture_default_str();
  command->add_option("--neck-cm", arguments->neck_cm, "26 to 48; without it as goes with stature and bust");
  command->add_option("--arm-angle-deg", arguments->arm_angle_deg, "Upper arms from the vertical, 15 to 60")
      ->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "Of noise and holes")->capture_default_str();
  command->add_flag("--clean", arguments->options.is_clean, "Watertight and without noise");
  command->callback([arguments, &exit_code] { exit_code = ReportAndExitCode("body_center", Synthesize(*arguments)); });
}

}  // namespace fitroom::body_center
