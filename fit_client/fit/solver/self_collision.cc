#include "fit_client/fit/solver/self_collision.h"

#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fit_client/fit/solver/self_collision_iron.h"
#include "fit_client/fit/solver/self_collision_near.h"

namespace fitroom {
namespace {

constexpr double kSlack = 0.002;       // At most (unit: metre),
constexpr double kSlackOfEdge = 0.3;   // and on fine meshes, where more particles are near (unit: mean edge).
constexpr double kLongestEdge = 1.3;   // Crossings of longer edges may be seen late (unit: mean edge).
constexpr double kReachOfEdge = 0.76;  // sqrt(1/2^2 + 1/3): from an edge's end to the corner of a triangle that it
                                       // crosses in the middle (unit: edge).
constexpr int kCheckInterval = 8;      // Substeps between looks at how far particles have moved.
constexpr int kFew = 500;              // One of so many particles may move farther
constexpr int kPatience = 32;          // for so many substeps.
constexpr double kUntangleInterval = 0.005;  // Between looks while cloth passes through cloth (unit: second).
constexpr int kLargestStrikes = 12;          // Looks on the wrong side after which a side is given up.
constexpr float kHeldShare = 0.6F;           // Of the gap to keep: what is less could not be kept.
constexpr double kKeptOffset = 0.5;          // Of the offset from the body, where layers have been ironed,
constexpr double kFineEdge = 0.012;          // on meshes so fine that no edge cuts through the body then (unit: metre).
constexpr int kLeftRings = 2;                // Edges round a crossing that are given up with it.
constexpr double kLargestPushSpeed = 0.25;   // Of a contact that is violated (unit: m/s).

__m128 Load(const Float4& value) { return _mm_load_ps(&value.x); }
void Store(Float4& target, __m128 value) { _mm_store_ps(&target.x, value); }

template <int kLane>
__m128 Broadcast(__m128 v) {
  return _mm_shuffle_ps(v, v, _MM_SHUFFLE(kLane, kLane, kLane, kLane));
}

__m128 Xyz(__m128 v) {
  const __m128 mask = _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1));
  return _mm_and_ps(v, mask);
}

float Dot3(__m128 a, __m128 b) {
  const __m128 product = _mm_mul_ps(a, b);
  return _mm_cvtss_f32(_mm_add_ss(_mm_add_ss(product, Broadcast<1>(product)), Broadcast<2>(product)));
}

}  // namespace

SelfCollision::SelfCollision(const ClothModel& model, const SelfCollisionOptions& options, Executor& executor)
    : model_(model), options_(options), executor_(executor), topology_(MakeSelfCollisionTopology(model)) {
  const double edge = topology_.mean_edge_length;
  thickness_ = static_cast<float>(std::min(options.thickness, 0.25 * edge));
  friction_ = static_cast<float>(options.friction_coefficient);
  slack_ = static_cast<float>(std::min(kSlack, kSlackOfEdge * edge));
  search_radius_ = static_cast<float>(kReachOfEdge * kLongestEdge * edge) + thickness_;
}

void SelfCollision::Refresh(const ClothState& state) {
  const int largest_count = options_.contacts_per_particle * model_.particle_count();
  const NumberLists near = FindNearParticles(state.positions, model_.particle_count(), topology_.neighbours_of_particle,
                                             search_radius_ + slack_, largest_count, executor_);
  TakeUp(FindEncounters(model_, topology_, near, state.positions, thickness_ + slack_, executor_));
  reference_ = state.positions;
  substeps_since_look_ = 0;
  seconds_since_look_ = 0.0;
}

void SelfCollision::Iron(const SignedDistanceField& body, double contact_offset, bool may_yield, ClothState& state) {
  is_left_.clear();
  Refresh(state);
  if (crossings_.empty()) return;
  IroningOptions ironing;
  ironing.search_radius = static_cast<double>(search_radius_);
  ironing.contact_offset = contact_offset;
  ironing.kept_offset =
      may_yield && topology_.mean_edge_length < kFineEdge ? kKeptOffset * contact_offset : contact_offset;
  ironing.largest_pair_count = options_.contacts_per_particle * model_.particle_count();
  IronTangles(model_, topology_, body, ironing, state, executor_);
  contacts_.clear();
  Refresh(state);
}

void SelfCollision::LeaveTangles() {
  if (crossings_.empty()) return;
  is_left_.resize(static_cast<size_t>(model_.particle_count()), 0);
  for (const int particle : ParticlesAround(model_, topology_, crossings_, kLeftRings)) {
    is_left_[static_cast<size_t>(particle)] = 1;
  }
  ClothEncounters kept{std::move(contacts_), std::move(crossings_)};
  ForgetLeft(kept);
  contacts_ = std::move(kept.contacts);
  crossings_ = std::move(kept.crossings);
}

void SelfCollision::ForgetLeft(ClothEncounters& found) const {
  if (is_left_.empty()) return;
  const auto any_left = [this](const auto& particles) {
    return std::any_of(particles.begin(), particles.end(),
                       [this](int particle) { return is_left_[static_cast<size_t>(particle)] != 0; });
  };
  std::erase_if(found.contacts, [&](const ClothContact& contact) { return any_left(contact.particles); });
  std::erase_if(found.crossings, [&](const ClothCrossing& crossing) {
    return any_left(model_.edges()[static_cast<size_t>(crossing.edge)]) ||
           any_left(model_.triangles()[static_cast<size_t>(crossing.triangle)]);
  });
}

void SelfCollision::TakeUp(ClothEncounters found) {
  ForgetLeft(found);
  std::vector<char> is_tangled(static_cast<size_t>(model_.particle_count()), 0);
  for (const ClothCrossing& crossing : found.crossings) {
    for (const int particle : model_.edges()[static_cast<size_t>(crossing.edge)]) {
      is_tangled[static_cast<size_t>(particle)] = 1;
    }
    for (const int particle : model_.triangles()[static_cast<size_t>(crossing.triangle)]) {
      is_tangled[static_cast<size_t>(particle)] = 1;
    }
  }
  const float recovered = static_cast<float>(options_.recovery_speed * seconds_since_look_);
  const size_t largest_count = static_cast<size_t>(options_.contacts_per_particle * model_.particle_count());
  std::vector<ClothContact> taken;
  taken.reserve(found.contacts.size());
  size_t old = 0;
  for (ClothContact& contact : found.contacts) {
    if (taken.size() >= largest_count) break;
    while (old < contacts_.size() && contacts_[old].key < contact.key) ++old;
    const bool is_known = old < contacts_.size() && contacts_[old].key == contact.key;
    const float gap = contact.normal.w;
    if (is_known) {
      const ClothContact& before = contacts_[old];
      if (before.side == contact.side) {
        // Where something holds the layers closer, as between arm and trunk, the gap gives in: else they would tremble.
        const bool gives_in = gap < kHeldShare * before.normal.w;
        contact.normal.w = gives_in ? gap : std::min(thickness_, std::max(gap, before.normal.w + recovered));
      } else {
        contact.strikes = static_cast<int16_t>(before.strikes + 1);
        if (contact.strikes > kLargestStrikes) continue;
        contact.side = before.side;
        contact.normal = {-contact.normal.x, -contact.normal.y, -contact.normal.z, before.normal.w};
      }
    } else {
      const bool tangled = std::any_of(contact.particles.begin(), contact.particles.end(), [&](int32_t particle) {
        return is_tangled[static_cast<size_t>(particle)] != 0;
      });
      if (tangled) continue;
      contact.normal.w = std::min(thickness_, gap);
    }
    taken.push_back(contact);
  }
  contacts_ = std::move(taken);
  crossings_ = std::move(found.crossings);
  TurnPartedPiecesBack(model_, crossings_);
}

void SelfCollision::GiveIn() {
  thickness_ *= 0.3F;
  friction_ *= 5.0F;
}

bool SelfCollision::HasMoved(const ClothState& state) const {
  const float squared_limit = 0.25F * slack_ * slack_;
  // A few that tremble are not worth a look each time.
  int patience = substeps_since_look_ < kPatience ? model_.particle_count() / kFew : 0;
  for (size_t particle = 0; particle < static_cast<size_t>(model_.particle_count()); ++particle) {
    const __m128 way = _mm_sub_ps(Load(state.positions[particle]), Load(reference_[particle]));
    if (Dot3(way, way) > squared_limit && --patience < 0) return true;
  }
  return false;
}

void SelfCollision::Solve(ClothState& state, double time_step) {
  if (reference_.size() != state.positions.size()) {
    Refresh(state);
  } else if (substeps_since_look_ % kCheckInterval == 0 && substeps_since_look_ > 0) {
    const bool is_due = !crossings_.empty() && seconds_since_look_ >= kUntangleInterval;
    if (is_due || HasMoved(state)) Refresh(state);
  }
  ++substeps_since_look_;
  seconds_since_look_ += time_step;
  SolveContacts(state, static_cast<float>(kLargestPushSpeed * time_step));
  Untangle(state, static_cast<float>(options_.untangling_speed * time_step));
}

void SelfCollision::SolveContacts(ClothState& state, float largest_push) const {
  const float friction = friction_;
  for (const ClothContact& contact : contacts_) {
    Float4* const at[4] = {&state.positions[static_cast<size_t>(contact.particles[0])],
                           &state.positions[static_cast<size_t>(contact.particles[1])],
                           &state.positions[static_cast<size_t>(contact.particles[2])],
                           &state.positions[static_cast<size_t>(contact.particles[3])]};
    const __m128 weights = _mm_load_ps(contact.weights.data());
    const __m128 w[4] = {Broadcast<0>(weights), Broadcast<1>(weights), Broadcast<2>(weights), Broadcast<3>(weights)};
    const __m128 places[4] = {Load(*at[0]), Load(*at[1]), Load(*at[2]), Load(*at[3])};
    const __m128 between = _mm_add_ps(_mm_add_ps(_mm_mul_ps(places[0], w[0]), _mm_mul_ps(places[1], w[1])),
                                      _mm_add_ps(_mm_mul_ps(places[2], w[2]), _mm_mul_ps(places[3], w[3])));
    const __m128 normal = Load(contact.normal);
    const float deficit = contact.normal.w - Dot3(normal, between);
    if (deficit <= 0.0F) continue;
    const float push = std::min(deficit, largest_push);
    __m128 before = _mm_setzero_ps();
    for (size_t place = 0; place < 4; ++place) {
      const Float4& previous = state.previous[static_cast<size_t>(contact.particles[place])];
      before = _mm_add_ps(before, _mm_mul_ps(Load(previous), w[place]));
    }
    const __m128 way = _mm_sub_ps(between, before);
    const float parting = Dot3(way, normal);
    const __m128 tangent = _mm_sub_ps(way, _mm_mul_ps(normal, _mm_set1_ps(parting)));
    const float tangent_way = std::sqrt(Dot3(tangent, tangent));
    const float held = friction * push;
    const float cut = tangent_way > held ? held / tangent_way : 1.0F;
    const __m128 move =
        Xyz(_mm_mul_ps(_mm_sub_ps(_mm_mul_ps(normal, _mm_set1_ps(push)), _mm_mul_ps(tangent, _mm_set1_ps(cut))),
                       _mm_set1_ps(contact.scale)));
    // Only as much of it becomes velocity as stops the approach: a contact is inelastic, and what lay too deep does not
    // fly off.
    const float lift = std::max(0.0F, push - std::max(0.0F, -parting));
    const __m128 shift = Xyz(_mm_mul_ps(normal, _mm_set1_ps(lift * contact.scale)));
    for (size_t place = 0; place < 4; ++place) {
      const __m128 share = _mm_mul_ps(w[place], Broadcast<3>(places[place]));
      Float4& previous = state.previous[static_cast<size_t>(contact.particles[place])];
      Store(*at[place], _mm_add_ps(places[place], _mm_mul_ps(move, share)));
      Store(previous, _mm_add_ps(Load(previous), _mm_mul_ps(shift, share)));
    }
  }
}

// Moves places, not velocities: what is drawn out does not swing on.
void SelfCollision::Untangle(ClothState& state, float step) const {
  for (const ClothCrossing& crossing : crossings_) {
    const auto& edge = model_.edges()[static_cast<size_t>(crossing.edge)];
    const auto& triangle = model_.triangles()[static_cast<size_t>(crossing.triangle)];
    const std::array<int, 5> particles = {edge[0], edge[1], triangle[0], triangle[1], triangle[2]};
    const std::array<float, 5> weights = {crossing.edge_weights[0], crossing.edge_weights[1],
                                          -crossing.triangle_weights[0], -crossing.triangle_weights[1],
                                          -crossing.triangle_weights[2]};
    float sum = 0.0F;
    for (size_t place = 0; place < 5; ++place) {
      sum += weights[place] * weights[place] * state.positions[static_cast<size_t>(particles[place])].w;
    }
    if (!(sum > 0.0F)) continue;
    const __m128 move = _mm_mul_ps(Load(crossing.way), _mm_set1_ps(step / sum));
    for (size_t place = 0; place < 5; ++place) {
      Float4& at = state.positions[static_cast<size_t>(particles[place])];
      Float4& previous = state.previous[static_cast<size_t>(particles[place])];
      const __m128 way = _mm_mul_ps(move, _mm_set1_ps(weights[place] * at.w));
      Store(at, _mm_add_ps(Load(at), way));
      Store(previous, _mm_add_ps(Load(previous), way));
    }
  }
}

}  // namespace fitroom
