#include "fit_client/fit/solver/drape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/drape_measures.h"

namespace fitroom {
namespace {

// Steps and rates of the stages. Tuned on T-shirts of 2 to 0.5 cm pitch; the comments say what breaks outside.
constexpr double kMergingStep = 5e-4;      // (unit: second). Twice as long: springs stretch by over 10 % while closing.
constexpr double kMergingDrag = 25.0;      // (unit: 1/s). Below 10 panels overshoot; above 60 merging slows down.
constexpr double kApproachSpeed = 1.2;     // Of whole panels towards each other (unit: m/s).
constexpr double kApproachRate = 12.0;     // The speed falls to gap times this as the seams close (unit: 1/s).
constexpr int kMergingCheckInterval = 16;  // Substeps between looks at the seams.
constexpr int kPatience = 8;               // Looks without progress before pulls are doubled,
constexpr double kStrongestPull = 8.0;     // as far as this times the closing speed; then merging is given up.
constexpr double kProgress = 2e-4;         // Less than this in `kPatience` looks is no progress (unit: metre).
constexpr double kFallingStep =
    4e-4;  // While the cloth falls (unit: second). Longer: its weight stretches it by over 5 %.
constexpr double kSettlingStep = 1.6e-4;  // At the end (unit: second): stretch falls with the square of the step.
constexpr double kSettlingSpeed = 0.06;   // Falling ends when 99 % are slower (unit: m/s).
constexpr double kDrapingDrag = 12.0;     // (unit: 1/s). Over-critical for a hem that swings on 0.6 m of cloth.
// What still creeps or trembles after each second of hanging is damped twice as much: the end is the same, sooner.
constexpr double kLargestDrag = 100.0;  // (unit: 1/s)
constexpr int kRestWindows = 3;         // Rest must hold for this many sixtieths of a second.
// Rest that holds for so long ends the run although samples stay closer than the clearance: where cloth is squeezed
// between arm and trunk there is no room for it. Whether any is inside the body is measured and reported.
constexpr int kPatientRestWindows = 12;
// After so many windows of hanging offsets are raised no more: where there is no room they would only shake the cloth.
constexpr int kRaisingWindows = 60;
constexpr int kOffBodyRestWindows = 60;  // The same where a vertex that has to touch the body does not.

// Runs the stages of one call of Drape().
class DrapeRun {
 public:
  DrapeRun(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start, const SignedDistanceField& body,
           const DrapeOptions& options, Executor& executor, const DrapeObserver& observer)
      : mesh_(mesh),
        body_(body),
        options_(options),
        executor_(executor),
        observer_(observer),
        positions_(start.begin(), start.end()) {}

  Result<DrapeResult> Run() {
    Observe(DrapeStage::kStart, 0.0);
    FR_RETURN_IF_ERROR(Merge());
    Observe(DrapeStage::kStitched, 0.3);
    FR_RETURN_IF_ERROR(LetHang());
    Conclude();
    Observe(DrapeStage::kFinished, 1.0);
    return DrapeResult{std::move(positions_), std::move(report_)};
  }

 private:
  Status Merge();
  Status LetHang();
  void Relax(ClothSolver& solver, ClothState& state);
  void LiftOut(const ClothModel& model);
  void Conclude();

  // Says whether the cloth is at rest, from how far particles went in a sixtieth of a second; fills the report.
  bool IsAtRest(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& after, double seconds,
                const ClothState& state);
  bool TouchesBody();
  double MeanEdgeLength() const;
  Status CheckFinite(const ClothState& state) const;
  void TakePositions(const ClothModel& model, const ClothState& state);
  std::vector<Eigen::Vector3d> ParticlePositions(const ClothModel& model) const;
  std::vector<double> SeamGaps() const;
  std::vector<SeamPull> MakePulls(const ClothModel& model, std::span<const SeamPair> pairs) const;
  bool PassesThroughBody(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  void FindPanels();
  void SetApproachWind(const ClothModel& model, double mean_gap, ClothState& state) const;
  void Observe(DrapeStage stage, double progress) {
    if (observer_) observer_({stage, substep_, progress, positions_});
  }

  const ClothMesh& mesh_;
  const SignedDistanceField& body_;
  const DrapeOptions& options_;
  Executor& executor_;
  const DrapeObserver& observer_;
  std::vector<Eigen::Vector3d> positions_;  // One a vertex of the mesh.
  std::vector<int> panel_of_vertex_;
  int panel_count_ = 0;
  std::vector<SeamPair> open_seams_;
  int substep_ = 0;
  DrapeReport report_;
};

void DrapeRun::TakePositions(const ClothModel& model, const ClothState& state) {
  const std::vector<Eigen::Vector3d> particles = ClothSolver::Positions(state, model.particle_count());
  for (size_t vertex = 0; vertex < positions_.size(); ++vertex) {
    positions_[vertex] = particles[static_cast<size_t>(model.particle_of_vertex()[vertex])];
  }
}

// The mean of the vertices that make up a particle: where sewn partners meet.
std::vector<Eigen::Vector3d> DrapeRun::ParticlePositions(const ClothModel& model) const {
  std::vector<Eigen::Vector3d> sums(static_cast<size_t>(model.particle_count()), Eigen::Vector3d::Zero());
  std::vector<int> counts(sums.size(), 0);
  for (size_t vertex = 0; vertex < positions_.size(); ++vertex) {
    const size_t particle = static_cast<size_t>(model.particle_of_vertex()[vertex]);
    sums[particle] += positions_[vertex];
    ++counts[particle];
  }
  for (size_t particle = 0; particle < sums.size(); ++particle) sums[particle] /= counts[particle];
  return sums;
}

std::vector<double> DrapeRun::SeamGaps() const {
  std::vector<double> gaps;
  for (const SeamPair& pair : mesh_.seams) {
    gaps.push_back((positions_[static_cast<size_t>(pair.a)] - positions_[static_cast<size_t>(pair.b)]).norm());
  }
  return gaps;
}

bool DrapeRun::PassesThroughBody(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  for (const double t : {0.25, 0.5, 0.75}) {
    if (body_.Distance(a + (b - a) * t) < -0.002) return true;
  }
  return false;
}

std::vector<SeamPull> DrapeRun::MakePulls(const ClothModel& model, std::span<const SeamPair> pairs) const {
  std::vector<SeamPull> pulls;
  for (const SeamPair& pair : pairs) {
    const Eigen::Vector3d& a = positions_[static_cast<size_t>(pair.a)];
    const Eigen::Vector3d& b = positions_[static_cast<size_t>(pair.b)];
    const int particle_a = model.particle_of_vertex()[static_cast<size_t>(pair.a)];
    const int particle_b = model.particle_of_vertex()[static_cast<size_t>(pair.b)];
    if (particle_a != particle_b) pulls.push_back({particle_a, particle_b, PassesThroughBody(a, b)});
  }
  return pulls;
}

// Whole panels move towards their partners, like someone laying them on the body, so that the outline does not have to
// drag them there. The speed falls with the gap that is left.
void DrapeRun::SetApproachWind(const ClothModel& model, double mean_gap, ClothState& state) const {
  std::vector<Eigen::Vector3d> way(static_cast<size_t>(panel_count_), Eigen::Vector3d::Zero());
  const auto panel_of = [&](int vertex) { return static_cast<size_t>(panel_of_vertex_[static_cast<size_t>(vertex)]); };
  for (const SeamPair& pair : mesh_.seams) {
    const Eigen::Vector3d to_b = positions_[static_cast<size_t>(pair.b)] - positions_[static_cast<size_t>(pair.a)];
    way[panel_of(pair.a)] += to_b;
    way[panel_of(pair.b)] -= to_b;
  }
  const double speed = std::min(kApproachSpeed, kApproachRate * mean_gap);
  state.wind.assign(state.positions.size(), Float4());
  for (size_t vertex = 0; vertex < positions_.size(); ++vertex) {
    const Eigen::Vector3d& direction = way[panel_of(static_cast<int>(vertex))];
    if (direction.norm() < 1e-9) continue;
    const Eigen::Vector3f wind = (direction.normalized() * speed).cast<float>();
    state.wind[static_cast<size_t>(model.particle_of_vertex()[vertex])] = {wind.x(), wind.y(), wind.z(), 0.0F};
  }
}

// Numbers the connected parts of the mesh.
void DrapeRun::FindPanels() {
  std::vector<int> parent(mesh_.rest_positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int vertex) {
    while (parent[static_cast<size_t>(vertex)] != vertex) {
      parent[static_cast<size_t>(vertex)] = parent[static_cast<size_t>(parent[static_cast<size_t>(vertex)])];
      vertex = parent[static_cast<size_t>(vertex)];
    }
    return vertex;
  };
  for (const Eigen::Vector3i& triangle : mesh_.triangles) {
    for (const int other : {triangle[1], triangle[2]}) {
      const int a = root(triangle[0]);
      const int b = root(other);
      parent[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  panel_of_vertex_.resize(parent.size());
  for (size_t vertex = 0; vertex < parent.size(); ++vertex) {
    const int first = root(static_cast<int>(vertex));  // The lowest vertex of the panel, seen before all others.
    panel_of_vertex_[vertex] =
        first == static_cast<int>(vertex) ? panel_count_++ : panel_of_vertex_[static_cast<size_t>(first)];
  }
}

Status DrapeRun::CheckFinite(const ClothState& state) const {
  for (const Float4& position : state.positions) {
    if (!std::isfinite(position.x + position.y + position.z)) {
      return Internal("CLOTH_STATE_NOT_FINITE",
                      "the cloth's state stopped being finite after " + std::to_string(substep_) + " substeps");
    }
  }
  return Status();
}

Status DrapeRun::Merge() {
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(mesh_, options_.material, {}));
  FindPanels();
  ClothSolver solver(model, body_, executor_);
  MotionOptions motion;
  motion.time_step = kMergingStep;
  motion.gravity.setZero();
  motion.drag = kMergingDrag;
  motion.friction_coefficient = options_.stitching_friction_coefficient;
  motion.contact_offset = options_.contact_offset;
  solver.SetMotion(motion);
  ClothState state = solver.MakeState(ParticlePositions(model));

  report_.seam_pair_count = static_cast<int>(mesh_.seams.size());
  double best = 1e9;
  int looks_since_progress = 0;
  double strength = 1.0;
  std::vector<double> gaps = SeamGaps();
  while (!gaps.empty()) {
    const double mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
    const double largest = *std::max_element(gaps.begin(), gaps.end());
    if (largest <= options_.closed_gap || report_.merging_substeps >= options_.merging_substep_limit) break;
    if (largest + mean < best - kProgress) {
      best = largest + mean;
      looks_since_progress = 0;
    } else if (++looks_since_progress >= kPatience) {
      if (strength >= kStrongestPull) break;
      strength *= 2.0;
      looks_since_progress = 0;
    }
    SetApproachWind(model, mean, state);
    solver.Advance(state, kMergingCheckInterval, MakePulls(model, mesh_.seams), strength * options_.closing_speed);
    report_.merging_substeps += kMergingCheckInterval;
    substep_ += kMergingCheckInterval;
    FR_RETURN_IF_ERROR(CheckFinite(state));
    TakePositions(model, state);
    gaps = SeamGaps();
    if (report_.merging_substeps % (kMergingCheckInterval * 4) == 0) {
      solver.RaiseOffsets(state, options_.sample_clearance);
      Observe(DrapeStage::kMerging, 0.3 * report_.merging_substeps / options_.merging_substep_limit);
    }
  }
  for (size_t index = 0; index < gaps.size(); ++index) {
    if (gaps[index] > options_.closed_gap) open_seams_.push_back(mesh_.seams[index]);
  }
  report_.open_seam_count = static_cast<int>(open_seams_.size());
  if (!gaps.empty()) {
    report_.seam_gap_mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
    report_.seam_gap_p95 = Percentile(gaps, 0.95);
    report_.seam_gap_max = Percentile(gaps, 1.0);
  }
  return Status();
}

// At rest, and within what the steps were tuned on (unit: metre).
double DrapeRun::MeanEdgeLength() const {
  double sum = 0.0;
  for (const Eigen::Vector3i& triangle : mesh_.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      sum += (mesh_.rest_positions[static_cast<size_t>(triangle[corner])] -
              mesh_.rest_positions[static_cast<size_t>(triangle[(corner + 1) % 3])])
                 .norm();
    }
  }
  return std::clamp(sum / (3.0 * static_cast<double>(mesh_.triangles.size())), 0.004, 0.025);
}

bool DrapeRun::TouchesBody() {
  report_.touching_distance_max = 0.0;
  for (const int vertex : options_.touching_vertices) {
    report_.touching_distance_max =
        std::max(report_.touching_distance_max, body_.Distance(positions_[static_cast<size_t>(vertex)]));
  }
  report_.touching_condition_met = report_.touching_distance_max <= options_.touching_distance;
  return report_.touching_condition_met;
}

bool DrapeRun::IsAtRest(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& after,
                        double seconds, const ClothState& state) {
  std::vector<double> speeds;
  size_t slow = 0;
  for (size_t particle = 0; particle < after.size(); ++particle) {
    const Float4& v = state.velocities[particle];
    const double momentary = std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z));
    const double mean = (after[particle] - before[particle]).norm() / seconds;
    speeds.push_back(std::max(momentary, mean));
    if (mean < options_.rest_speed) ++slow;
  }
  report_.share_at_rest = static_cast<double>(slow) / static_cast<double>(speeds.size());
  report_.speed_p99 = Percentile(speeds, 0.99);
  report_.speed_max = Percentile(speeds, 1.0);
  return report_.share_at_rest >= options_.rest_share && report_.speed_p99 < options_.rest_speed_of_99_percent;
}

// Lets stretch and creases of the start positions go before friction holds them.
void DrapeRun::Relax(ClothSolver& solver, ClothState& state) {
  MotionOptions motion;
  motion.time_step = kMergingStep;
  motion.gravity.setZero();
  motion.drag = kMergingDrag;
  motion.friction_coefficient = options_.stitching_friction_coefficient;
  motion.contact_offset = options_.contact_offset;
  solver.SetMotion(motion);
  for (int done = 0; done < options_.relaxing_substeps; done += 4 * kMergingCheckInterval) {
    solver.Advance(state, std::min(4 * kMergingCheckInterval, options_.relaxing_substeps - done), {}, 0.0);
    solver.RaiseOffsets(state, options_.sample_clearance);
  }
  report_.relaxing_substeps = options_.relaxing_substeps;
  substep_ += options_.relaxing_substeps;
}

Status DrapeRun::LetHang() {
  std::vector<SeamPair> welds;
  for (const SeamPair& pair : mesh_.seams) {
    const bool is_open = std::any_of(open_seams_.begin(), open_seams_.end(),
                                     [&](const SeamPair& open) { return open.a == pair.a && open.b == pair.b; });
    if (!is_open) welds.push_back(pair);
  }
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(mesh_, options_.material, welds));
  ClothSolver solver(model, body_, executor_);
  ClothState state = solver.MakeState(ParticlePositions(model));
  Relax(solver, state);
  MotionOptions motion;
  const double edge_scale = MeanEdgeLength() / 0.01;
  motion.time_step = kFallingStep * edge_scale;
  motion.gravity = options_.gravity;
  motion.drag = kDrapingDrag;
  motion.friction_coefficient = options_.friction_coefficient;
  motion.contact_offset = options_.contact_offset;
  solver.SetMotion(motion);
  FR_RETURN_IF_ERROR(CheckFinite(state));
  TakePositions(model, state);

  int window_count = 0;
  int windows_at_rest = 0;
  bool is_settling = false;
  std::vector<Eigen::Vector3d> before = ClothSolver::Positions(state, model.particle_count());
  while (report_.draping_substeps < options_.draping_substep_limit) {
    const int window = static_cast<int>(std::max(1L, std::lround(1.0 / (60.0 * motion.time_step))));
    solver.Advance(state, window, MakePulls(model, open_seams_), 0.1 * options_.closing_speed);
    report_.draping_substeps += window;
    report_.simulated_seconds += window * motion.time_step;
    substep_ += window;
    FR_RETURN_IF_ERROR(CheckFinite(state));
    const std::vector<Eigen::Vector3d> after = ClothSolver::Positions(state, model.particle_count());
    TakePositions(model, state);
    const bool at_rest = IsAtRest(before, after, window * motion.time_step, state);
    windows_at_rest = at_rest && is_settling ? windows_at_rest + 1 : 0;
    before = after;
    const int samples_too_close =
        ++window_count <= kRaisingWindows ? solver.RaiseOffsets(state, options_.sample_clearance) : 1;
    const int windows_needed = !TouchesBody()           ? kOffBodyRestWindows
                               : samples_too_close == 0 ? kRestWindows
                                                        : kPatientRestWindows;
    if (windows_at_rest >= windows_needed) break;
    if (window_count % kRaisingWindows == 0 && motion.drag < kLargestDrag) {
      motion.drag *= 2.0;
      solver.SetMotion(motion);
    }
    if (!is_settling && report_.speed_p99 < kSettlingSpeed) {
      is_settling = true;
      motion.time_step = kSettlingStep * edge_scale;
      solver.SetMotion(motion);
    }
    Observe(DrapeStage::kDraping, 0.3 + 0.7 * report_.draping_substeps / options_.draping_substep_limit);
  }
  LiftOut(model);
  TouchesBody();
  report_.outcome = !open_seams_.empty()              ? DrapeOutcome::kSeamsOpen
                    : windows_at_rest >= kRestWindows ? DrapeOutcome::kAtRest
                                                      : DrapeOutcome::kNotAtRest;
  MeasureStrain(model, ParticlePositions(model), mesh_, report_);
  MeasurePenetration(model, ParticlePositions(model), body_, executor_, report_);
  report_.self_crossing_count = CountSelfCrossings(model, ParticlePositions(model), executor_);
  return Status();
}

// Puts the few particles that a crease of the body holds on its surface or just below it a little outside.
void DrapeRun::LiftOut(const ClothModel& model) {
  constexpr double kLeast = 2e-4;  // Signed distance that every particle is to have (unit: metre).
  constexpr int kSteps = 4;
  std::vector<Eigen::Vector3d> places = ParticlePositions(model);
  for (Eigen::Vector3d& place : places) {
    for (int step = 0; step < kSteps; ++step) {
      const SignedDistanceField::Sample sample = body_.Query(place);
      if (sample.distance > 0.5 * body_.pitch()) break;
      const double distance = body_.ExactDistance(place);
      const double length = sample.gradient.norm();
      if (distance >= kLeast || length < 0.1) break;
      place += sample.gradient / length * (2.0 * kLeast - distance);
    }
  }
  for (size_t vertex = 0; vertex < positions_.size(); ++vertex) {
    positions_[vertex] = places[static_cast<size_t>(model.particle_of_vertex()[vertex])];
  }
}

void DrapeRun::Conclude() {
  const std::vector<double> gaps = SeamGaps();
  char text[200] = "";
  if (report_.outcome == DrapeOutcome::kSeamsOpen) {
    size_t worst = 0;
    for (size_t index = 0; index < gaps.size(); ++index) {
      if (gaps[index] > gaps[worst]) worst = index;
    }
    const Eigen::Vector3d& place = positions_[static_cast<size_t>(mesh_.seams[worst].a)];
    std::snprintf(text, sizeof(text),
                  "does not close: a gap of %.1f mm is left at (%.3f, %.3f, %.3f) m; %d of %d pairs open",
                  gaps[worst] * 1e3, place.x(), place.y(), place.z(), report_.open_seam_count, report_.seam_pair_count);
  } else if (report_.outcome == DrapeOutcome::kAtRest) {
    std::snprintf(text, sizeof(text), "at rest: %.1f %% of the particles are slower than %.1f mm/s",
                  report_.share_at_rest * 100.0, options_.rest_speed * 1e3);
  } else {
    std::snprintf(text, sizeof(text), "not at rest after %d substeps: 99 %% are slower than %.1f mm/s",
                  report_.draping_substeps, report_.speed_p99 * 1e3);
  }
  report_.finishing_reason = text;
  report_.final_seam_gap_max = gaps.empty() ? 0.0 : Percentile(gaps, 1.0);
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
  for (const int vertex : options.touching_vertices) {
    if (vertex < 0 || vertex >= vertex_count) {
      return InvalidArgument("VERTEX_OUT_OF_RANGE", "a touching vertex does not exist");
    }
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
    case DrapeStage::kDraping:
      return "draping";
    case DrapeStage::kFinished:
      return "finished";
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
  return DrapeRun(mesh, start_positions, body, options, executor, observer).Run();
}

}  // namespace fitroom
