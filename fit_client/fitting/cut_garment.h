#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/panels/topology.h"

namespace fitroom {

struct CutOptions {
  double pitch = 0.01;    // Edge length of the cloth mesh (unit: metre).
  std::string size;       // Of the garment's chart; empty: as photographed.
  bool with_fork = true;  // Off: trousers stay two panels, as printed.
  // For trousers whose fork is neither stated nor photographed: an estimate that is judged. Empty: an assumed fork is
  // worn and not judged, see CutFork().
  std::optional<ForkRule> fork_rule;
  bool with_coarser = true;  // Off: CutGarment::coarser stays empty.
};

// A garment in one size, cut into panels and meshed: what dressing needs to know of it, the same for every body.
struct CutGarment {
  GarmentKind kind = GarmentKind::kTShirt;
  std::string size;  // Empty where the garment has no chart.
  ClothMesh cloth;
  // The meshes by which it is put on, in their order: of a fine mesh the same panels at twice the pitch, and so on up
  // to a centimetre, the coarsest first; of one coarser than that the panels at a centimetre.
  std::vector<ClothMesh> coarser;
  ClothTopology topology;                // Once it is sewn.
  std::vector<GarmentMeasure> measures;  // Of this size, flat, with how each is known.
  std::vector<std::string> notes;        // What a shopper may want to know of how it was cut.
};

// Reconciles the photographs into one pattern, grades it to the size, rebuilds the fork of trousers where something
// decides it (CutFork()), and meshes it. NOT_FOUND (SIZE_UNKNOWN) for a size
// that the chart does not have, FAILED_PRECONDITION (CHART_MISSING) for any size of a garment without a chart; else
// fails like ReconcileViews(), GradePattern(), BuildFork() and MeshPattern().
Result<CutGarment> CutGarmentToSize(const Garment& garment, const CutOptions& options);

}  // namespace fitroom
