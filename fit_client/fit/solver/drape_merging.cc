#include "fit_client/fit/solver/drape_merging.h"

#include <algorithm>
#include <numeric>

#include "fit_client/fit/solver/drape_measures.h"

namespace fitroom {
namespace {

// Rates of merging. Tuned on T-shirts of 2 to 0.5 cm pitch.
constexpr double kApproachSpeed = 1.2;  // Of whole panels towards each other (unit: m/s).
constexpr double kApproachRate = 12.0;  // The speed falls to gap times this as the seams close (unit: 1/s).
constexpr int kCheckInterval = 16;      // Substeps between looks at the seams.
constexpr int kPatience = 8;            // Looks without progress before pulls are doubled,
constexpr double kStrongestPull = 8.0;  // as far as this times the closing speed; then merging is given up.
constexpr double kProgress = 2e-4;      // Less than this in `kPatience` looks is no progress (unit: metre).

// The connected parts of a mesh, numbered by their lowest vertex.
struct Panels {
  std::vector<int> panel_of_vertex;
  int count = 0;
};

Panels FindPanels(const ClothMesh& mesh) {
  std::vector<int> parent(mesh.rest_positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int vertex) {
    while (parent[static_cast<size_t>(vertex)] != vertex) {
      parent[static_cast<size_t>(vertex)] = parent[static_cast<size_t>(parent[static_cast<size_t>(vertex)])];
      vertex = parent[static_cast<size_t>(vertex)];
    }
    return vertex;
  };
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (const int other : {triangle[1], triangle[2]}) {
      const int a = root(triangle[0]);
      const int b = root(other);
      parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  Panels panels;
  panels.panel_of_vertex.resize(parent.size());
  for (size_t vertex = 0; vertex < parent.size(); ++vertex) {
    const int first = root(static_cast<int>(vertex));  // The lowest vertex of the panel, seen before all others.
    panels.panel_of_vertex[vertex] =
        first == static_cast<int>(vertex) ? panels.count++ : panels.panel_of_vertex[static_cast<size_t>(first)];
  }
  return panels;
}

// Whole panels move towards their partners, like someone laying them on the body, so that the outline does not have to
// drag them there. The speed falls with the gap that is left.
void SetApproachWind(const DrapeRun& run, const ClothModel& model, const Panels& panels, double mean_gap,
                     ClothState& state) {
  std::vector<Eigen::Vector3d> way(static_cast<size_t>(panels.count), Eigen::Vector3d::Zero());
  const auto panel_of = [&](int vertex) {
    return static_cast<size_t>(panels.panel_of_vertex[static_cast<size_t>(vertex)]);
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

void DescribeGaps(const std::vector<double>& gaps, DrapeRun& run) {
  for (size_t index = 0; index < gaps.size(); ++index) {
    if (gaps[index] > run.options.closed_gap) run.open_seams.push_back(run.mesh.seams[index]);
  }
  run.report.open_seam_count = static_cast<int>(run.open_seams.size());
  if (gaps.empty()) return;
  run.report.seam_gap_mean = Mean(gaps);
  run.report.seam_gap_p95 = Percentile(gaps, 0.95);
  run.report.seam_gap_max = Percentile(gaps, 1.0);
}

}  // namespace

Status MergeSeams(DrapeRun& run) {
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(run.mesh, run.options.material, {}));
  const Panels panels = FindPanels(run.mesh);
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
      if (strength >= kStrongestPull) break;
      strength *= 2.0;
      looks_since_progress = 0;
    }
    SetApproachWind(run, model, panels, mean, state);
    solver.Advance(state, kCheckInterval, run.MakePulls(model, run.mesh.seams), strength * run.options.closing_speed);
    run.report.merging_substeps += kCheckInterval;
    run.substep += kCheckInterval;
    FR_RETURN_IF_ERROR(run.CheckFinite(state));
    run.TakePositions(model, state);
    gaps = run.SeamGaps();
    if (run.report.merging_substeps % (kCheckInterval * 4) == 0) {
      solver.RaiseOffsets(state, run.options.sample_clearance);
      run.Observe(DrapeStage::kMerging, 0.3 * run.report.merging_substeps / run.options.merging_substep_limit);
    }
  }
  DescribeGaps(gaps, run);
  return Status();
}

void TakeSeams(DrapeRun& run) {
  run.report.seam_pair_count = static_cast<int>(run.mesh.seams.size());
  DescribeGaps(run.SeamGaps(), run);
}

}  // namespace fitroom
