#include "fit_client/fit/solver/drape.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "fit_client/fit/solver/drape_hanging.h"
#include "fit_client/fit/solver/drape_measures.h"
#include "fit_client/fit/solver/drape_merging.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {
namespace {

// Says in a sentence how the run ended.
void Conclude(DrapeRun& run) {
  DrapeReport& report = run.report;
  const std::vector<double> gaps = run.SeamGaps();
  char text[200] = "";
  if (report.outcome == DrapeOutcome::kSeamsOpen && !report.openings.empty()) {
    const SeamOpening& opening = report.openings.front();
    std::snprintf(text, sizeof(text), "does not close by %.0f mm: the %s is open over %.0f cm, a gap of %.0f mm%s",
                  opening.lacking_girth * 1e3, OpeningName(opening).c_str(), opening.seam_length * 100.0,
                  opening.gap * 1e3, report.is_open_at_rest ? "" : "; not at rest at the step limit");
  } else if (report.outcome == DrapeOutcome::kSeamsOpen) {
    size_t worst = 0;
    for (size_t index = 0; index < gaps.size(); ++index) {
      if (gaps[index] > gaps[worst]) worst = index;
    }
    const Eigen::Vector3d& place = run.positions[static_cast<size_t>(run.mesh.seams[worst].a)];
    std::snprintf(text, sizeof(text),
                  "does not close: a gap of %.1f mm is left at (%.3f, %.3f, %.3f) m; %d of %d pairs open",
                  gaps[worst] * 1e3, place.x(), place.y(), place.z(), report.open_seam_count, report.seam_pair_count);
  } else if (report.outcome == DrapeOutcome::kAtRest) {
    std::snprintf(text, sizeof(text), "at rest: %.1f %% of the particles are slower than %.1f mm/s",
                  report.share_at_rest * 100.0, run.options.rest_speed * 1e3);
  } else {
    std::snprintf(text, sizeof(text), "not at rest after %d substeps: 99 %% are slower than %.1f mm/s",
                  report.draping_substeps, report.speed_p99 * 1e3);
  }
  report.finishing_reason = text;
  report.open_seam_count = static_cast<int>(
      std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap > run.options.closed_gap; }));
  report.final_seam_gap_max = gaps.empty() ? 0.0 : Percentile(gaps, 1.0);
}

Status CheckInput(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start, const DrapeOptions& options) {
  const int vertex_count = static_cast<int>(mesh.rest_positions.size());
  if (start.size() != mesh.rest_positions.size()) {
    return InvalidArgument("START_SIZE_MISMATCH", "there must be one start position a vertex of the cloth");
  }
  for (size_t vertex = 0; vertex < start.size(); ++vertex) {
    if (!start[vertex].allFinite() || start[vertex].cwiseAbs().maxCoeff() > 100.0) {
      return InvalidArgument("START_NOT_FINITE", "the start position of cloth vertex " + std::to_string(vertex) +
                                                     " is not finite or further than 100 m from the origin");
    }
  }
  for (const SeamPair& pair : mesh.seams) {
    if (std::min(pair.a, pair.b) < 0 || std::max(pair.a, pair.b) >= vertex_count) {
      return InvalidArgument("SEAM_INDEX_OUT_OF_RANGE", "a seam pair names a vertex that does not exist");
    }
  }
  const auto exist = [vertex_count](const std::vector<int>& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return v >= 0 && v < vertex_count; });
  };
  if (!exist(options.touching_vertices)) {
    return InvalidArgument("VERTEX_OUT_OF_RANGE", "a touching vertex does not exist");
  }
  if (options.pull_up && (!exist(options.pull_up->crotch_vertices) || !exist(options.pull_up->edge_vertices))) {
    return InvalidArgument("VERTEX_OUT_OF_RANGE", "a vertex of the crotch or of the waist does not exist");
  }
  if (!std::all_of(options.measured_chains.begin(), options.measured_chains.end(), exist)) {
    return InvalidArgument("VERTEX_OUT_OF_RANGE", "a vertex of a measured chain does not exist");
  }
  if (!options.gravity.allFinite()) return InvalidArgument("GRAVITY_NOT_FINITE", "gravity is not finite");
  return Status();
}

}  // namespace

std::string_view DrapeStageName(DrapeStage stage) {
  switch (stage) {
    case DrapeStage::kStart:
      return "start";
    case DrapeStage::kMerging:
      return "merging";
    case DrapeStage::kStitched:
      return "stitched";
    case DrapeStage::kPulledUp:
      return "pulled_up";
    case DrapeStage::kBelted:
      return "belted";
    case DrapeStage::kDraping:
      return "draping";
    case DrapeStage::kFinished:
      return "finished";
  }
  return "";
}

std::string_view PullEndName(PullEnd end) {
  switch (end) {
    case PullEnd::kNotPulled:
      return "not_pulled";
    case PullEnd::kCrotchContact:
      return "crotch_contact";
    case PullEnd::kEdgeAtHeight:
      return "edge_at_height";
    case PullEnd::kStuck:
      return "stuck";
    case PullEnd::kStepLimit:
      return "step_limit";
  }
  return "";
}

std::string_view DrapeOutcomeName(DrapeOutcome outcome) {
  switch (outcome) {
    case DrapeOutcome::kAtRest:
      return "at_rest";
    case DrapeOutcome::kSeamsOpen:
      return "seams_open";
    case DrapeOutcome::kNotAtRest:
      return "not_at_rest";
  }
  return "";
}

std::string OpeningName(const SeamOpening& opening) {
  return std::string(opening.is_left ? "left " : "right ") + (opening.is_sleeve ? "sleeve's seam" : "side seam");
}

std::vector<Eigen::Vector3d> SeparateSeamPartners(const ClothMesh& mesh, std::span<const Eigen::Vector3d> positions,
                                                  double gap) {
  std::vector<Eigen::Vector3d> neighbours(positions.size(), Eigen::Vector3d::Zero());
  std::vector<int> counts(positions.size(), 0);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const size_t at = static_cast<size_t>(triangle[corner]);
      for (const int step : {1, 2}) {
        neighbours[at] += positions[static_cast<size_t>(triangle[(corner + step) % 3])];
        ++counts[at];
      }
    }
  }
  std::vector<Eigen::Vector3d> separated(positions.begin(), positions.end());
  for (const SeamPair& pair : mesh.seams) {
    for (const int vertex : {pair.a, pair.b}) {
      const size_t at = static_cast<size_t>(vertex);
      if (counts[at] == 0) continue;
      const Eigen::Vector3d inwards = neighbours[at] / counts[at] - positions[at];
      if (inwards.norm() > 1e-9) separated[at] = positions[at] + inwards.normalized() * (0.5 * gap);
    }
  }
  return separated;
}

Result<DrapeResult> Drape(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                          const SignedDistanceField& body, const DrapeOptions& options, Executor& executor,
                          const DrapeObserver& observer) {
  FR_RETURN_IF_ERROR(CheckInput(mesh, start_positions, options));
  DrapeRun run{mesh, body, options, executor, observer, {start_positions.begin(), start_positions.end()},
               {},   0,    {},      {},       {},       {}};
  run.Observe(DrapeStage::kStart, 0.0);
  FR_RETURN_IF_ERROR(MergeSeams(run));
  run.Observe(DrapeStage::kStitched, 0.3);
  FR_RETURN_IF_ERROR(HangGarment(run));
  Conclude(run);
  run.Observe(DrapeStage::kFinished, 1.0);
  return DrapeResult{std::move(run.positions), std::move(run.report)};
}

Result<DrapeResult> Settle(const ClothMesh& mesh, std::span<const Eigen::Vector3d> worn_positions,
                           const SignedDistanceField& body, const DrapeOptions& options, Executor& executor,
                           const DrapeObserver& observer) {
  FR_RETURN_IF_ERROR(CheckInput(mesh, worn_positions, options));
  DrapeRun run{mesh, body, options, executor, observer, {worn_positions.begin(), worn_positions.end()},
               {},   0,    {},      {},       {},       {}};
  run.Observe(DrapeStage::kStart, 0.0);
  TakeSeams(run);
  FR_RETURN_IF_ERROR(SettleGarment(run));
  Conclude(run);
  run.Observe(DrapeStage::kFinished, 1.0);
  return DrapeResult{std::move(run.positions), std::move(run.report)};
}

}  // namespace fitroom
