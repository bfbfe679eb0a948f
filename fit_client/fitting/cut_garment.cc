#include "fit_client/fitting/cut_garment.h"

#include <utility>

#include "fit_client/fit/fork/fork_mesh.h"
#include "fit_client/fit/grading/grade.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fitting/cut_fork.h"

namespace fitroom {
namespace {

std::string SizeNames(const SizeChart& chart) {
  std::string names;
  for (const GarmentSize& size : chart.sizes) names += (names.empty() ? "" : ", ") + size.name;
  return names;
}

// Makes the pattern of the wanted size; returns its name, empty where there is no chart.
Result<std::string> GradeToSize(const Garment& garment, const std::string& wanted, GarmentPattern& pattern) {
  const std::string& photographed = garment.chart.photographed_size;
  if (wanted.empty() || (!garment.chart.sizes.empty() && wanted == photographed)) return photographed;
  if (garment.chart.sizes.empty()) {
    return FailedPrecondition("CHART_MISSING", garment.id +
                                                   " was published without a size chart; only the "
                                                   "photographed size can be fitted: leave out the size");
  }
  const GarmentSize* from = FindSize(garment.chart, photographed);
  const GarmentSize* to = FindSize(garment.chart, wanted);
  if (to == nullptr || from == nullptr) {
    return NotFound("SIZE_UNKNOWN",
                    garment.id + " has no size \"" + wanted + "\"; its sizes are " + SizeNames(garment.chart));
  }
  FR_ASSIGN_OR_RETURN(pattern, GradePattern(pattern, *from, *to));
  return to->name;
}

// What the shop states of a hidden measure stands where the photographs cannot tell.
std::vector<GarmentMeasure> MeasuresOf(const Garment& garment, const GarmentPattern& pattern, const std::string& size) {
  std::vector<GarmentMeasure> measures = MeasurePattern(pattern);
  const GarmentSize* row = FindSize(garment.chart, size);
  for (GarmentMeasure& measure : measures) {
    if (measure.provenance != Provenance::kUnknown) continue;
    const GarmentMeasure* stated = row != nullptr ? FindMeasure(row->measures, measure.name) : nullptr;
    const bool is_photographed = row == nullptr || size == garment.chart.photographed_size;
    if (stated == nullptr && is_photographed) stated = FindMeasure(garment.measures, measure.name);
    if (stated == nullptr || stated->provenance == Provenance::kUnknown) continue;
    measure.value = stated->value;
    measure.provenance = stated->provenance;
  }
  return measures;
}

// A fork that was rebuilt says what folding hid, and how it is known.
void TakeForkMeasures(const ForkedPattern& forked, std::vector<GarmentMeasure>& measures) {
  for (GarmentMeasure& measure : measures) {
    const GarmentMeasure* rebuilt = FindMeasure(forked.measures, measure.name);
    if (rebuilt != nullptr && measure.provenance != Provenance::kMeasured) measure = *rebuilt;
  }
}

// Round sleeves, armholes, straps and the crotch no mesh has longer edges: longer ones find no room between arm and
// trunk, and garments hang higher on them (unit: metre).
constexpr double kTightPitch = 0.0125;

// Meshes the panels at twice the pitch, and so on up to a centimetre, the coarsest first; a garment that such a mesh
// cannot hold does without. Coarser ones come to rest late where arm and trunk leave little room. A mesh that is
// coarser itself is put on by one of a centimetre: friction holds a garment where the way there left it, so that meshes
// agree only if they take the same way.
template <typename Mesh>
std::vector<ClothMesh> CoarserMeshes(double pitch, const Mesh& mesh) {
  constexpr double kCoarsestPitch = 0.0125;  // (unit: metre)
  constexpr double kDressingPitch = 0.01;    // (unit: metre)
  std::vector<ClothMesh> coarser;
  if (pitch > kCoarsestPitch) {
    Result<ClothMesh> made = mesh(kDressingPitch);
    if (made.ok()) coarser.push_back(std::move(made).value());
    return coarser;
  }
  for (double coarse = 2.0 * pitch; coarse <= kCoarsestPitch; coarse *= 2.0) {
    Result<ClothMesh> made = mesh(coarse);
    if (!made.ok()) break;
    coarser.insert(coarser.begin(), std::move(made).value());
  }
  return coarser;
}

}  // namespace

Result<CutGarment> CutGarmentToSize(const Garment& garment, const CutOptions& options) {
  CutGarment cut;
  cut.kind = garment.kind;
  FR_ASSIGN_OR_RETURN(const GarmentPattern photographed, ReconcileViews(garment));
  GarmentPattern pattern = photographed;
  FR_ASSIGN_OR_RETURN(cut.size, GradeToSize(garment, options.size, pattern));
  CutForkResult fork;
  if (options.with_fork) {
    FR_ASSIGN_OR_RETURN(fork, CutFork(garment, photographed, pattern, cut.size, options.fork_rule, cut.notes));
  }
  const std::optional<ForkedPattern>& forked = fork.forked;
  const auto mesh = [&](double pitch) {
    return forked ? MeshFork(*forked, pitch, kTightPitch) : MeshPattern(pattern, pitch, kTightPitch);
  };
  FR_ASSIGN_OR_RETURN(cut.cloth, mesh(options.pitch));
  if (options.with_coarser) cut.coarser = CoarserMeshes(options.pitch, mesh);
  cut.topology = ComputeWeldedTopology(cut.cloth);
  cut.measures = MeasuresOf(garment, pattern, cut.size);
  if (forked && !fork.is_assumed) TakeForkMeasures(*forked, cut.measures);
  if (pattern.asymmetric_by_design) {
    cut.notes.push_back("the garment is asymmetric by design; left and right are kept");
  }
  return cut;
}

}  // namespace fitroom
