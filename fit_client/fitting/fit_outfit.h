#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/executor.h"
#include "common/base/progress.h"
#include "common/base/status.h"
#include "fit_client/fit/measure/assess_fit.h"
#include "fit_client/fit/stages/dress_garment.h"
#include "fit_client/fitting/cut_garment.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/stopwatch.h"
#include "fit_client/report/fit_report.h"

namespace fitroom {

// One garment of an outfit: which, and in which size.
struct Layer {
  const GarmentInput* garment = nullptr;
  std::string size;  // Of its chart; empty: as photographed.
};

// The corrected method on a solver built for speed, or the method as printed: the reference, slow, and on meshes of 2
// cm and more. README.md of fit_client/fit/paper says where it does not end well.
enum class FitProfile { kStandard, kPaper };

struct FitOptions {
  FitProfile profile = FitProfile::kStandard;
  double pitch = 0.01;                // Edge length of the cloth meshes (unit: metre).
  std::optional<ForkRule> fork_rule;  // See CutOptions.
  bool coarse_to_fine = true;         // Meshes finer than a centimetre are dressed in coarser ones first.
  DressingOptions dressing;           // The material is that of each garment's fabric.
};

// A garment as it is worn.
struct FittedGarment {
  const GarmentInput* input = nullptr;
  CutGarment cut;
  DressingStages stages;
  std::optional<BottomOutcome> bottom;  // What dressing a bottom found out.
  FitMaps maps;                         // Strain, pressure and room all over it.
  FitReport report;                     // All but times, memory and files, which are the command's.
};

// A dressed body. The innermost garment comes first.
struct Outfit {
  TriangleMesh body_surface;  // Without holes: what the garments lie on, and what pictures show.
  std::vector<FittedGarment> garments;
};

// Dresses `body` in `layers`, the innermost first, by the profile of `options`: repairs the body into a collider; cuts
// each garment to its size, dresses it over what is worn already, and measures what came out. Fails like RepairBody(),
// CutGarmentToSize() and DressGarment(); the message names the garment. A garment that does not fit is no failure: its
// report says how it ended. `layers` and what they point to must outlive the outfit.
Result<Outfit> FitOutfit(const BodyInput& body, const std::vector<Layer>& layers, const FitOptions& options,
                         Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress);

// Dresses `body` in every size of the garment's chart, the smallest first, each alone. Each report then holds the
// verdicts of all sizes as worn and which one to take. FAILED_PRECONDITION (CHART_MISSING) for a garment without a
// chart; a size that cannot be cut or dressed at all ends the whole, the message names it.
Result<std::vector<Outfit>> FitAllSizes(const BodyInput& body, const GarmentInput& garment, const FitOptions& options,
                                        Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress);

}  // namespace fitroom
