#include "fit_client/fit/solver/drape_hanging.h"

#include <algorithm>
#include <cmath>

#include "fit_client/fit/solver/drape_hoops.h"
#include "fit_client/fit/solver/drape_lift_out.h"
#include "fit_client/fit/solver/drape_measures.h"
#include "fit_client/fit/solver/drape_opening.h"
#include "fit_client/fit/solver/drape_pulling_up.h"
#include "fit_client/fit/solver/drape_tug.h"
#include "fit_client/fit/solver/self_collision.h"

namespace fitroom {
namespace {

// Steps and rates of the stages. Tuned on T-shirts of 2 to 0.5 cm pitch; the comments say what breaks outside.
constexpr int kRelaxingInterval = 64;  // Substeps between looks at samples while relaxing.
constexpr double kFallingStep =
    4e-4;  // While the cloth falls (unit: second). Longer: its weight stretches it by over 5 %.
constexpr double kSettlingStep = 1.6e-4;  // At the end (unit: second): stretch falls with the square of the step.
constexpr double kSettlingSpeed = 0.06;   // Falling ends when 99 % are slower (unit: m/s).
constexpr double kDrapingDrag = 12.0;     // (unit: 1/s). Over-critical for a hem that swings on 0.6 m of cloth.
// What still creeps or trembles after each second of hanging is damped twice as much: the end is the same, sooner.
constexpr double kLargestDrag = 100.0;  // (unit: 1/s)
// Cloth that a coarser mesh has brought to rest: what is slow has settled there, and what the finer mesh adds is fast.
constexpr double kWornDrag = 50.0;  // At edges of 1 cm (unit: 1/s).
constexpr int kRestWindows = 3;     // Rest must hold for this many sixtieths of a second.
// Rest that holds for so long ends the run although samples stay closer than the clearance: where cloth is squeezed
// between arm and trunk there is no room for it. Whether any is inside the body is measured and reported.
constexpr int kPatientRestWindows = 12;
// After so many windows of hanging offsets are raised no more: where there is no room they would only shake the cloth.
constexpr int kRaisingWindows = 60;
constexpr double kTrembling = 0.04;      // Layers that still push each other like this are to give in (unit: m/s).
constexpr int kDampingWindows = 240;     // After so many nothing is damped more.
constexpr int kOffBodyRestWindows = 60;  // The same where a vertex that has to touch the body does not.
// After so many windows layers no longer push each other: what finds no room would tremble for ever. What crosses then
// is ironed at the end.
constexpr int kContactWindows = 120;
constexpr int kIroningInterval = 8;  // Windows between looks at cloth that passes through itself,
constexpr int kFirmIronings = 3;     // after so many closer to the body, where layers find no room,
// and how often it is ironed: what tangles again is left, so that it does not tremble, until the cloth is at rest.
constexpr int kIroningLimit = 5;
constexpr int kOpeningSubsteps = 256;    // Of 0.5 ms: seams that give way are open before,
constexpr int kOpeningInterval = 16;     // substeps between looks at them,
constexpr double kTieError = 0.003;      // and hoops no longer than the fabric's limit and this (unit: metre).
constexpr int kAdjustingWindows = 30;    // Under gravity their ties are adjusted for so long.
constexpr int kOpenSubstepLimit = 6000;  // Of hanging with open seams, a round.
constexpr int kOpeningRounds = 3;        // A seam may give way once its neighbour has.
// What a tug pushes deeper into the body than this is undone (unit: metre).
constexpr double kDeepestAfterTug = 1e-4;

// The mean edge of the mesh, of one with edges of several lengths not much more than the short ones, within what the
// steps were tuned on (unit: metre).
double WorkingEdgeLength(const ClothMesh& mesh) {
  constexpr double kOverShort = 1.25;  // Meshes of one pitch stay below.
  std::vector<double> lengths;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      lengths.push_back((mesh.rest_positions[static_cast<size_t>(triangle[corner])] -
                         mesh.rest_positions[static_cast<size_t>(triangle[(corner + 1) % 3])])
                            .norm());
    }
  }
  return std::clamp(std::min(MeanEdgeLength(mesh), kOverShort * Percentile(lengths, 0.1)), 0.004, 0.025);
}

// The pairs that were closed by merging and do not give way.
std::vector<SeamPair> ClosedSeams(const DrapeRun& run) {
  std::vector<SeamPair> closed;
  for (size_t index = 0; index < run.mesh.seams.size(); ++index) {
    const SeamPair& pair = run.mesh.seams[index];
    const bool is_open = std::any_of(run.open_seams.begin(), run.open_seams.end(),
                                     [&](const SeamPair& open) { return open.a == pair.a && open.b == pair.b; });
    const bool is_tied = index < run.tie_lengths.size() && run.tie_lengths[index] > 0.0;
    if (!is_open && !is_tied) closed.push_back(pair);
  }
  return closed;
}

// One welded garment on one body.
class HangingGarment {
 public:
  HangingGarment(DrapeRun& run, const ClothModel& model)
      : run_(run),
        model_(model),
        solver_(model, run.body, run.executor),
        self_collision_(model, SelfCollisionOptions(), run.executor),
        state_(solver_.MakeState(run.ParticlePositions(model))) {
    if (run.options.self_collision) solver_.SetSelfCollision(&self_collision_);
  }

  Status Hang() {
    IronTangles();
    if (HasTies()) {
      FR_RETURN_IF_ERROR(Open());
    } else {
      Relax();
    }
    IronTangles();
    FR_RETURN_IF_ERROR(run_.CheckFinite(state_));
    run_.TakePositions(model_, state_);
    if (run_.options.pull_up) FR_RETURN_IF_ERROR(PullUp(*run_.options.pull_up, Cloth()));
    if (run_.options.attach) FR_RETURN_IF_ERROR(CarryToBelt(Cloth()));
    FR_RETURN_IF_ERROR(ComeToRest(/*starts_worn=*/false));
    return End();
  }

  Status Settle() {
    ironing_count_ = kFirmIronings;  // What the coarse mesh could not untangle has no room here either.
    IronTangles();
    if (run_.options.attach) {
      FR_RETURN_IF_ERROR(AskForBelt(run_));
      HoldBelt(Cloth());
    }
    FR_RETURN_IF_ERROR(ComeToRest(/*starts_worn=*/true));
    return End();
  }

  // Comes to rest once more, from where the garment has been pulled to.
  Status HangAgain() {
    IronTangles();
    FR_RETURN_IF_ERROR(ComeToRest(/*starts_worn=*/false));
    return End();
  }

  // Lets the seams of the run's ties open, where the garment is.
  Status HangOpen() {
    if (!run_.belt.empty()) HoldBelt(Cloth());
    FR_RETURN_IF_ERROR(Open());
    IronTangles();
    FR_RETURN_IF_ERROR(ComeToRest(/*starts_worn=*/false));
    return End();
  }

 private:
  Status End() {
    IronAtRest();
    TakePlaces(LiftOut(model_, run_.body, run_.ParticlePositions(model_)));
    Conclude();
    return Status();
  }
  WeldedCloth Cloth() { return {run_, model_, solver_, state_}; }
  void TakePlaces(const std::vector<Eigen::Vector3d>& places) {
    for (size_t vertex = 0; vertex < run_.positions.size(); ++vertex) {
      run_.positions[vertex] = places[static_cast<size_t>(model_.particle_of_vertex()[vertex])];
    }
  }
  void Relax();
  Status Open();
  bool HasTies() const { return !run_.tie_lengths.empty(); }
  bool ChainsHaveTheirLength();
  Status ComeToRest(bool starts_worn);
  void Conclude();
  // Says whether the cloth is at rest, from how far particles went in a sixtieth of a second; fills the report.
  bool IsAtRest(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& after, double seconds);
  bool TouchesBody();
  // Says whether cloth passes through cloth and has been ironed; what tangles again and again is left.
  bool IronTangles() {
    if (!run_.options.self_collision) return false;
    self_collision_.Refresh(state_);
    if (self_collision_.crossing_count() == 0) return false;
    if (ironing_count_ >= kIroningLimit) {
      self_collision_.LeaveTangles();
      return false;
    }
    ++ironing_count_;
    self_collision_.Iron(run_.body, run_.options.contact_offset, /*may_yield=*/ironing_count_ > kFirmIronings, state_);
    return true;
  }
  // The last crossings are ironed without letting the cloth move again.
  void IronAtRest() {
    if (!run_.options.self_collision) return;
    self_collision_.Iron(run_.body, run_.options.contact_offset, /*may_yield=*/false, state_);
    run_.TakePositions(model_, state_);
  }

  DrapeRun& run_;
  const ClothModel& model_;
  ClothSolver solver_;
  SelfCollision self_collision_;
  ClothState state_;
  int windows_at_rest_ = 0;
  int ironing_count_ = 0;
};

// Lets stretch and creases of the start positions go before friction holds them.
void HangingGarment::Relax() {
  solver_.SetMotion(QuasiStaticMotion(run_.options));
  const int limit = run_.options.relaxing_substeps;
  for (int done = 0; done < limit; done += kRelaxingInterval) {
    solver_.Advance(state_, std::min(kRelaxingInterval, limit - done), {}, 0.0);
    solver_.RaiseOffsets(state_, run_.options.sample_clearance);
  }
  run_.report.relaxing_substeps = limit;
  run_.substep += limit;
}

// Lets open seams go apart as far as their ties allow: without gravity and nearly without friction, so that the whole
// hoop gives and not the cloth beside the seam alone, and not for longer, because cloth that is too narrow climbs.
Status HangingGarment::Open() {
  solver_.SetMotion(QuasiStaticMotion(run_.options));
  for (int done = 0; done < kOpeningSubsteps; done += kOpeningInterval) {
    solver_.Advance(state_, kOpeningInterval, run_.MakePullsAndTies(model_, run_.open_seams),
                    0.1 * run_.options.closing_speed);
    run_.report.relaxing_substeps += kOpeningInterval;
    run_.substep += kOpeningInterval;
    FR_RETURN_IF_ERROR(run_.CheckFinite(state_));
    run_.TakePositions(model_, state_);
    if (HasOpened(run_)) break;
  }
  solver_.RaiseOffsets(state_, run_.options.sample_clearance);
  return Status();
}

bool HangingGarment::ChainsHaveTheirLength() {
  double difference = 0.0;
  double rest = 0.0;
  for (const VertexChain& chain : run_.options.measured_chains) {
    double length_now = 0.0;
    double length_at_rest = 0.0;
    for (size_t i = 1; i < chain.size(); ++i) {
      const size_t from = static_cast<size_t>(chain[i - 1]);
      const size_t to = static_cast<size_t>(chain[i]);
      length_now += (run_.positions[to] - run_.positions[from]).norm();
      length_at_rest += (run_.mesh.rest_positions[to] - run_.mesh.rest_positions[from]).norm();
    }
    difference += std::abs(length_now - length_at_rest);
    rest += length_at_rest;
  }
  run_.report.length_residual = rest > 0.0 ? difference / rest : 0.0;
  run_.report.length_condition_met = run_.report.length_residual < run_.options.length_tolerance;
  return run_.report.length_condition_met;
}

bool HangingGarment::TouchesBody() {
  DrapeReport& report = run_.report;
  report.touching_distance_max = 0.0;
  for (const int vertex : run_.options.touching_vertices) {
    report.touching_distance_max =
        std::max(report.touching_distance_max, run_.body.Distance(run_.positions[static_cast<size_t>(vertex)]));
  }
  report.touching_condition_met = report.touching_distance_max <= run_.options.touching_distance;
  return report.touching_condition_met;
}

bool HangingGarment::IsAtRest(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& after,
                              double seconds) {
  std::vector<double> speeds;
  size_t slow = 0;
  for (size_t particle = 0; particle < after.size(); ++particle) {
    const Float4& v = state_.velocities[particle];
    const double momentary = std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z));
    const double mean = (after[particle] - before[particle]).norm() / seconds;
    speeds.push_back(std::max(momentary, mean));
    if (mean < run_.options.rest_speed) ++slow;
  }
  DrapeReport& report = run_.report;
  report.share_at_rest = static_cast<double>(slow) / static_cast<double>(speeds.size());
  report.speed_p99 = Percentile(speeds, 0.99);
  report.speed_max = Percentile(speeds, 1.0);
  return report.share_at_rest >= run_.options.rest_share && report.speed_p99 < run_.options.rest_speed_of_99_percent;
}

Status HangingGarment::ComeToRest(bool starts_worn) {
  const DrapeOptions& options = run_.options;
  DrapeReport& report = run_.report;
  MotionOptions motion;
  const double edge_scale = WorkingEdgeLength(run_.mesh) / 0.01;
  bool is_settling = starts_worn;
  motion.time_step = (is_settling ? kSettlingStep : kFallingStep) * edge_scale;
  motion.gravity = options.gravity;
  motion.drag = starts_worn ? std::min(kWornDrag / edge_scale, kLargestDrag) : kDrapingDrag;
  motion.friction_coefficient = options.friction_coefficient;
  motion.contact_offset = options.contact_offset;
  solver_.SetMotion(motion);

  int window_count = 0;
  // An open garment that trembles is shown all the same, and says that it is not at rest.
  const int substep_limit =
      report.draping_substeps +
      (HasTies() ? std::min(kOpenSubstepLimit, options.draping_substep_limit) : options.draping_substep_limit);
  int samples_too_close = 1;
  std::vector<Eigen::Vector3d> before = ClothSolver::Positions(state_, model_.particle_count());
  while (report.draping_substeps < substep_limit) {
    const int window = static_cast<int>(std::max(1L, std::lround(1.0 / (60.0 * motion.time_step))));
    solver_.Advance(state_, window, run_.MakePullsAndTies(model_, run_.open_seams), 0.1 * options.closing_speed);
    report.draping_substeps += window;
    report.simulated_seconds += window * motion.time_step;
    run_.substep += window;
    FR_RETURN_IF_ERROR(run_.CheckFinite(state_));
    const std::vector<Eigen::Vector3d> after = ClothSolver::Positions(state_, model_.particle_count());
    run_.TakePositions(model_, state_);
    const bool is_opening =
        HasTies() && window_count < kAdjustingWindows && AdjustTies(run_, /*may_shorten=*/false) > kTieError;
    const bool at_rest = IsAtRest(before, after, window * motion.time_step);
    windows_at_rest_ = at_rest && is_settling && !is_opening ? windows_at_rest_ + 1 : 0;
    before = after;
    if (++window_count <= kRaisingWindows) {
      samples_too_close = solver_.RaiseOffsets(state_, options.sample_clearance);
    }
    const bool may_slide = !TouchesBody() && !starts_worn;
    const int windows_needed = may_slide                ? kOffBodyRestWindows
                               : samples_too_close == 0 ? kRestWindows
                                                        : kPatientRestWindows;
    const bool may_end = windows_at_rest_ >= windows_needed;
    const bool may_iron = window_count <= kRaisingWindows && (may_end || window_count % kIroningInterval == 0);
    const bool was_tangled = may_iron && IronTangles();
    if (may_end && !was_tangled) break;
    if (was_tangled) windows_at_rest_ = 0;
    if (window_count % kRaisingWindows == 0 && window_count <= kDampingWindows) {
      motion.drag *= 2.0;
      solver_.SetMotion(motion);
      if (report.speed_p99 > kTrembling) self_collision_.GiveIn();
      if (window_count >= kContactWindows) solver_.SetSelfCollision(nullptr);
    }
    if (!is_settling && report.speed_p99 < kSettlingSpeed) {
      is_settling = true;
      motion.time_step = kSettlingStep * edge_scale;
      solver_.SetMotion(motion);
      // What was raised on the way over ridges would hold cloth off the body where it came to lie.
      if (window_count + kPatientRestWindows < kRaisingWindows) {
        std::fill(state_.extra_offset.begin(), state_.extra_offset.end(), 0.0F);
      }
    }
    run_.Observe(DrapeStage::kDraping, 0.3 + 0.7 * report.draping_substeps / options.draping_substep_limit);
  }
  return Status();
}

void HangingGarment::Conclude() {
  DrapeReport& report = run_.report;
  TouchesBody();
  ChainsHaveTheirLength();
  report.is_open_at_rest = (HasTies() || !run_.open_seams.empty()) && windows_at_rest_ >= kRestWindows;
  report.outcome = HasTies() || !run_.open_seams.empty() ? DrapeOutcome::kSeamsOpen
                   : windows_at_rest_ >= kRestWindows    ? DrapeOutcome::kAtRest
                                                         : DrapeOutcome::kNotAtRest;
  const std::vector<Eigen::Vector3d> particles = run_.ParticlePositions(model_);
  MeasureStrain(model_, particles, run_.mesh, report);
  MeasurePenetration(model_, particles, run_.body, run_.executor, report);
  report.self_crossing_count = CountSelfCrossings(model_, particles, run_.executor);
}

// Says whether a seam would give way.
bool LacksGirth(const DrapeRun& run) {
  const std::vector<double> ties = FindOpenings(run);
  return std::any_of(ties.begin(), ties.end(), [](double length) { return length > 0.0; });
}

// Ties seams from now on; what is tied is drawn together no more.
void TieSeams(DrapeRun& run, std::vector<double> tie_lengths) {
  if (std::none_of(tie_lengths.begin(), tie_lengths.end(), [](double length) { return length > 0.0; })) return;
  run.tie_lengths = std::move(tie_lengths);
  std::erase_if(run.open_seams, [&](const SeamPair& open) {
    for (size_t index = 0; index < run.tie_lengths.size(); ++index) {
      const SeamPair& pair = run.mesh.seams[index];
      if (run.tie_lengths[index] > 0.0 && pair.a == open.a && pair.b == open.b) return true;
    }
    return false;
  });
}

// Pulls the garment up and hangs it again; where it does not close there either, or does not lie as well, it stays as
// it was, to the last bit.
Status TugAndHang(DrapeRun& run) {
  const std::vector<Eigen::Vector3d> hung_positions = run.positions;
  const DrapeReport hung_report = run.report;
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(run.mesh, run.options.material, ClosedSeams(run)));
  FR_RETURN_IF_ERROR(TugUp(run, model));
  FR_RETURN_IF_ERROR(HangingGarment(run, model).HangAgain());
  const DrapeReport& report = run.report;
  if (report.outcome == DrapeOutcome::kAtRest && report.touching_condition_met && !LacksGirth(run) &&
      report.deepest_penetration <= std::max(hung_report.deepest_penetration, kDeepestAfterTug) &&
      report.self_crossing_count <= hung_report.self_crossing_count) {
    return Status();
  }
  run.positions = hung_positions;
  run.report = hung_report;
  return Status();
}

// Hangs the garment again with the seams open that its girth cannot close, until no more give way. What turns out to
// close all the same, because the cloth finds another place, stays as it was when sewn.
Status OpenSeams(DrapeRun& run) {
  if (!(run.options.limit_strain > 0.0)) return Status();
  if (run.hoops.empty()) run.hoops = FindHoops(run.mesh);
  const bool was_sewn = run.tie_lengths.empty();
  const std::vector<SeamPair> sewn_open = run.open_seams;
  const auto tie_count = [](const std::vector<double>& lengths) {
    return std::count_if(lengths.begin(), lengths.end(), [](double length) { return length > 0.0; });
  };
  if (was_sewn && run.options.tug && LacksGirth(run)) FR_RETURN_IF_ERROR(TugAndHang(run));
  const std::vector<Eigen::Vector3d> sewn_positions = run.positions;
  const DrapeReport sewn_report = run.report;
  for (int round = 0; round < kOpeningRounds; ++round) {
    std::vector<double> ties = FindOpenings(run);
    if (tie_count(ties) == tie_count(run.tie_lengths)) break;
    TieSeams(run, std::move(ties));
    FR_ASSIGN_OR_RETURN(const ClothModel opened, ClothModel::Create(run.mesh, run.options.material, ClosedSeams(run)));
    FR_RETURN_IF_ERROR(HangingGarment(run, opened).HangOpen());
  }
  run.report.openings = MeasureOpenings(run);
  if (!run.tie_lengths.empty() && run.report.openings.empty() && was_sewn) {
    run.positions = sewn_positions;
    run.report = sewn_report;
    run.open_seams = sewn_open;
    run.tie_lengths.clear();
  }
  return Status();
}

}  // namespace

Status HangGarment(DrapeRun& run) {
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(run.mesh, run.options.material, ClosedSeams(run)));
  FR_RETURN_IF_ERROR(HangingGarment(run, model).Hang());
  return OpenSeams(run);
}

Status SettleGarment(DrapeRun& run) {
  if (!run.open_seams.empty() && run.options.limit_strain > 0.0) {
    run.hoops = FindHoops(run.mesh);
    TieSeams(run, FindOpenings(run));
  }
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(run.mesh, run.options.material, ClosedSeams(run)));
  FR_RETURN_IF_ERROR(HangingGarment(run, model).Settle());
  return OpenSeams(run);
}

}  // namespace fitroom
