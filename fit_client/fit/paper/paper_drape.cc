#include "fit_client/fit/paper/paper_drape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/drape_measures.h"

namespace fitroom::paper {
namespace {

constexpr double kWindow = 1.0 / 60.0;     // Between looks at conditions and rest (unit: second).
constexpr double kLargestPlace = 100.0;    // Of start positions, from the origin (unit: metre).
constexpr double kProgress = 2e-4;         // A gap that shrank by less made no progress (unit: metre).
constexpr double kMeasuringPitch = 0.004;  // Of the distance field that penetration is measured with (unit: metre).

constexpr double kAirDrag = 12.0;  // That of the standard while cloth hangs (unit: 1/s).

// The largest of values that may be none.
double LargestOf(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// Runs the stages of one call of PaperDrape().
class PaperRun {
 public:
  PaperRun(const ClothMesh& mesh, const TriangleMesh& body, const PaperOptions& options, PaperMotion motion,
           const PaperObserver& observer)
      : mesh_(mesh), body_(body), options_(options), motion_(std::move(motion)), observer_(observer) {}

  Status Merge();
  Status PullUp();
  Status SetBelt();
  Status LetHang();
  Result<PaperResult> Conclude(Executor& executor, double highest_frequency);
  bool is_closed() const { return open_seams_.empty(); }
  void Observe(PaperStage stage) {
    if (observer_) observer_({stage, step_, VertexPositions(motion_.cloth())});
  }

 private:
  Status Advance(PaperStage stage, int step_count);
  int WindowSteps() const { return std::max(1, static_cast<int>(std::lround(kWindow / motion_.time_step()))); }
  Eigen::Vector3d PlaceOf(int vertex) const;
  std::vector<Eigen::Vector3d> PlacesOf(const std::vector<int>& vertices) const;
  double RestLength(const std::vector<int>& chain) const;
  std::vector<double> SeamGaps() const;
  std::vector<SeamPair> ClosedSeams() const;
  void SewWhatMet(std::vector<SeamPair>& open, const std::vector<Eigen::Vector3d>& before);
  bool ConditionHolds();
  bool CrotchArrived();
  std::string FinishingReason(const std::vector<double>& gaps) const;

  const ClothMesh& mesh_;
  const TriangleMesh& body_;
  const PaperOptions& options_;
  PaperMotion motion_;
  const PaperObserver& observer_;
  std::vector<SeamPair> open_seams_;
  bool is_at_rest_ = false;
  int step_ = 0;
  DrapeReport report_;
  PaperReport paper_;
};

Eigen::Vector3d PaperRun::PlaceOf(int vertex) const {
  const PaperCloth& cloth = motion_.cloth();
  return cloth.positions[static_cast<size_t>(cloth.particle_of_vertex[static_cast<size_t>(vertex)])];
}

std::vector<Eigen::Vector3d> PaperRun::PlacesOf(const std::vector<int>& vertices) const {
  std::vector<Eigen::Vector3d> places;
  for (const int vertex : vertices) places.push_back(PlaceOf(vertex));
  return places;
}

double PaperRun::RestLength(const std::vector<int>& chain) const {
  double length = 0.0;
  for (size_t i = 1; i < chain.size(); ++i) {
    const size_t from = static_cast<size_t>(chain[i - 1]);
    const size_t to = static_cast<size_t>(chain[i]);
    const std::vector<int>& particle = motion_.cloth().particle_of_vertex;
    if (particle[from] == particle[to]) continue;  // Sewn: the way leads on over the other panel.
    length += (mesh_.rest_positions[to] - mesh_.rest_positions[from]).norm();
  }
  return length;
}

std::vector<double> PaperRun::SeamGaps() const {
  std::vector<double> gaps;
  for (const SeamPair& pair : mesh_.seams) gaps.push_back((PlaceOf(pair.a) - PlaceOf(pair.b)).norm());
  return gaps;
}

std::vector<SeamPair> PaperRun::ClosedSeams() const {
  std::vector<SeamPair> closed;
  const std::vector<int>& particle = motion_.cloth().particle_of_vertex;
  for (const SeamPair& pair : mesh_.seams) {
    if (particle[static_cast<size_t>(pair.a)] == particle[static_cast<size_t>(pair.b)]) closed.push_back(pair);
  }
  return closed;
}

Status PaperRun::Advance(PaperStage stage, int step_count) {
  for (int step = 0; step < step_count; ++step) motion_.Step(stage);
  step_ += step_count;
  for (const Eigen::Vector3d& place : motion_.cloth().positions) {
    if (!place.allFinite()) {
      return Internal("CLOTH_STATE_NOT_FINITE",
                      "the cloth's state stopped being finite after " + std::to_string(step_) + " steps");
    }
  }
  return Status();
}

void PaperRun::SewWhatMet(std::vector<SeamPair>& open, const std::vector<Eigen::Vector3d>& before) {
  std::erase_if(open, [&](const SeamPair& pair) {
    const PaperCloth& cloth = motion_.cloth();
    const size_t a = static_cast<size_t>(cloth.particle_of_vertex[static_cast<size_t>(pair.a)]);
    const size_t b = static_cast<size_t>(cloth.particle_of_vertex[static_cast<size_t>(pair.b)]);
    const bool met = a == b || Met(before[a] - before[b], cloth.positions[a] - cloth.positions[b],
                                   options_.motion.stitching.closed_gap);
    if (met) Weld(motion_.cloth(), pair.a, pair.b);
    return met;
  });
}

Status PaperRun::Merge() {
  report_.seam_pair_count = static_cast<int>(mesh_.seams.size());
  if (options_.motion.stitching.law == StitchingLaw::kPrinted) {
    FR_ASSIGN_OR_RETURN(std::vector<SeamPair> partners, FindPartners(mesh_));
    motion_.SetStitches(std::move(partners));
  } else {
    motion_.SetStitches(mesh_.seams);
  }
  std::vector<SeamPair> open = mesh_.seams;
  double best = std::numeric_limits<double>::infinity();
  int last_progress = 0;
  std::vector<double> gaps_before_sewing(mesh_.seams.size(), 0.0);
  const int patience = static_cast<int>(std::lround(options_.patience / motion_.time_step()));
  while (!open.empty() && report_.merging_substeps < options_.merging_step_limit &&
         report_.merging_substeps - last_progress < patience) {
    const std::vector<Eigen::Vector3d> before = motion_.cloth().positions;
    FR_RETURN_IF_ERROR(Advance(PaperStage::kMerging, 1));
    const size_t open_before = open.size();
    SewWhatMet(open, before);
    ++report_.merging_substeps;
    const double largest = LargestOf(SeamGaps());
    if (open.size() < open_before || largest < best - kProgress) {
      best = std::min(best, largest);
      last_progress = report_.merging_substeps;
    }
    if (report_.merging_substeps % WindowSteps() == 0) Observe(PaperStage::kMerging);
  }
  const std::vector<double> gaps = SeamGaps();
  report_.open_seam_count = static_cast<int>(open.size());
  if (!gaps.empty()) {
    report_.seam_gap_mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
    report_.seam_gap_p95 = Percentile(gaps, 0.95);
    report_.seam_gap_max = Percentile(gaps, 1.0);
  }
  open_seams_ = std::move(open);
  motion_.SetStitches({});
  return Status();
}

bool PaperRun::CrotchArrived() {
  const PaperBottom& bottom = *options_.bottom;
  paper_.crotch_distance = std::numeric_limits<double>::infinity();
  bool touches = false;
  for (const int vertex : bottom.crotch) {
    const Eigen::Vector3d place = PlaceOf(vertex);
    paper_.crotch_distance = std::min(paper_.crotch_distance, (place - bottom.groin).norm());
    const int particle = motion_.cloth().particle_of_vertex[static_cast<size_t>(vertex)];
    touches = touches || motion_.IsColliding(static_cast<size_t>(particle)) ||
              CrotchReached(place, bottom.groin, options_.crotch_epsilon);
  }
  return touches;
}

Status PaperRun::PullUp() {
  while (paper_.pulling_up_steps < options_.pulling_up_step_limit && !paper_.crotch_arrived) {
    FR_RETURN_IF_ERROR(Advance(PaperStage::kPullingUp, 1));
    ++paper_.pulling_up_steps;
    paper_.crotch_arrived = CrotchArrived();
    if (paper_.pulling_up_steps % WindowSteps() == 0) Observe(PaperStage::kPullingUp);
  }
  return Status();
}

Status PaperRun::SetBelt() {
  const std::vector<int>& edge = options_.bottom->top_edge;
  PaperCloth& cloth = motion_.cloth();
  double height = 0.0;
  std::vector<double> distances = {0.0};
  for (size_t i = 0; i < edge.size(); ++i) {
    height += PlaceOf(edge[i])[options_.motion.frame.up] / static_cast<double>(edge.size());
    const int next = edge[(i + 1) % edge.size()];
    distances.push_back(distances.back() + RestLength({edge[i], next}));
  }
  const double rest_length = distances.back();
  distances.pop_back();
  FR_ASSIGN_OR_RETURN(const Belt belt, LayBelt(body_, height, options_.motion.frame));
  paper_.belt_height = height;
  paper_.belt_body_girth = belt.length;
  paper_.belt_garment_girth = rest_length;
  const std::vector<Eigen::Vector3d> places = PlaceOnBelt(belt, distances, rest_length);
  for (size_t i = 0; i < edge.size(); ++i) {
    const size_t particle = static_cast<size_t>(cloth.particle_of_vertex[static_cast<size_t>(edge[i])]);
    cloth.positions[particle] = places[i];
    cloth.velocities[particle].setZero();
    cloth.pinned[particle] = 1;
  }
  return Status();
}

bool PaperRun::ConditionHolds() {
  if (options_.bottom.has_value()) {
    std::array<double, 2> rest_lengths = {};
    std::array<double, 2> lengths = {};
    for (size_t side = 0; side < 2; ++side) {
      rest_lengths[side] = RestLength(options_.bottom->outseams[side]);
      lengths[side] = ChainLength(PlacesOf(options_.bottom->outseams[side]));
    }
    paper_.condition_value = std::abs(rest_lengths[0] - lengths[0]) + std::abs(rest_lengths[1] - lengths[1]);
    const double epsilon = options_.outseam_epsilon * 0.5 * (rest_lengths[0] + rest_lengths[1]);
    return BottomIsDone(rest_lengths, lengths, epsilon);
  }
  std::vector<double> distances;
  for (const int vertex : options_.shoulder_vertices) {
    distances.push_back(FindFootOfNormal(body_, PlaceOf(vertex)).signed_distance);
  }
  paper_.condition_value = LargestOf(distances);
  return TopIsDone(distances, options_.shoulder_epsilon);
}

Status PaperRun::LetHang() {
  const int window = WindowSteps();
  int windows_at_rest = 0;
  std::vector<Eigen::Vector3d> before = AlivePositions(motion_.cloth());
  while (report_.draping_substeps < options_.draping_step_limit) {
    FR_RETURN_IF_ERROR(Advance(PaperStage::kDraping, window));
    report_.draping_substeps += window;
    report_.simulated_seconds = report_.draping_substeps * motion_.time_step();
    const std::vector<Eigen::Vector3d> after = AlivePositions(motion_.cloth());
    const std::vector<double> speeds = MeanSpeeds(before, after, window * motion_.time_step());
    before = after;
    report_.share_at_rest = ShareAtRest(speeds, options_.rest.speed);
    report_.speed_p99 = Percentile(speeds, 0.99);
    report_.speed_max = LargestOf(speeds);
    Observe(PaperStage::kDraping);
    if (!paper_.condition_met && ConditionHolds()) {
      paper_.condition_met = true;
      paper_.condition_time = report_.simulated_seconds;
      if (!options_.waits_for_rest) break;
    }
    windows_at_rest = report_.share_at_rest >= options_.rest.share ? windows_at_rest + 1 : 0;
    is_at_rest_ = windows_at_rest >= options_.rest.windows;
    if (is_at_rest_ && paper_.condition_met) break;
  }
  return Status();
}

std::string PaperRun::FinishingReason(const std::vector<double>& gaps) const {
  const char* condition = options_.bottom.has_value() ? "(11)" : "(6)";
  char text[240] = "";
  if (report_.outcome == DrapeOutcome::kSeamsOpen) {
    const size_t worst = static_cast<size_t>(std::max_element(gaps.begin(), gaps.end()) - gaps.begin());
    const Eigen::Vector3d place = PlaceOf(mesh_.seams[worst].a);
    std::snprintf(text, sizeof(text),
                  "does not close: a gap of %.1f mm is left at (%.3f, %.3f, %.3f) m; %d of %d pairs open",
                  gaps[worst] * 1e3, place.x(), place.y(), place.z(), report_.open_seam_count, report_.seam_pair_count);
  } else if (paper_.condition_met && !options_.waits_for_rest) {
    std::snprintf(text, sizeof(text), "condition %s met after %.2f s of gravity; stopped at once", condition,
                  paper_.condition_time);
  } else {
    std::snprintf(text, sizeof(text), "%s after %d steps: %.1f %% of the particles are slower than %.1f mm/s; %s %s",
                  is_at_rest_ ? "at rest" : "not at rest", report_.draping_substeps, report_.share_at_rest * 100.0,
                  options_.rest.speed * 1e3, condition, paper_.condition_met ? "was met" : "was never met");
  }
  return text;
}

Result<PaperResult> PaperRun::Conclude(Executor& executor, double highest_frequency) {
  const bool condition_now = ConditionHolds();
  const std::vector<double> gaps = SeamGaps();
  report_.final_seam_gap_max = LargestOf(gaps);
  report_.touching_condition_met = options_.bottom.has_value() || condition_now;
  report_.touching_distance_max = options_.bottom.has_value() ? 0.0 : paper_.condition_value;
  const bool is_done = options_.waits_for_rest ? is_at_rest_ : paper_.condition_met;
  report_.outcome = !open_seams_.empty() ? DrapeOutcome::kSeamsOpen
                    : is_done            ? DrapeOutcome::kAtRest
                                         : DrapeOutcome::kNotAtRest;
  report_.finishing_reason = FinishingReason(gaps);
  const std::vector<Eigen::Vector3d> places = VertexPositions(motion_.cloth());
  FR_ASSIGN_OR_RETURN(const ClothModel model, ClothModel::Create(mesh_, options_.material, ClosedSeams()));
  std::vector<Eigen::Vector3d> particles(static_cast<size_t>(model.particle_count()));
  for (size_t vertex = 0; vertex < places.size(); ++vertex) {
    particles[static_cast<size_t>(model.particle_of_vertex()[vertex])] = places[vertex];
  }
  SignedDistanceFieldOptions field_options;
  field_options.pitch = kMeasuringPitch;
  FR_ASSIGN_OR_RETURN(const SignedDistanceField field, SignedDistanceField::Build(body_, field_options, executor));
  MeasureStrain(model, particles, mesh_, report_);
  MeasurePenetration(model, particles, field, executor, report_);
  report_.self_crossing_count = CountSelfCrossings(model, particles, executor);
  paper_.time_step = motion_.time_step();
  paper_.highest_frequency = highest_frequency;
  paper_.audit = motion_.audit();
  return PaperResult{places, report_, paper_};
}

Status CheckVertices(const std::vector<int>& vertices, size_t vertex_count, const char* what) {
  for (const int vertex : vertices) {
    if (vertex < 0 || static_cast<size_t>(vertex) >= vertex_count) {
      return InvalidArgument("VERTEX_OUT_OF_RANGE", std::string(what) + " names a vertex that does not exist");
    }
  }
  return Status();
}

Status CheckInput(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start, const PaperOptions& options) {
  const size_t vertex_count = mesh.rest_positions.size();
  if (start.size() != vertex_count || vertex_count == 0) {
    return InvalidArgument("START_SIZE_MISMATCH", "there must be one start position a vertex of the cloth");
  }
  for (const Eigen::Vector3d& place : start) {
    if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kLargestPlace) {
      return InvalidArgument("START_NOT_FINITE", "a start position is not finite or over 100 m from the origin");
    }
  }
  for (const SeamPair& pair : mesh.seams) FR_RETURN_IF_ERROR(CheckVertices({pair.a, pair.b}, vertex_count, "a seam"));
  FR_RETURN_IF_ERROR(CheckVertices(options.shoulder_vertices, vertex_count, "condition (6)"));
  if (!(options.frequency_times_step > 0.0) || !(options.damping >= 0.0 && options.damping <= 1.0) ||
      !std::isfinite(options.motion.gravity + options.motion.air_drag + options.motion.stitching.pull)) {
    return InvalidArgument("OPTION_OUT_OF_RANGE", "a step, damping, gravity or pull is out of its range");
  }
  if (!options.bottom.has_value()) return Status();
  const PaperBottom& bottom = *options.bottom;
  FR_RETURN_IF_ERROR(CheckVertices(bottom.crotch, vertex_count, "the crotch"));
  FR_RETURN_IF_ERROR(CheckVertices(bottom.top_edge, vertex_count, "the top edge"));
  for (const std::vector<int>& outseam : bottom.outseams) {
    FR_RETURN_IF_ERROR(CheckVertices(outseam, vertex_count, "an outseam"));
  }
  if (bottom.crotch.empty() || bottom.top_edge.size() < 3 || !bottom.groin.allFinite()) {
    return InvalidArgument("BOTTOM_INCOMPLETE", "a bottom needs a crotch, a groin and a top edge of three points");
  }
  return Status();
}

}  // namespace

PaperOptions RunnablePaperOptions() {
  PaperOptions options;
  options.motion.spring = SpringLaw::kSigned;
  options.motion.air_drag = kAirDrag;
  return options;
}

PaperOptions CorrectedPaperOptions() {
  PaperOptions options;
  options.masses = MassLaw::kLumped;
  options.stiffness = StiffnessLaw::kPerEdge;
  options.motion.spring = SpringLaw::kSigned;
  options.motion.friction = FrictionLaw::kCoulomb;
  options.motion.pulling_up = PullingUpLaw::kFrictionOnce;
  options.motion.stitching.law = StitchingLaw::kSeamsOnly;
  options.motion.air_drag = kAirDrag;
  options.collision.registration = Registration::kOverlap;
  options.collision.swept = true;
  options.collision.contact_offset = DrapeOptions().contact_offset;
  return options;
}

Result<PaperResult> PaperDrape(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                               const TriangleMesh& body, const PaperOptions& options, Executor& executor,
                               const PaperObserver& observer) {
  FR_RETURN_IF_ERROR(CheckInput(mesh, start_positions, options));
  FR_ASSIGN_OR_RETURN(PaperCloth cloth,
                      MakePaperCloth(mesh, start_positions, options.material, options.masses, options.stiffness));
  FR_ASSIGN_OR_RETURN(const BodyCollider collider, BodyCollider::Build(body, MeanEdgeLength(mesh), options.collision));
  const double highest_frequency = HighestFrequency(cloth);
  SetDamping(cloth, options.damping / highest_frequency);
  const double time_step = options.frequency_times_step / highest_frequency;
  PaperRun run(mesh, body, options, PaperMotion(std::move(cloth), collider, options.motion, time_step), observer);
  run.Observe(PaperStage::kStart);
  FR_RETURN_IF_ERROR(run.Merge());
  run.Observe(PaperStage::kStitched);
  if (run.is_closed()) {
    if (options.bottom.has_value()) {
      FR_RETURN_IF_ERROR(run.PullUp());
      FR_RETURN_IF_ERROR(run.SetBelt());
      run.Observe(PaperStage::kBelted);
    }
    FR_RETURN_IF_ERROR(run.LetHang());
  }
  run.Observe(PaperStage::kFinished);
  return run.Conclude(executor, highest_frequency);
}

}  // namespace fitroom::paper
