#pragma once

#include <span>
#include <vector>

#include "common/base/executor.h"
#include "fit_client/fit/solver/cloth_model.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/self_collision_pairs.h"
#include "fit_client/fit/solver/self_collision_topology.h"

namespace fitroom {

struct SelfCollisionOptions {
  double thickness = 0.002;           // Layers stay this far apart, but for a quarter of an edge at most (unit: metre).
  double friction_coefficient = 0.2;  // Cloth on cloth (unit: 1).
  double recovery_speed = 0.03;       // At which layers that were found closer move apart (unit: m/s).
  double untangling_speed = 0.15;     // At which pieces that pass through each other are drawn out (unit: m/s).
  int contacts_per_particle = 24;     // No more than so many in the mean; what is over is left out (unit: 1).
};

// Cloth against itself: layers that meet stay apart by the thickness and on the side on which they met, with Coulomb
// friction; pieces that pass through each other are drawn apart.
//
// Pairs are found when the cloth has moved by a millimetre or two, and keep direction and weights until the next look.
// A pair keeps its side from look to look. Where cloth passes through cloth, sides mean nothing: no new pair is taken
// up there until the crossing is gone. Contacts are solved one after the other in the order of their keys, so that the
// result does not depend on the executor.
// Owns nothing but its pairs: model and executor must outlive it. Not thread-safe.
class SelfCollision {
 public:
  SelfCollision(const ClothModel& model, const SelfCollisionOptions& options, Executor& executor);

  // Moves the particles of a substep that is about to end apart where they are too close; looks for pairs anew when
  // need be. Momentum is conserved.
  void Solve(ClothState& state, double time_step);
  // Looks for pairs and crossings now.
  void Refresh(const ClothState& state);
  // Irons what passes through itself (see IronTangles) outside `body` by `contact_offset` (unit: metre), or half of it
  // where it `may_yield`, and looks for pairs. Moves nothing where nothing crosses.
  void Iron(const SignedDistanceField& body, double contact_offset, bool may_yield, ClothState& state);
  // Gives up the cloth round what crosses now: it passes through itself until it is ironed. Where there is no room for
  // layers, pushing them out of each other and ironing them in turn would go on for ever.
  void LeaveTangles();
  // From now on layers may lie closer and rub more: those that find no room would tremble for ever.
  void GiveIn();

  int contact_count() const { return static_cast<int>(contacts_.size()); }
  // As of the last look; what has been given up is not counted.
  int crossing_count() const { return static_cast<int>(crossings_.size()); }

 private:
  bool HasMoved(const ClothState& state) const;
  // Takes up what a look has found, with the sides and gaps of before.
  void TakeUp(ClothEncounters found);
  // Takes out what touches cloth that has been given up.
  void ForgetLeft(ClothEncounters& found) const;
  void SolveContacts(ClothState& state, float largest_push) const;
  void Untangle(ClothState& state, float step) const;

  const ClothModel& model_;
  const SelfCollisionOptions options_;
  Executor& executor_;
  const SelfCollisionTopology topology_;
  float thickness_ = 0.0F;      // (unit: metre)
  float friction_ = 0.0F;       // (unit: 1)
  float slack_ = 0.0F;          // Way that pairs are looked for ahead (unit: metre).
  float search_radius_ = 0.0F;  // Of particles (unit: metre).
  std::vector<ClothContact> contacts_;
  std::vector<ClothCrossing> crossings_;
  std::vector<char> is_left_;      // One a particle: given up, see LeaveTangles(). Empty: none is.
  std::vector<Float4> reference_;  // Positions at the last look.
  int substeps_since_look_ = 0;
  double seconds_since_look_ = 0.0;
};

}  // namespace fitroom
