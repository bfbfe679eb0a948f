#include "fit_client/fit/solver/drape_tug.h"

#include <algorithm>

#include "fit_client/fit/solver/drape_opening.h"
#include "fit_client/fit/solver/self_collision.h"

namespace fitroom {
namespace {

constexpr int kInterval = 16;       // Substeps between looks.
constexpr int kPatience = 12;       // So many looks without
constexpr double kProgress = 2e-4;  // this much of a rise, and the garment is stuck (unit: metre).
constexpr double kReserve = 0.015;  // Girth that is to be left to the fabric's limit: gravity takes some of it back
                                    // (unit: metre).

double MeanHeight(const DrapeRun& run, const std::vector<int>& vertices) {
  double sum = 0.0;
  for (const int vertex : vertices) sum += run.positions[static_cast<size_t>(vertex)].y();
  return vertices.empty() ? 0.0 : sum / static_cast<double>(vertices.size());
}

}  // namespace

Status TugUp(DrapeRun& run, const ClothModel& model) {
  const TugOptions& tug = *run.options.tug;
  ClothSolver solver(model, run.body, run.executor);
  solver.SetMotion(QuasiStaticMotion(run.options));
  SelfCollision self_collision(model, SelfCollisionOptions(), run.executor);
  ClothState state = solver.MakeState(run.ParticlePositions(model));
  if (run.options.self_collision) {
    self_collision.Refresh(state);
    solver.SetSelfCollision(&self_collision);
  }
  const double start = MeanHeight(run, tug.waist_vertices);
  const double end = std::min(tug.highest, start + tug.longest_way);
  double highest = start;
  int looks_without_progress = 0;
  while (run.report.tugging_substeps < tug.substep_limit && looks_without_progress < kPatience) {
    if (MeanHeight(run, tug.waist_vertices) >= end || LargestLack(run) < -kReserve) break;
    solver.Advance(state, kInterval, {}, 0.0);
    run.report.tugging_substeps += kInterval;
    run.substep += kInterval;
    FR_RETURN_IF_ERROR(run.CheckFinite(state));
    run.TakePositions(model, state);
    if (run.report.tugging_substeps % (4 * kInterval) == 0) solver.RaiseOffsets(state, run.options.sample_clearance);
    const double height = MeanHeight(run, tug.waist_vertices);
    looks_without_progress = height > highest + kProgress ? 0 : looks_without_progress + 1;
    highest = std::max(highest, height);
  }
  run.report.tugged_way = MeanHeight(run, tug.waist_vertices) - start;
  return Status();
}

}  // namespace fitroom
