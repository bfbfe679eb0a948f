#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/body/body.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/solver/drape.h"
#include "fit_client/fit/stages/start_pose.h"

namespace fitroom {

// A T-shirt's jersey on skin. The drape's own defaults are those of a firmer cloth. Tuned by eye and by strain on
// T-shirts with 0 to 20 cm of ease: from 400 N/m upwards a hem that is narrower than the hip climbs to the waist and
// stacks folds, below 100 N/m the shirt lengthens under its own weight; below a friction of 0.4 the hem slides the same
// way.
inline DrapeOptions JerseyDrapeOptions() {
  DrapeOptions options;
  options.material.stretch_stiffness = 200.0;
  options.friction_coefficient = 0.5;
  options.relaxing_substeps = 100;
  return options;
}

struct DressTopOptions {
  StartPoseOptions start_pose;
  double field_pitch = 0.004;  // Of the body's signed distance field (unit: metre).
  DrapeOptions drape = JerseyDrapeOptions();
};

// The garment at the moments that the method's figures show.
struct DressingStages {
  std::vector<Eigen::Vector3d> start;     // Panels in front of the body and behind it.
  std::vector<Eigen::Vector3d> merging;   // Half way onto the body; stitch lines run across it.
  std::vector<Eigen::Vector3d> stitched;  // Sewn; gravity has not acted yet.
  std::vector<Eigen::Vector3d> final;     // At rest, or as far as it came.
};

struct DressTopResult {
  DressingStages stages;  // Positions, one a particle of the cloth (unit: metre).
  DrapeReport report;
  int shoulder_point_count = 0;  // That condition (6) looked at; none where all shoulder points dropped to the arms.
};

// Puts a top on from the neck down (S40): places the panels apart with Cp before the front neck point, carries them
// onto the body along Z, sews them (equation 3), lets gravity act (equation 5) and ends by the finishing condition (6),
// every shoulder-sleeve point that rests on the shoulder lies on it, and the rest criterion. `body` gives landmarks and
// arm axes, `collider` is the same body without holes (RepairBody). Fails like PlaceTop(), SignedDistanceField::Build()
// and Drape(). `progress` gets 0 to 1 and may be empty.
Result<DressTopResult> DressTop(const ClothMesh& cloth, const Body& body, const TriangleMesh& collider,
                                const DressTopOptions& options, Executor& executor,
                                const std::function<void(double done)>& progress);

}  // namespace fitroom
