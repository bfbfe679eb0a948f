#include "fit_client/fit/refine/dress_coarse_to_fine.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "fit_client/fit/refine/carry_over.h"
#include "fit_client/fit/stages/belt.h"
#include "fit_client/fit/stages/bottom_outline.h"
#include "fit_client/fit/stages/dress_garment.h"
#include "fit_client/fit/stages/lower_body.h"

namespace fitroom {
namespace {

constexpr double kSewnGap = 0.004;  // Carried partners that are closer were sewn on the coarse mesh (unit: metre).
// A coarse mesh that has not come to rest after so many substeps trembles: a finer one has more room.
constexpr int kCoarseSubstepLimit = 6000;
constexpr double kCoarseShare = 0.4;  // Of the progress.

// The outlines of two meshes differ by the chords of their curves: partners of a closed seam meet in the middle.
void CloseSeams(const ClothMesh& mesh, std::vector<Eigen::Vector3d>& positions) {
  for (const SeamPair& pair : mesh.seams) {
    Eigen::Vector3d& a = positions[static_cast<size_t>(pair.a)];
    Eigen::Vector3d& b = positions[static_cast<size_t>(pair.b)];
    if ((a - b).norm() < kSewnGap) a = b = 0.5 * (a + b);
  }
}

std::vector<int> FindNamed(const ClothMesh& mesh, const std::vector<std::string>& names) {
  std::vector<int> vertices;
  for (const NamedParticle& named : mesh.named_particles) {
    if (std::find(names.begin(), names.end(), named.name) != names.end()) vertices.push_back(named.particle);
  }
  return vertices;
}

// What was done before the fine mesh settled counts on.
void AddHistory(const DrapeReport& before, DrapeReport& report) {
  report.merging_substeps += before.merging_substeps;
  report.relaxing_substeps += before.relaxing_substeps;
  report.pulling_substeps += before.pulling_substeps;
  report.belting_substeps += before.belting_substeps;
  report.tugging_substeps += before.tugging_substeps;
  report.tugged_way += before.tugged_way;
  report.draping_substeps += before.draping_substeps;
  report.simulated_seconds += before.simulated_seconds;
  report.pull_end = before.pull_end;
  report.seam_gap_mean = before.seam_gap_mean;
  report.seam_gap_p95 = before.seam_gap_p95;
  report.seam_gap_max = before.seam_gap_max;
}

// Carries a worn garment over to a finer mesh and lets it settle there.
Result<Dressing> Refine(const ClothMesh& coarse, const Dressing& worn, const ClothMesh& fine, const DressedBody& wearer,
                        const DressingOptions& options, Executor& executor,
                        const std::function<void(double done)>& progress) {
  FR_ASSIGN_OR_RETURN(const std::vector<PlaceOnMesh> places, FindPlaces(coarse, fine));
  Dressing result;
  result.field = worn.field;
  result.shoulder_points = worn.shoulder_points;
  result.shoulder_point_count = worn.shoulder_point_count;
  result.yielding_below = worn.yielding_below;
  result.bottom = worn.bottom;
  result.stages.start = CarryOver(places, worn.stages.start);
  result.stages.merging = CarryOver(places, worn.stages.merging);
  result.stages.stitched = CarryOver(places, worn.stages.stitched);
  result.stages.pulled_up = CarryOver(places, worn.stages.pulled_up);
  result.stages.belted = CarryOver(places, worn.stages.belted);
  std::vector<Eigen::Vector3d> positions = CarryOver(places, worn.stages.final);
  CloseSeams(fine, positions);

  DrapeOptions drape = options.drape;
  drape.contact_offset += worn.yielding_below;
  drape.touching_distance += worn.yielding_below;
  drape.touching_vertices = FindNamed(fine, worn.shoulder_points);
  if (worn.bottom) {
    FR_ASSIGN_OR_RETURN(const BottomOutline outline, FindBottomOutline(fine));
    FR_ASSIGN_OR_RETURN(const LowerBody lower, LowerBody::Cut(wearer.body, wearer.collider, wearer.layers));
    const double height = worn.bottom->belt.height;
    FR_ASSIGN_OR_RETURN(Belt belt, LayBelt(outline, lower.At(height).trunk, height, lower.groin().x(),
                                           drape.contact_offset + kBeltClearance));
    result.bottom->belt = belt.measure;
    drape.attach = [held = std::move(belt.attachments)](
                       std::span<const Eigen::Vector3d>) -> Result<std::vector<Attachment>> { return held; };
    for (const auto& side : outline.outseams) drape.measured_chains.push_back(side[0].particles);
  }
  const DrapeObserver observer = [&](const DrapeSnapshot& snapshot) {
    if (progress) progress(snapshot.progress);
  };
  FR_ASSIGN_OR_RETURN(DrapeResult settled, Settle(fine, positions, *worn.field, drape, executor, observer));
  result.stages.final = std::move(settled.positions);
  result.report = std::move(settled.report);
  AddHistory(worn.report, result.report);
  if (result.bottom) {
    result.bottom->outseam_residual = result.report.length_residual;
    result.bottom->ended_by_outseams = result.report.length_condition_met;
  }
  return result;
}

}  // namespace

Result<Dressing> DressCoarseToFine(std::span<const ClothMesh* const> meshes, GarmentKind kind,
                                   const DressedBody& wearer, const DressingOptions& options, Executor& executor,
                                   const std::function<void(double done)>& progress) {
  FR_CHECK(!meshes.empty());
  if (meshes.size() == 1) return DressGarment(*meshes.front(), kind, wearer, options, executor, progress);
  const auto part = [&progress](double begin, double share) -> std::function<void(double done)> {
    if (!progress) return {};
    return [&progress, begin, share](double done) { progress(begin + share * done); };
  };
  DressingOptions coarse_options = options;
  coarse_options.drape.draping_substep_limit = std::min(options.drape.draping_substep_limit, kCoarseSubstepLimit);
  FR_ASSIGN_OR_RETURN(Dressing worn,
                      DressGarment(*meshes.front(), kind, wearer, coarse_options, executor, part(0.0, kCoarseShare)));
  if (worn.report.outcome == DrapeOutcome::kSeamsOpen) {
    // How far seams give way is found while the garment is put on: the fine mesh finds its own.
    return DressGarment(*meshes.back(), kind, wearer, options, executor, part(kCoarseShare, 1.0 - kCoarseShare));
  }
  const double share = (1.0 - kCoarseShare) / static_cast<double>(meshes.size() - 1);
  for (size_t level = 1; level < meshes.size(); ++level) {
    const double begin = kCoarseShare + share * static_cast<double>(level - 1);
    FR_ASSIGN_OR_RETURN(
        worn, Refine(*meshes[level - 1], worn, *meshes[level], wearer, options, executor, part(begin, share)));
  }
  return worn;
}

}  // namespace fitroom
