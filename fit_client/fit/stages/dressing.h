#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/progress.h"
#include "common/base/status.h"
#include "common/body/body.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/drape.h"
#include "fit_client/fit/stages/belt.h"
#include "fit_client/fit/stages/place_bottom.h"
#include "fit_client/fit/stages/start_pose.h"
#include "fit_client/fit/stages/worn_layers.h"

namespace fitroom {

// The garment at the moments that the method's figures show. Positions, one a particle of the cloth (unit: metre).
struct DressingStages {
  std::vector<Eigen::Vector3d> start;      // Panels in front of the body and behind it; a bottom's below the groin.
  std::vector<Eigen::Vector3d> merging;    // Half way onto the body; stitch lines run across it.
  std::vector<Eigen::Vector3d> stitched;   // Sewn; gravity has not acted yet.
  std::vector<Eigen::Vector3d> pulled_up;  // Bottoms only: the crotch meets the groin or the waist its height.
  std::vector<Eigen::Vector3d> belted;     // Bottoms only: the belt holds the waist.
  std::vector<Eigen::Vector3d> final;      // At rest, or as far as it came.
};

// What only a bottom has to say.
struct BottomOutcome {
  BeltMeasure belt;         // Before anything was held: the waist's size answer.
  double rise_short = 0.0;  // How much lower the waist sits than where the body is as narrow; 0: enough (unit: metre).
  PullEnd pull_end = PullEnd::kNotPulled;
  double outseam_residual = 0.0;       // Condition (11): sum |l - l0| / sum l0 (unit: 1).
  bool ended_by_outseams = false;      // Condition (11) held at rest; otherwise rest alone ended it.
  std::vector<std::string> sentences;  // "waist 6.0 cm too wide, belted", "rise short by 24 mm", ...
};

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

struct DressingOptions {
  StartPoseOptions top_pose;
  BottomPoseOptions bottom_pose;
  double field_pitch = 0.004;  // Of the signed distance fields of body and layers (unit: metre).
  DrapeOptions drape = JerseyDrapeOptions();
};

// A garment on a body.
struct Dressing {
  DressingStages stages;
  DrapeReport report;
  int shoulder_point_count = 0;              // Tops: that condition (6) looked at; none where all dropped to the arms.
  std::vector<std::string> shoulder_points;  // Their names.
  std::shared_ptr<const SignedDistanceField> field;  // What it was draped on: body and layers, around the garment.
  double yielding_below = 0.0;  // Room for worn tops that are not in the field because they yield (unit: metre).
  std::optional<BottomOutcome> bottom;
};

// What a garment is put on: the body with landmarks and limb axes, the same body without holes (RepairBody), and what
// is worn already, the innermost first. Refers to all of it.
struct DressedBody {
  const Body& body;
  const TriangleMesh& collider;
  std::span<const WornGarment> layers;
};

}  // namespace fitroom
