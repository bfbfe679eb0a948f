#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "common/base/executor.h"
#include "common/base/exit_code.h"
#include "common/base/progress.h"
#include "common/base/thread_count.h"
#include "fit_client/cache/cache.h"
#include "fit_client/cli/commands.h"
#include "fit_client/fitting/fit_garment.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/fit_outputs.h"

namespace fitroom::fit_client {
namespace {

struct FitFlags {
  std::string body;     // Pulled scan.
  std::string scan;     // Scan file.
  std::string garment;  // Pulled garment or folder.
  std::string out = "fit";
  double pitch_cm = 1.0;
  int threads = 0;
  bool json = false;
  bool no_pictures = false;
  bool no_model = false;
  bool meshes = false;
};

Result<BodyInput> LoadBody(const FitFlags& flags) {
  if (!flags.scan.empty()) return LoadScan(flags.scan);
  if (flags.body.empty())
    return InvalidArgument("BODY_MISSING", "name a pulled body with --body or a file with --scan");
  FR_ASSIGN_OR_RETURN(const ScanRecord record, FindCachedScan(flags.body));
  FR_ASSIGN_OR_RETURN(Body body, LoadCachedBody(flags.body));
  return BodyInput{ToString(record.name), std::move(body), record.frame.reasons};
}

// A folder on disk comes first; what is none is the name of a pulled garment.
Result<GarmentInput> LoadNamedGarment(const FitFlags& flags) {
  std::error_code error;
  if (std::filesystem::is_directory(flags.garment, error) || !GarmentIdFromUser(flags.garment).ok()) {
    return LoadGarment(flags.garment);
  }
  FR_ASSIGN_OR_RETURN(const std::filesystem::path folder, CachedGarmentFolder(flags.garment));
  return LoadGarment(folder);
}

Status RunFit(const FitFlags& flags) {
  Stopwatch stopwatch;
  ThreadPool executor(flags.threads > 0 ? flags.threads : AvailableThreadCount());
  ProgressBar bar;
  const ProgressSink progress = bar.sink();
  progress("reading", 0.0);
  FR_ASSIGN_OR_RETURN(const BodyInput body, LoadBody(flags));
  stopwatch.Lap("body");
  FR_ASSIGN_OR_RETURN(const GarmentInput garment, LoadNamedGarment(flags));
  stopwatch.Lap("garment");
  FitOptions options;
  options.pitch = flags.pitch_cm * 0.01;
  FR_ASSIGN_OR_RETURN(Fit fit, FitGarment(body, garment, options, executor, stopwatch, progress));
  fit.report.program_version = FITROOM_VERSION;
  FitOutputOptions outputs;
  outputs.pictures = !flags.no_pictures;
  outputs.glb = !flags.no_model;
  outputs.meshes = flags.meshes;
  outputs.thread_count = executor.thread_count();
  FR_RETURN_IF_ERROR(WriteFitOutputs(flags.out, body, garment, fit, outputs, stopwatch, progress));
  const std::string text = flags.json ? WriteJson(fit.report) : WriteText(fit.report);
  std::fputs(text.c_str(), stdout);
  return Status();
}

}  // namespace

void AddFitCommand(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<FitFlags>();
  CLI::App* command = app.add_subcommand("fit", "Dress a body in a garment, on this computer, without any server");
  command->footer(
      "Writes front, side, back and three-quarter pictures, the stages, fitted.glb, report.json and report.txt.\n"
      "Example: fit_client fit --scan me.ase --garment shirt --out worn");
  CLI::Option* body = command->add_option("--body", flags->body, "A pulled scan, as `fit_client pull` names it");
  command->add_option("--scan", flags->scan, "A scan file (ASE, PLY or OBJ) instead of a pulled one")->excludes(body);
  command->add_option("--garment", flags->garment, "A pulled garment's id, or the folder of an extracted one")
      ->required();
  command->add_option("--out", flags->out, "Folder for what the fit makes")->capture_default_str();
  command->add_option("--pitch-cm", flags->pitch_cm, "Edge length of the cloth mesh")
      ->check(CLI::Range(0.4, 4.0))
      ->capture_default_str();
  command->add_option("--threads", flags->threads, "Threads; 0: as many as this computer offers")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  command->add_flag("--json", flags->json, "Print the report as JSON");
  command->add_flag("--no-pictures", flags->no_pictures, "Do not draw");
  command->add_flag("--no-model", flags->no_model, "Do not write the GLB");
  command->add_flag("--meshes", flags->meshes, "Also write garment, panels, body and seams as OBJ and text");
  command->callback([flags, &exit_code] { exit_code = ReportAndExitCode("fit_client fit", RunFit(*flags)); });
}

}  // namespace fitroom::fit_client
