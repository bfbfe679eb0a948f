#include "fit_client/fit/solver/drape_run.h"

#include <cmath>
#include <string>

namespace fitroom {
namespace {

constexpr double kQuasiStaticStep = 5e-4;  // (unit: second)
constexpr double kQuasiStaticDrag = 25.0;  // (unit: 1/s)
constexpr double kThroughBody = -0.002;    // A way that goes deeper than this is blocked (unit: metre).

bool PassesThroughBody(const SignedDistanceField& body, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (const double t : {0.25, 0.5, 0.75}) {
    if (body.Distance(a + (b - a) * t) < kThroughBody) return true;
  }
  return false;
}

}  // namespace

void DrapeRun::TakePositions(const ClothModel& model, const ClothState& state) {
  const std::vector<Eigen::Vector3d> particles = ClothSolver::Positions(state, model.particle_count());
  for (size_t vertex = 0; vertex < positions.size(); ++vertex) {
    positions[vertex] = particles[static_cast<size_t>(model.particle_of_vertex()[vertex])];
  }
}

std::vector<Eigen::Vector3d> DrapeRun::ParticlePositions(const ClothModel& model) const {
  std::vector<Eigen::Vector3d> sums(static_cast<size_t>(model.particle_count()), Eigen::Vector3d::Zero());
  std::vector<int> counts(sums.size(), 0);
  for (size_t vertex = 0; vertex < positions.size(); ++vertex) {
    const size_t particle = static_cast<size_t>(model.particle_of_vertex()[vertex]);
    sums[particle] += positions[vertex];
    ++counts[particle];
  }
  for (size_t particle = 0; particle < sums.size(); ++particle) sums[particle] /= counts[particle];
  return sums;
}

std::vector<double> DrapeRun::SeamGaps() const {
  std::vector<double> gaps;
  for (const SeamPair& pair : mesh.seams) {
    gaps.push_back((positions[static_cast<size_t>(pair.a)] - positions[static_cast<size_t>(pair.b)]).norm());
  }
  return gaps;
}

std::vector<SeamPull> DrapeRun::MakePulls(const ClothModel& model, std::span<const SeamPair> pairs) const {
  std::vector<SeamPull> pulls;
  for (const SeamPair& pair : pairs) {
    const Eigen::Vector3d& a = positions[static_cast<size_t>(pair.a)];
    const Eigen::Vector3d& b = positions[static_cast<size_t>(pair.b)];
    const int particle_a = model.particle_of_vertex()[static_cast<size_t>(pair.a)];
    const int particle_b = model.particle_of_vertex()[static_cast<size_t>(pair.b)];
    if (particle_a != particle_b) pulls.push_back({particle_a, particle_b, PassesThroughBody(body, a, b)});
  }
  return pulls;
}

std::vector<SeamPull> DrapeRun::MakePullsAndTies(const ClothModel& model, std::span<const SeamPair> pairs) const {
  std::vector<SeamPull> pulls = MakePulls(model, pairs);
  for (size_t index = 0; index < tie_lengths.size(); ++index) {
    if (tie_lengths[index] <= 0.0) continue;
    for (SeamPull tie : MakePulls(model, std::span(mesh.seams).subspan(index, 1))) {
      tie.around_body = false;  // A rigid tie is shorter than any way round.
      tie.tie_length = static_cast<float>(tie_lengths[index]);
      pulls.push_back(tie);
    }
  }
  return pulls;
}

Status DrapeRun::CheckFinite(const ClothState& state) const {
  for (const Float4& position : state.positions) {
    if (!std::isfinite(position.x + position.y + position.z)) {
      return Internal("CLOTH_STATE_NOT_FINITE",
                      "the cloth's state stopped being finite after " + std::to_string(substep) + " substeps");
    }
  }
  return Status();
}

MotionOptions QuasiStaticMotion(const DrapeOptions& options) {
  MotionOptions motion;
  motion.time_step = kQuasiStaticStep;
  motion.gravity.setZero();
  motion.drag = kQuasiStaticDrag;
  motion.friction_coefficient = options.stitching_friction_coefficient;
  motion.contact_offset = options.contact_offset;
  return motion;
}

}  // namespace fitroom
