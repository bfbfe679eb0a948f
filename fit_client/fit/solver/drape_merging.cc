#include "fit_client/fit/solver/drape_merging.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fit_client/fit/solver/drape_hoops.h"
#include "fit_client/fit/solver/drape_measures.h"
#include "fit_client/fit/solver/drape_opening.h"

namespace fitroom {
namespace {

// Rates of merging. Tuned on T-shirts of 2 to 0.5 cm pitch.
constexpr double kApproachSpeed = 1.2;  // Of whole panels towards each other (unit: m/s).
constexpr double kApproachRate = 12.0;  // The speed falls to gap times this as the seams close (unit: 1/s).
constexpr int kCheckInterval = 16;      // Substeps between looks at the seams.
constexpr int kPatience = 8;            // Looks without progress before pulls are doubled,
constexpr double kStrongestPull = 8.0;  // as far as this times the closing speed; then merging is given up.
constexpr double kProgress = 2e-4;      // Less than this in `kPatience` looks is no progress (unit: metre).

// Whole panels move towards their partners, like someone laying them on the body, so that the outline does not have to
// drag them there. The speed falls with the gap that is left.
void SetApproachWind(const DrapeRun& run, const ClothModel& model, const ClothPieces& pieces, double mean_gap,
                     ClothState& state) {
  std::vector<Eigen::Vector3d> way(static_cast<size_t>(pieces.count), Eigen::Vector3d::Zero());
  const auto panel_of = [&](int vertex) {
    return static_cast<size_t>(pieces.piece_of_particle[static_cast<size_t>(vertex)]);
  };
  for (const SeamPair& pair : run.mesh.seams) {
    const Eigen::Vector3d to_b =
        run.positions[static_cast<size_t>(pair.b)] - run.positions[static_cast<size_t>(pair.a)];
    way[panel_of(pair.a)] += to_b;
    way[panel_of(pair.b)] -= to_b;
  }
  const double speed = std::min(kApproachSpeed, kApproachRate * mean_gap);
  state.wind.assign(state.positions.size(), Float4());
  for (size_t vertex = 0; vertex < run.positions.size(); ++vertex) {
    const Eigen::Vector3d& direction = way[panel_of(static_cast<int>(vertex))];
    if (direction.norm() < 1e-9) continue;
    const Eigen::Vector3f wind = (direction.normalized() * speed).cast<float>();
    state.wind[static_cast<size_t>(model.particle_of_vertex()[vertex])] = {wind.x(), wind.y(), wind.z(), 0.0F};
  }
}

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

bool IsTied(const DrapeRun& run, size_t pair) { return !run.tie_lengths.empty() && run.tie_lengths[pair] > 0.0; }

// The gaps of the pairs that are to close.
std::vector<double> GapsToClose(const DrapeRun& run) {
  std::vector<double> gaps = run.SeamGaps();
  for (size_t pair = 0; pair < gaps.size(); ++pair) {
    if (IsTied(run, pair)) gaps[pair] = 0.0;
  }
  return gaps;
}

std::vector<SeamPair> PairsToClose(const DrapeRun& run) {
  std::vector<SeamPair> pairs;
  for (size_t pair = 0; pair < run.mesh.seams.size(); ++pair) {
    if (!IsTied(run, pair)) pairs.push_back(run.mesh.seams[pair]);
  }
  return pairs;
}

// No pull closes the seams: where girth is missing, one of them gives way to the others. Returns whether any does.
bool GiveWay(DrapeRun& run) {
  if (!(run.options.limit_strain > 0.0) || !run.tie_lengths.empty()) return false;
  run.hoops = FindHoops(run.mesh);
  std::vector<double> ties = FindOpenings(run);
  if (std::none_of(ties.begin(), ties.end(), [](double tie) { return tie > 0.0; })) return false;
  run.tie_lengths = std::move(ties);
  return true;
}

void DescribeGaps(DrapeRun& run) {
  const std::vector<double> to_close = GapsToClose(run);
  for (size_t index = 0; index < to_close.size(); ++index) {
    if (to_close[index] > run.options.closed_gap) run.open_seams.push_back(run.mesh.seams[index]);
  }
  const std::vector<double> gaps = run.SeamGaps();
  run.report.open_seam_count = static_cast<int>(run.open_seams.size());
  if (gaps.empty()) return;
  run.report.seam_gap_mean = Mean(gaps);
  run.report.seam_gap_p95 = Percentile(gaps, 0.95);
  run.report.seam_gap_max = Percentile(gaps, 1.0);
}

}  // namespace

Status MergeSeams(DrapeRun& run) {
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(run.mesh, run.options.material, {}));
  const ClothPieces pieces = FindPieces(run.mesh);
  ClothSolver solver(model, run.body, run.executor);
  solver.SetMotion(QuasiStaticMotion(run.options));
  ClothState state = solver.MakeState(run.ParticlePositions(model));

  run.report.seam_pair_count = static_cast<int>(run.mesh.seams.size());
  double best = 1e9;
  int looks_since_progress = 0;
  double strength = 1.0;
  std::vector<double> gaps = run.SeamGaps();
  while (!gaps.empty()) {
    const double mean = Mean(gaps);
    const double largest = *std::max_element(gaps.begin(), gaps.end());
    if (largest <= run.options.closed_gap || run.report.merging_substeps >= run.options.merging_substep_limit) break;
    if (largest + mean < best - kProgress) {
      best = largest + mean;
      looks_since_progress = 0;
    } else if (++looks_since_progress >= kPatience) {
      if (strength >= kStrongestPull && !GiveWay(run)) break;
      strength = strength >= kStrongestPull ? 1.0 : 2.0 * strength;
      looks_since_progress = 0;
    }
    SetApproachWind(run, model, pieces, mean, state);
    solver.Advance(state, kCheckInterval, run.MakePullsAndTies(model, PairsToClose(run)),
                   strength * run.options.closing_speed);
    run.report.merging_substeps += kCheckInterval;
    run.substep += kCheckInterval;
    FR_RETURN_IF_ERROR(run.CheckFinite(state));
    run.TakePositions(model, state);
    if (!run.tie_lengths.empty()) AdjustTies(run, /*may_shorten=*/true);
    gaps = GapsToClose(run);
    if (run.report.merging_substeps % (kCheckInterval * 4) == 0) {
      solver.RaiseOffsets(state, run.options.sample_clearance);
      run.Observe(DrapeStage::kMerging, 0.3 * run.report.merging_substeps / run.options.merging_substep_limit);
    }
  }
  DescribeGaps(run);
  return Status();
}

void TakeSeams(DrapeRun& run) {
  run.report.seam_pair_count = static_cast<int>(run.mesh.seams.size());
  DescribeGaps(run);
}

}  // namespace fitroom
