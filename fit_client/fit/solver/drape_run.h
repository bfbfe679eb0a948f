#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_model.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/drape.h"
#include "fit_client/fit/solver/drape_hoops.h"

namespace fitroom {

// What the stages of one call of Drape() share. The stages (drape_merging.h, drape_hanging.h) read the positions that
// the one before left, and write their own and their part of the report. Refers to what Drape() was given.
struct DrapeRun {
  const ClothMesh& mesh;
  const SignedDistanceField& body;
  const DrapeOptions& options;
  Executor& executor;
  const DrapeObserver& observer;
  std::vector<Eigen::Vector3d> positions;  // One a vertex of the mesh (unit: metre).
  std::vector<SeamPair> open_seams;        // That did not close while merging.
  int substep = 0;                         // Since the start.
  DrapeReport report;
  std::vector<Attachment> belt;     // Vertices that are held, once a belt is laid, in order round the waist's edge.
  std::vector<GarmentHoop> hoops;   // Once somebody asks whether a seam gives way.
  std::vector<double> tie_lengths;  // One a seam pair; 0: sewn, or drawn together. Empty: no seam gives way.

  void Observe(DrapeStage stage, double progress) const {
    if (observer) observer({stage, substep, progress, positions});
  }
  // Takes the vertices' positions from those of the particles.
  void TakePositions(const ClothModel& model, const ClothState& state);
  // Returns for each particle the mean of the vertices that make it up: where sewn partners meet.
  std::vector<Eigen::Vector3d> ParticlePositions(const ClothModel& model) const;
  // Returns the distance between the partners of each pair of the mesh (unit: metre).
  std::vector<double> SeamGaps() const;
  // Returns the pulls that draw the pairs together; round the body where the straight way leads through it.
  std::vector<SeamPull> MakePulls(const ClothModel& model, std::span<const SeamPair> pairs) const;
  // Returns the pulls that draw the pairs together, and the ties of seams that give way.
  std::vector<SeamPull> MakePullsAndTies(const ClothModel& model, std::span<const SeamPair> pairs) const;
  // INTERNAL (CLOTH_STATE_NOT_FINITE) where a number of the state is not finite.
  Status CheckFinite(const ClothState& state) const;
};

// How the cloth moves while seams close and while it is pulled: slowly, without gravity, hardly held by friction.
// Steps of twice 0.5 ms stretch springs by over 10 % while closing. A drag below 10/s lets panels overshoot, above 60/s
// merging slows down.
MotionOptions QuasiStaticMotion(const DrapeOptions& options);

}  // namespace fitroom
