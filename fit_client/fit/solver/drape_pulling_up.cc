#include "fit_client/fit/solver/drape_pulling_up.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit_client/fit/solver/drape_opening.h"

namespace fitroom {
namespace {

constexpr int kPullInterval = 16;        // Substeps between looks at crotch and waist while pulling up.
constexpr int kPullPatience = 12;        // So many looks without
constexpr double kPullProgress = 2e-4;   // this much of a rise (unit: metre) and the garment is stuck.
constexpr double kTautProgress = 1e-3;   // Less, and cloth between crotch and waist is taut.
constexpr double kFromBelow = 0.4;       // The body's normal points down by more than this share at the groin.
constexpr int kLongestBelting = 1200;    // Substeps for the waist's way to the belt,
constexpr int kSettlingAfterBelt = 192;  // and for the cloth below to follow.
constexpr int kBeltingInterval = 64;     // Substeps between looks at samples.

// Only contact from below counts: a crotch between thighs that touch is near the body long before it is up.
bool TouchesFromBelow(const PullUpOptions& pull, const DrapeRun& run) {
  for (const int vertex : pull.crotch_vertices) {
    const SignedDistanceField::Sample sample = run.body.Query(run.positions[static_cast<size_t>(vertex)]);
    const double length = sample.gradient.norm();
    if (sample.distance <= pull.contact_distance && sample.gradient.y() < -kFromBelow * length) return true;
  }
  return false;
}

}  // namespace

Status PullUp(const PullUpOptions& pull, const WeldedCloth& cloth) {
  DrapeRun& run = cloth.run;
  const auto mean_height = [&] {
    double sum = 0.0;
    for (const int vertex : pull.edge_vertices) sum += run.positions[static_cast<size_t>(vertex)].y();
    return pull.edge_vertices.empty() ? 0.0 : sum / static_cast<double>(pull.edge_vertices.size());
  };
  cloth.solver.SetMotion(QuasiStaticMotion(run.options));
  DrapeReport& report = run.report;
  report.pull_end = PullEnd::kStepLimit;
  double highest = mean_height();
  // Whoever pulls holds the cloth near the waist; what hangs below follows. A wind on all of it would blow the legs up.
  cloth.state.wind.assign(cloth.state.positions.size(), Float4());
  for (size_t vertex = 0; vertex < run.positions.size(); ++vertex) {
    const double grip = std::clamp(1.0 - (highest - run.positions[vertex].y()) / pull.grip_length, 0.0, 1.0);
    cloth.state.wind[static_cast<size_t>(cloth.model.particle_of_vertex()[vertex])].y =
        static_cast<float>(grip * pull.speed);
  }
  int looks_without_progress = 0;
  bool has_touched = false;
  bool is_taut = false;  // Where the crotch touches, the waist may still hang: whoever pulls goes on until it does not.
  for (int look = 0; report.pulling_substeps < pull.substep_limit; ++look) {
    has_touched = has_touched || TouchesFromBelow(pull, run);
    if (has_touched && is_taut) {
      report.pull_end = PullEnd::kCrotchContact;
      break;
    }
    if (mean_height() >= pull.edge_height) {
      report.pull_end = PullEnd::kEdgeAtHeight;
      break;
    }
    if (looks_without_progress >= kPullPatience) {
      report.pull_end = PullEnd::kStuck;
      break;
    }
    cloth.solver.Advance(cloth.state, kPullInterval, run.MakePullsAndTies(cloth.model, run.open_seams),
                         0.1 * run.options.closing_speed);
    report.pulling_substeps += kPullInterval;
    run.substep += kPullInterval;
    FR_RETURN_IF_ERROR(run.CheckFinite(cloth.state));
    run.TakePositions(cloth.model, cloth.state);
    if (look % 4 == 3) cloth.solver.RaiseOffsets(cloth.state, run.options.sample_clearance);
    const double height = mean_height();
    is_taut = height < highest + kTautProgress;
    looks_without_progress = height > highest + kPullProgress ? 0 : looks_without_progress + 1;
    highest = std::max(highest, height);
  }
  cloth.state.wind.clear();
  for (Float4& velocity : cloth.state.velocities) velocity = Float4();
  run.Observe(DrapeStage::kPulledUp, 0.35);
  return Status();
}

Status AskForBelt(DrapeRun& run) {
  FR_ASSIGN_OR_RETURN(run.belt, run.options.attach(run.positions));
  for (const Attachment& attachment : run.belt) {
    if (attachment.particle < 0 || static_cast<size_t>(attachment.particle) >= run.positions.size()) {
      return InvalidArgument("VERTEX_OUT_OF_RANGE", "the belt holds a vertex that does not exist");
    }
  }
  return Status();
}

double HoldBelt(const WeldedCloth& cloth) {
  DrapeRun& run = cloth.run;
  std::vector<Attachment> attachments = !run.tie_lengths.empty() ? WidenBelt(run) : run.belt;
  double longest_way = 0.0;
  for (Attachment& attachment : attachments) {
    const size_t vertex = static_cast<size_t>(attachment.particle);
    longest_way = std::max(longest_way, (attachment.target - run.positions[vertex]).norm());
    attachment.particle = cloth.model.particle_of_vertex()[vertex];
  }
  cloth.solver.Attach(cloth.state, attachments);
  return longest_way;
}

Status CarryToBelt(const WeldedCloth& cloth) {
  DrapeRun& run = cloth.run;
  FR_RETURN_IF_ERROR(AskForBelt(run));
  const MotionOptions motion = QuasiStaticMotion(run.options);
  cloth.solver.SetMotion(motion);
  const double longest_way = HoldBelt(cloth);
  const int arrival = static_cast<int>(std::ceil(longest_way / (motion.attachment_speed * motion.time_step)));
  const int limit = std::min(arrival, kLongestBelting) + kSettlingAfterBelt;
  for (int done = 0; done < limit; done += kBeltingInterval) {
    cloth.solver.Advance(cloth.state, kBeltingInterval, run.MakePullsAndTies(cloth.model, run.open_seams),
                         0.1 * run.options.closing_speed);
    cloth.solver.RaiseOffsets(cloth.state, run.options.sample_clearance);
    run.report.belting_substeps += kBeltingInterval;
    run.substep += kBeltingInterval;
    FR_RETURN_IF_ERROR(run.CheckFinite(cloth.state));
    run.TakePositions(cloth.model, cloth.state);
  }
  run.Observe(DrapeStage::kBelted, 0.4);
  return Status();
}

}  // namespace fitroom
