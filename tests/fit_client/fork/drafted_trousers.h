#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/garment/garment.h"

namespace fitroom::testing {

// Trousers drafted from a body's measures by one of three published ways, folded flat and photographed. Nothing here is
// shared with what rebuilds them. All in metres.
enum class DraftRule { kAldrich, kTitan, kGarmentCode };

struct DraftedBody {
  double hip = 0.96;
  double waist = 0.72;
  double rise = 0.28;           // From the waist down to the crotch, upright.
  double waist_to_hip = 0.206;  // Upright.
  double inseam = 0.72;         // Upright.
  double leg = 0.575;           // The thigh's girth.
  double crotch_length = 0.66;  // From the waist in front through the legs to the waist behind.
};

// One of the pieces, of the wearer's left: x outwards from the fork line, y up from the waist's side end.
struct DraftedPiece {
  std::vector<Eigen::Vector2d> centre;   // Waist's middle down to the fork.
  std::vector<Eigen::Vector2d> inseam;   // Fork down to the hem.
  std::vector<Eigen::Vector2d> outseam;  // Waist's side down to the hem.
};

struct DraftedTrousers {
  DraftedBody body;
  DraftedPiece front, back;
  // What was drafted: girths all round, lengths along the seams.
  double hip_girth = 0.0;
  double thigh_girth = 0.0;  // At the fork.
  double front_rise = 0.0;
  double back_rise = 0.0;
};

DraftedTrousers Draft(DraftRule rule, const DraftedBody& body);

// Folds the trousers flat along both outseams, keeping the girth at every height, the legs laid apart, the fork folded
// in, and photographs front, back and side-folded. Each point of the outline is off by up to `noise_px`.
Garment Photograph(const DraftedTrousers& trousers, double pixels_per_metre, double noise_px, unsigned seed);

}  // namespace fitroom::testing
