#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/executor.h"
#include "common/base/exit_code.h"
#include "common/base/progress.h"
#include "common/base/thread_count.h"
#include "fit_client/cache/cache.h"
#include "fit_client/cli/commands.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/fit_outfit.h"
#include "fit_client/fitting/fit_outputs.h"
#include "fit_client/fitting/own_size.h"

namespace fitroom::fit_client {
namespace {

struct FitFlags {
  std::string body;                   // Pulled scan.
  std::string scan;                   // Scan file.
  std::string up, facing, unit;       // Of the scan file, where its shape does not tell.
  std::vector<std::string> garments;  // Pulled garments or folders, the innermost first.
  std::vector<std::string> sizes;     // One a garment, or none.
  std::string out = "fit";
  double pitch_cm = 1.0;
  int threads = 0;
  bool json = false;
  bool no_pictures = false;
  bool no_model = false;
  bool meshes = false;
  bool maps = false;
  bool film = false;
  bool all_sizes = false;
  bool no_self_collision = false;
  std::string fork;
  std::string profile = "standard";
};

Result<BodyInput> LoadBody(const FitFlags& flags) {
  if (!flags.scan.empty()) {
    FrameOverrides overrides;
    if (!flags.up.empty()) {
      FR_ASSIGN_OR_RETURN(overrides.up, ParseAxis(flags.up));
    }
    if (!flags.facing.empty()) {
      FR_ASSIGN_OR_RETURN(overrides.facing, ParseAxis(flags.facing));
    }
    if (!flags.unit.empty()) {
      FR_ASSIGN_OR_RETURN(overrides.unit, ParseUnit(flags.unit));
    }
    return LoadScan(flags.scan, overrides);
  }
  if (flags.body.empty()) {
    return InvalidArgument("BODY_MISSING", "name a pulled body with --body or a file with --scan");
  }
  FR_ASSIGN_OR_RETURN(const ScanRecord record, FindCachedScan(flags.body));
  FR_ASSIGN_OR_RETURN(Body body, LoadCachedBody(flags.body));
  return BodyInput{ToString(record.name), std::move(body), record.frame.reasons};
}

// A folder on disk comes first; what is none is the name of a pulled garment.
Result<GarmentInput> LoadNamedGarment(const std::string& name) {
  std::error_code error;
  if (std::filesystem::is_directory(name, error) || !GarmentIdFromUser(name).ok()) return LoadGarment(name);
  FR_ASSIGN_OR_RETURN(const std::filesystem::path folder, CachedGarmentFolder(name));
  return LoadGarment(folder);
}

Result<std::vector<GarmentInput>> LoadGarments(const FitFlags& flags) {
  std::vector<GarmentInput> garments;
  for (const std::string& name : flags.garments) {
    FR_ASSIGN_OR_RETURN(GarmentInput garment, LoadNamedGarment(name));
    garments.push_back(std::move(garment));
  }
  return garments;
}

// What a fit starts from.
struct FitInputs {
  BodyInput body;
  std::vector<GarmentInput> garments;
};

// Reads the body and the garments side by side; where both fail the body's failure is said.
Result<FitInputs> LoadInputs(const FitFlags& flags, Executor& executor) {
  std::optional<Result<BodyInput>> body;
  std::optional<Result<std::vector<GarmentInput>>> garments;
  std::array<std::exception_ptr, 2> thrown;  // Tasks must not throw.
  executor.Run(2, [&](int task) {
    try {
      if (task == 0) {
        body = LoadBody(flags);
      } else {
        garments = LoadGarments(flags);
      }
    } catch (...) {
      thrown[static_cast<size_t>(task)] = std::current_exception();
    }
  });
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
  FitInputs inputs;
  FR_ASSIGN_OR_RETURN(inputs.body, std::move(*body));
  FR_ASSIGN_OR_RETURN(inputs.garments, std::move(*garments));
  return inputs;
}

// The sizes belong to the garments in order; a single one counts for a single garment, a single "auto" for all.
Result<std::vector<Layer>> MakeLayers(const FitFlags& flags, const BodyInput& body,
                                      const std::vector<GarmentInput>& garments) {
  const bool own_sizes = flags.sizes.size() == 1 && flags.sizes.front() == kOwnSize;
  if (!own_sizes && !flags.sizes.empty() && flags.sizes.size() != garments.size()) {
    return InvalidArgument("SIZES_DO_NOT_MATCH",
                           "there are " + std::to_string(garments.size()) + " garments and " +
                               std::to_string(flags.sizes.size()) +
                               " sizes; give --size once a garment, in the same order, or not at all");
  }
  std::vector<Layer> layers;
  for (size_t i = 0; i < garments.size(); ++i) {
    std::string size = flags.sizes.empty() ? std::string() : flags.sizes[own_sizes ? 0 : i];
    if (size == kOwnSize) {
      FR_ASSIGN_OR_RETURN(const SizeChoice own, ChooseOwnSize(garments[i].garment, body.body));
      size = own.size;
    }
    layers.push_back({&garments[i], size});
  }
  return layers;
}

Result<FitOptions> MakeOptions(const FitFlags& flags) {
  FitOptions options;
  options.pitch = flags.pitch_cm * 0.01;
  if (flags.profile == "paper") {
    options.profile = FitProfile::kPaper;
    if (flags.pitch_cm < 2.0) {
      return InvalidArgument("PITCH_TOO_FINE",
                             "the profile \"paper\" takes meshes of 2 cm and more; add --pitch-cm 2.5");
    }
  }
  options.dressing.drape.self_collision = !flags.no_self_collision;
  if (!flags.fork.empty()) {
    options.fork_rule = ForkRuleFromName(flags.fork);
    if (!options.fork_rule) {
      return InvalidArgument("FORK_RULE_UNKNOWN", "\"" + flags.fork +
                                                      "\" is no drafting rule; take close, trouser, "
                                                      "classic, aldrich, titan or garment_code");
    }
  }
  return options;
}

// Dresses the body in every size, draws them side by side and returns the one to take. What it wrote goes into
// `written`.
Result<Outfit> FitBestOfAllSizes(const FitFlags& flags, const BodyInput& body,
                                 const std::vector<GarmentInput>& garments, const FitOptions& options,
                                 Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress,
                                 std::vector<OutputFile>& written) {
  if (garments.size() != 1 || !flags.sizes.empty()) {
    return InvalidArgument("ONE_GARMENT_ONLY", "--all-sizes takes a single --garment and no --size");
  }
  FR_ASSIGN_OR_RETURN(std::vector<Outfit> sizes,
                      FitAllSizes(body, garments.front(), options, executor, stopwatch, progress));
  if (!flags.no_pictures) {
    FR_ASSIGN_OR_RETURN(OutputFile sheet, WriteSizeSheet(flags.out, sizes, executor.thread_count()));
    written.push_back(std::move(sheet));
    stopwatch.Lap("sheet of sizes");
  }
  std::string best = sizes.front().garments.front().report.recommendation->size;
  if (best.empty()) best = garments.front().garment.chart.photographed_size;
  for (Outfit& outfit : sizes) {
    if (outfit.garments.front().cut.size == best) return std::move(outfit);
  }
  return std::move(sizes.front());
}

Status RunFit(const FitFlags& flags) {
  Stopwatch stopwatch;
  ThreadPool executor(flags.threads > 0 ? flags.threads : AvailableThreadCount());
  ProgressBar bar;
  const ProgressSink progress = bar.sink();
  progress("reading", 0.0);
  FR_ASSIGN_OR_RETURN(const FitInputs inputs, LoadInputs(flags, executor));
  const BodyInput& body = inputs.body;
  const std::vector<GarmentInput>& garments = inputs.garments;
  FR_ASSIGN_OR_RETURN(const std::vector<Layer> layers, MakeLayers(flags, body, garments));
  stopwatch.Lap("body, garments");
  FR_ASSIGN_OR_RETURN(const FitOptions options, MakeOptions(flags));
  FitOutputOptions outputs;
  FR_ASSIGN_OR_RETURN(Outfit outfit, flags.all_sizes ? FitBestOfAllSizes(flags, body, garments, options, executor,
                                                                         stopwatch, progress, outputs.written_before)
                                                     : FitOutfit(body, layers, options, executor, stopwatch, progress));
  for (FittedGarment& worn : outfit.garments) worn.report.program_version = FITROOM_VERSION;
  outputs.pictures = !flags.no_pictures;
  outputs.glb = !flags.no_model;
  outputs.meshes = flags.meshes;
  outputs.maps = flags.maps;
  outputs.film = flags.film;
  outputs.thread_count = executor.thread_count();
  FR_RETURN_IF_ERROR(WriteFitOutputs(flags.out, body, outfit, outputs, stopwatch, progress));
  const std::string text = flags.json ? OutfitJson(outfit) : OutfitText(outfit);
  std::fputs(text.c_str(), stdout);
  return Status();
}

}  // namespace

void AddFitCommand(CLI::App& app, int& exit_code) {
  auto flags = std::make_shared<FitFlags>();
  CLI::App* command = app.add_subcommand("fit", "Dress a body in garments, on this computer, without any server");
  command->footer(
      "Writes front, side, back and three-quarter pictures, the stages, fitted.glb, report.json, report.txt and a "
      "page, index.html.\n"
      "Example: fit_client fit --scan me.ase --garment shirt --out worn");
  CLI::Option* body = command->add_option("--body", flags->body, "A pulled scan, as `fit_client pull` names it");
  command->add_option("--scan", flags->scan, "A scan file (ASE, PLY or OBJ) instead of a pulled one")->excludes(body);
  command->add_option("--up", flags->up, "The scan file's axis that points up: x, y, z, -x, -y or -z (default: found)")
      ->excludes(body);
  command->add_option("--facing", flags->facing, "The scan file's axis that the body looks along (default: found)")
      ->excludes(body);
  command->add_option("--unit", flags->unit, "The scan file's unit: m, dm, cm, mm, in or ft (default: found)")
      ->excludes(body);
  command
      ->add_option("--garment", flags->garments,
                   "A pulled garment's id, or the folder of an extracted one; several times for layers, the innermost "
                   "first")
      ->required();
  command->add_option("--size", flags->sizes,
                      "A size of its chart, once a garment, or auto: yours by the chart (default: as photographed)");
  command->add_option("--out", flags->out, "Folder for what the fit makes")->capture_default_str();
  command->add_option("--pitch-cm", flags->pitch_cm, "Edge length of the cloth mesh")
      ->check(CLI::Range(0.4, 4.0))
      ->capture_default_str();
  command->add_option("--threads", flags->threads, "Threads; 0: as many as this computer offers")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  command->add_flag("--all-sizes", flags->all_sizes,
                    "Fit every size of the garment's chart, draw them side by side (sizes.png) and keep the best");
  command->add_option("--fork", flags->fork,
                      "Drafting rule for the fork of trousers where nothing tells of it: close, trouser, classic, "
                      "aldrich, titan or garment_code");
  command
      ->add_option("--profile", flags->profile,
                   "standard, or paper: the method as printed, slow, for meshes of 2 cm and more")
      ->check(CLI::IsMember({"standard", "paper"}))
      ->capture_default_str();
  command->add_flag("--maps", flags->maps, "Also draw maps of strain, pressure and gap");
  command->add_flag("--film", flags->film, "Also draw a film of the dressing (dressing.webp)");
  command->add_flag("--no-self-collision", flags->no_self_collision, "Let the cloth pass through itself: faster");
  command->add_flag("--json", flags->json, "Print the report as JSON");
  command->add_flag("--no-pictures", flags->no_pictures, "Do not draw");
  command->add_flag("--no-model", flags->no_model, "Do not write the GLB");
  command->add_flag("--meshes", flags->meshes, "Also write garment, panels, body and seams as OBJ and text");
  command->callback([flags, &exit_code] { exit_code = ReportAndExitCode("fit_client fit", RunFit(*flags)); });
}

}  // namespace fitroom::fit_client
