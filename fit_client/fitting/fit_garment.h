#pragma once

#include "common/base/executor.h"
#include "common/base/progress.h"
#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/stages/dress_top.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/stopwatch.h"
#include "fit_client/report/fit_report.h"

namespace fitroom {

struct FitOptions {
  double pitch = 0.01;  // Edge length of the cloth mesh (unit: metre).
  DressTopOptions dressing;
};

// A garment on a body.
struct Fit {
  TriangleMesh body_surface;  // Without holes: what the garment lies on, and what pictures show.
  ClothMesh cloth;
  DressingStages stages;
  FitReport report;  // All but times, memory and files, which are the command's.
};

// Dresses `body` in `garment` with the `standard` profile: reconciles the photographs into one pattern, cuts the
// panels, repairs the body into a collider, dresses, and measures what came out. UNIMPLEMENTED (KIND_NOT_SUPPORTED) for
// anything but a T-shirt or a long sleeve; else fails like ReconcileViews(), MeshPattern(), RepairBody() and
// DressTop(). A garment that does not fit is no failure: the report says how it ended.
Result<Fit> FitGarment(const BodyInput& body, const GarmentInput& garment, const FitOptions& options,
                       Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress);

}  // namespace fitroom
