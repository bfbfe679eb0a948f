#include "fit_client/fit/solver/cloth_solver.h"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>

#include "fit_client/fit/solver/self_collision.h"

namespace fitroom {
namespace {

constexpr double kOpposite = -0.5;       // Cosine: normals of two parts of the body that face each other.
constexpr double kLeastOffset = 0.0005;  // From the body, where it leaves no room (unit: metre).

__m128 Load(const Float4& value) { return _mm_load_ps(&value.x); }
void Store(Float4& target, __m128 value) { _mm_store_ps(&target.x, value); }

template <int kLane>
__m128 Broadcast(__m128 v) {
  return _mm_shuffle_ps(v, v, _MM_SHUFFLE(kLane, kLane, kLane, kLane));
}

// Returns v with the fourth number set to zero.
__m128 Xyz(__m128 v) {
  const __m128 mask = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
  return _mm_and_ps(v, mask);
}

// The scalar product of the first three numbers.
float Dot3(__m128 a, __m128 b) {
  const __m128 product = _mm_mul_ps(a, b);
  const __m128 y = Broadcast<1>(product);
  const __m128 z = Broadcast<2>(product);
  return _mm_cvtss_f32(_mm_add_ss(_mm_add_ss(product, y), z));
}

Float4 ToFloat4(const Eigen::Vector3d& v, float w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), w};
}

Eigen::Vector3d ToVector(const Float4& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace

ClothSolver::ClothSolver(const ClothModel& model, const SignedDistanceField& body, Executor& executor)
    : model_(model), body_(body), executor_(executor) {
  for (const double mass : model.masses()) inverse_masses_.push_back(static_cast<float>(1.0 / mass));
  inverse_masses_.resize(inverse_masses_.size() + static_cast<size_t>(model.idle_particle_count()), 0.0F);
  SetMotion(MotionOptions());
}

ClothState ClothSolver::MakeState(std::span<const Eigen::Vector3d> positions) const {
  FR_CHECK(static_cast<int>(positions.size()) == model_.particle_count());
  ClothState state;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : positions) box.extend(position);
  state.centre = box.center();
  const size_t count = inverse_masses_.size();
  state.positions.resize(count);
  for (size_t particle = 0; particle < positions.size(); ++particle) {
    state.positions[particle] = ToFloat4(positions[particle] - state.centre, inverse_masses_[particle]);
  }
  state.previous = state.positions;
  state.velocities.resize(count);
  state.contacts.resize(count);
  state.extra_offset.resize(count, 0.0F);
  for (size_t particle = 0; particle < positions.size(); ++particle) LookAtBody(state, particle);
  return state;
}

void ClothSolver::Attach(ClothState& state, std::span<const Attachment> attachments) {
  const std::span<const double> masses = model_.masses();
  for (size_t particle = 0; particle < masses.size(); ++particle) {
    inverse_masses_[particle] = static_cast<float>(1.0 / masses[particle]);
  }
  state.targets.assign(attachments.empty() ? 0 : state.positions.size(), Float4());
  for (const Attachment& attachment : attachments) {
    const size_t particle = static_cast<size_t>(attachment.particle);
    FR_CHECK(particle < masses.size());
    inverse_masses_[particle] = 0.0F;
    state.targets[particle] = ToFloat4(attachment.target - state.centre, 1.0F);
    state.velocities[particle] = Float4();
  }
  for (size_t particle = 0; particle < masses.size(); ++particle) {
    state.positions[particle].w = inverse_masses_[particle];
  }
  SetMotion(motion_);
}

void ClothSolver::SetMotion(const MotionOptions& motion) {
  motion_ = motion;
  denominators_.clear();
  for (const ClothChunk& chunk : model_.chunks()) denominators_.push_back(MakeDenominators(chunk));
  denominators_.push_back(MakeDenominators(model_.border()));
}

ChunkDenominators ClothSolver::MakeDenominators(const ClothChunk& chunk) const {
  ChunkDenominators denominators;
  const float per_squared_step = static_cast<float>(1.0 / (motion_.time_step * motion_.time_step));
  for (const StretchBatch& batch : chunk.stretch) {
    Float4 lanes;
    float* const lane_value = &lanes.x;
    for (size_t lane = 0; lane < 4; ++lane) {
      const float weight = inverse_masses_[static_cast<size_t>(batch.a[lane])] +
                           inverse_masses_[static_cast<size_t>(batch.b[lane])] +
                           batch.compliance[lane] * per_squared_step;
      lane_value[lane] = weight > 0.0F ? 1.0F / weight : 0.0F;
    }
    denominators.stretch.push_back(lanes);
  }
  for (const BendConstraint& bend : chunk.bend) {
    bool is_free = true;
    float held_weight = 0.0F;  // sum_i c_i^2 / m_i where some masses are infinite.
    for (size_t corner = 0; corner < 4; ++corner) {
      const float inverse_mass = inverse_masses_[static_cast<size_t>(bend.particles[corner])];
      is_free = is_free && inverse_mass > 0.0F;
      held_weight += bend.coefficients[corner] * bend.coefficients[corner] * inverse_mass;
    }
    const float weight = is_free ? bend.weight : held_weight;
    const float scale = 1.0F / (weight + bend.compliance * per_squared_step);
    const auto move = [&](size_t corner) {
      return bend.coefficients[corner] * inverse_masses_[static_cast<size_t>(bend.particles[corner])] * scale;
    };
    denominators.bend.push_back({move(0), move(1), move(2), move(3)});
  }
  return denominators;
}

void ClothSolver::Advance(ClothState& state, int substep_count, std::span<const SeamPull> pulls, double closing_speed) {
  const std::span<const ClothChunk> chunks = model_.chunks();
  const int chunk_count = static_cast<int>(chunks.size());
  const KernelWidth width = WidestKernel();
  const float compression = static_cast<float>(motion_.compression_factor);
  for (int substep = 0; substep < substep_count; ++substep) {
    executor_.Run(chunk_count, [&](int task) {
      const size_t chunk = static_cast<size_t>(task);
      if (substep > 0) SolveContacts(state, chunks[chunk]);
      Integrate(state, chunks[chunk]);
      SolveChunk(width, state.positions, chunks[chunk], denominators_[chunk], compression);
    });
    SolveChunk(width, state.positions, model_.border(), denominators_.back(), compression);
    SolvePulls(state, pulls, closing_speed);
    if (self_collision_ != nullptr) self_collision_->Solve(state, motion_.time_step);
  }
  executor_.Run(chunk_count, [&](int task) { SolveContacts(state, chunks[static_cast<size_t>(task)]); });
}

void ClothSolver::Integrate(ClothState& state, const ClothChunk& chunk) const {
  const float step = static_cast<float>(motion_.time_step);
  const __m128 keep = _mm_set1_ps(static_cast<float>(std::exp(-motion_.drag * motion_.time_step)));
  const __m128 gain = _mm_set1_ps(static_cast<float>(-std::expm1(-motion_.drag * motion_.time_step)));
  const Eigen::Vector3d gain_of_gravity = motion_.gravity * motion_.time_step;
  const Float4 fall = ToFloat4(gain_of_gravity, 0.0F);
  const float largest = static_cast<float>(motion_.largest_step);
  const size_t begin = static_cast<size_t>(chunk.first_particle);
  const size_t end = begin + static_cast<size_t>(chunk.particle_count);
  const float attached_way = static_cast<float>(motion_.attachment_speed * motion_.time_step);
  for (size_t particle = begin; particle < end; ++particle) {
    if (!state.targets.empty() && state.targets[particle].w > 0.0F) {
      const __m128 place = Load(state.positions[particle]);
      const __m128 left = Xyz(_mm_sub_ps(Load(state.targets[particle]), place));
      const float length = std::sqrt(Dot3(left, left));
      const float part = length > attached_way ? attached_way / length : 1.0F;
      Store(state.previous[particle], place);
      Store(state.positions[particle], _mm_add_ps(place, _mm_mul_ps(left, _mm_set1_ps(part))));
      continue;
    }
    __m128 velocity = _mm_add_ps(_mm_mul_ps(Load(state.velocities[particle]), keep), Load(fall));
    if (!state.wind.empty()) velocity = _mm_add_ps(velocity, _mm_mul_ps(Load(state.wind[particle]), gain));
    __m128 way = _mm_mul_ps(Xyz(velocity), _mm_set1_ps(step));
    const float squared = Dot3(way, way);
    if (squared > largest * largest) way = _mm_mul_ps(way, _mm_set1_ps(largest / std::sqrt(squared)));
    const __m128 position = Load(state.positions[particle]);
    Store(state.previous[particle], position);
    Store(state.positions[particle], _mm_add_ps(position, way));
  }
}

// Draws the two particles of each pair together, by equal and opposite impulses, no faster than the closing speed.
void ClothSolver::SolvePulls(ClothState& state, std::span<const SeamPull> pulls, double closing_speed) const {
  const float largest = static_cast<float>(closing_speed * motion_.time_step);
  for (const SeamPull& pull : pulls) {
    Float4& a = state.positions[static_cast<size_t>(pull.a)];
    Float4& b = state.positions[static_cast<size_t>(pull.b)];
    const __m128 at_a = Load(a);
    const __m128 at_b = Load(b);
    const __m128 way = Xyz(_mm_sub_ps(at_b, at_a));
    const float length = std::sqrt(Dot3(way, way));
    if (length < 1e-9F || a.w + b.w <= 0.0F) continue;
    const bool is_tie = pull.tie_length > 0.0F;
    if (is_tie && length <= pull.tie_length) continue;
    const float step = (is_tie ? length - pull.tie_length : std::min(length, largest)) / length;
    const float share = a.w / (a.w + b.w);
    __m128 step_a = _mm_mul_ps(way, _mm_set1_ps(step * share));
    __m128 step_b = _mm_mul_ps(way, _mm_set1_ps(-step * (1.0F - share)));
    if (pull.around_body) {
      // Take out the part that points into the body and keep the length.
      const auto along_surface = [&](__m128 wanted, size_t particle) {
        const __m128 normal = Xyz(Load(state.contacts[particle].normal));
        const float inwards = std::min(0.0F, Dot3(wanted, normal));
        const __m128 tangent = _mm_sub_ps(wanted, _mm_mul_ps(normal, _mm_set1_ps(inwards)));
        const float tangent_length = std::sqrt(Dot3(tangent, tangent));
        const float wanted_length = std::sqrt(Dot3(wanted, wanted));
        return tangent_length > 0.05F * wanted_length ? _mm_mul_ps(tangent, _mm_set1_ps(wanted_length / tangent_length))
                                                      : tangent;
      };
      step_a = along_surface(step_a, static_cast<size_t>(pull.a));
      step_b = along_surface(step_b, static_cast<size_t>(pull.b));
    }
    Store(a, _mm_add_ps(at_a, step_a));
    Store(b, _mm_add_ps(at_b, step_b));
  }
}

void ClothSolver::LookAtBody(ClothState& state, size_t particle) const {
  const Float4 at = state.positions[particle];
  const SignedDistanceField::Sample sample = body_.Query(ToVector(at) + state.centre);
  const double length = sample.gradient.norm();
  const Eigen::Vector3d normal = length > 1e-6 ? (sample.gradient / length).eval() : Eigen::Vector3d::UnitY();
  ContactPlane& contact = state.contacts[particle];
  // Between arm and trunk one side pushes a particle to the other, which pushes it back: where there is no room for the
  // offset on both sides, it stays in the middle.
  const Eigen::Vector3d normal_before(contact.normal.x, contact.normal.y, contact.normal.z);
  if (normal_before.dot(normal) < kOpposite) {
    const double gap_before = normal_before.dot(ToVector(at)) - static_cast<double>(contact.normal.w);
    const double offset = motion_.contact_offset + static_cast<double>(state.extra_offset[particle]);
    const double middle = 0.5 * (gap_before + sample.distance);
    if (middle < offset) {
      state.extra_offset[particle] = static_cast<float>(std::max(middle, kLeastOffset) - motion_.contact_offset);
    }
  }
  contact.normal = ToFloat4(normal, static_cast<float>(normal.dot(ToVector(at)) - sample.distance));
  // A plane stands for the surface while the particle has moved little; far away half the distance is safe.
  const double clear = std::abs(sample.distance) - motion_.contact_offset;
  const double way = std::max(0.0015, 0.4 * clear);
  contact.reference = at;
  contact.reference.w = static_cast<float>(way * way);
}

void ClothSolver::SolveContacts(ClothState& state, const ClothChunk& chunk) const {
  const float per_step = static_cast<float>(1.0 / motion_.time_step);
  const float friction = static_cast<float>(motion_.friction_coefficient);
  const float offset = static_cast<float>(motion_.contact_offset);
  const size_t begin = static_cast<size_t>(chunk.first_particle);
  const size_t end = begin + static_cast<size_t>(chunk.particle_count);
  for (size_t particle = begin; particle < end; ++particle) {
    if (!state.targets.empty() && state.targets[particle].w > 0.0F) continue;  // Attached: the body does not move it.
    __m128 position = Load(state.positions[particle]);
    const __m128 moved = _mm_sub_ps(position, Load(state.contacts[particle].reference));
    if (Dot3(moved, moved) > state.contacts[particle].reference.w) LookAtBody(state, particle);
    const __m128 plane = Load(state.contacts[particle].normal);
    const __m128 normal = Xyz(plane);
    const float depth =
        offset + state.extra_offset[particle] + state.contacts[particle].normal.w - Dot3(normal, position);
    const __m128 previous = Load(state.previous[particle]);
    if (depth <= 0.0F) {
      Store(state.velocities[particle], _mm_mul_ps(Xyz(_mm_sub_ps(position, previous)), _mm_set1_ps(per_step)));
      continue;
    }
    // Never by more than a few millimetres a step: a particle that starts inside walks out instead of jumping.
    const float push = std::min(depth, static_cast<float>(motion_.largest_step));
    position = _mm_add_ps(position, _mm_mul_ps(normal, _mm_set1_ps(push)));
    const __m128 way = Xyz(_mm_sub_ps(position, previous));
    const float normal_way = Dot3(way, normal);
    __m128 tangent = _mm_sub_ps(way, _mm_mul_ps(normal, _mm_set1_ps(normal_way)));
    const float tangent_way = std::sqrt(Dot3(tangent, tangent));
    const float held = friction * push;
    const float kept = tangent_way > held ? 1.0F - held / tangent_way : 0.0F;
    position = _mm_sub_ps(position, _mm_mul_ps(tangent, _mm_set1_ps(1.0F - kept)));
    tangent = _mm_mul_ps(tangent, _mm_set1_ps(kept));
    Store(state.positions[particle], position);
    Store(state.velocities[particle], _mm_mul_ps(tangent, _mm_set1_ps(per_step)));
  }
}

int ClothSolver::RaiseOffsets(ClothState& state, double clearance) const {
  constexpr size_t kSamplesPerTask = 2048;
  const auto deficit_at = [&](const Eigen::Vector3d& point) {
    return static_cast<float>(std::max(0.0, clearance - body_.Distance(point)));
  };
  const auto is_near = [&](int particle) {
    const Float4& at = state.positions[static_cast<size_t>(particle)];
    const Float4& plane = state.contacts[static_cast<size_t>(particle)].normal;
    return at.x * plane.x + at.y * plane.y + at.z * plane.z - plane.w < 0.03F;
  };
  const auto place = [&](int particle) { return ToVector(state.positions[static_cast<size_t>(particle)]); };
  const std::span<const std::array<int, 2>> edges = model_.edges();
  const std::span<const std::array<int, 3>> triangles = model_.triangles();
  std::vector<float> deficits(edges.size() + triangles.size(), 0.0F);
  executor_.Run(static_cast<int>((deficits.size() + kSamplesPerTask - 1) / kSamplesPerTask), [&](int task) {
    const size_t begin = static_cast<size_t>(task) * kSamplesPerTask;
    for (size_t index = begin; index < std::min(begin + kSamplesPerTask, deficits.size()); ++index) {
      if (index < edges.size()) {
        const auto& [a, b] = edges[index];
        if (!is_near(a) && !is_near(b)) continue;
        deficits[index] = deficit_at(0.5 * (place(a) + place(b)) + state.centre);
      } else {
        const auto& [a, b, c] = triangles[index - edges.size()];
        if (!is_near(a) && !is_near(b) && !is_near(c)) continue;
        deficits[index] = deficit_at((place(a) + place(b) + place(c)) / 3.0 + state.centre);
      }
    }
  });
  constexpr float kLargestExtraOffset = 0.008F;
  int count = 0;
  std::vector<float> raise(state.extra_offset.size(), 0.0F);
  const auto raise_at = [&](int particle, float deficit) {
    raise[static_cast<size_t>(particle)] = std::max(raise[static_cast<size_t>(particle)], deficit);
  };
  for (size_t index = 0; index < deficits.size(); ++index) {
    if (deficits[index] <= 0.0F) continue;
    ++count;
    if (index < edges.size()) {
      for (const int particle : edges[index]) raise_at(particle, deficits[index]);
    } else {
      for (const int particle : triangles[index - edges.size()]) raise_at(particle, deficits[index]);
    }
  }
  for (size_t particle = 0; particle < raise.size(); ++particle) {
    state.extra_offset[particle] = std::min(kLargestExtraOffset, state.extra_offset[particle] + raise[particle]);
  }
  return count;
}

std::vector<Eigen::Vector3d> ClothSolver::Positions(const ClothState& state, int particle_count) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(static_cast<size_t>(particle_count));
  for (size_t particle = 0; particle < static_cast<size_t>(particle_count); ++particle) {
    positions.push_back(ToVector(state.positions[particle]) + state.centre);
  }
  return positions;
}

}  // namespace fitroom
