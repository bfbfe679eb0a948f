#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/paper/paper_cloth.h"

namespace fitroom::paper {

// How equation (3)'s stitching force is read; the method leaves it and its end undefined.
enum class StitchingLaw {
  kPrinted,    // Every front particle and its back partner are pulled by a constant force: the figures' lines.
  kSeamsOnly,  // Only the seam pairs are, and no more once they approach at the closing speed.
};

struct StitchingOptions {
  StitchingLaw law = StitchingLaw::kPrinted;
  // Pull on a pair, per mass of a mean particle (unit: m/s^2). Below 5 a panel takes a second to arrive; above 50 it
  // stretches the cloth over the body while it is being sewn.
  double pull = 15.0;
  double closing_speed = 1.0;  // Of kSeamsOnly (unit: m/s).
  double closed_gap = 0.002;   // A seam pair that comes this near is sewn, the method says no number (unit: metre).
};

// Returns for every particle of the front panel the particle of the back panel that lies nearest to it across the
// garment, at rest: both seen along the axis in which a panel is thinnest. Seam pairs keep their own partners.
// INVALID_ARGUMENT (PANELS_UNKNOWN) where the mesh does not say which panel a particle belongs to.
Result<std::vector<SeamPair>> FindPartners(const ClothMesh& mesh);

// Equation (3)'s stitching force on the first of two particles at a distance of dp = p_a - p_b, with dv = v_a - v_b;
// the force on the second is the opposite. `force` is the constant (unit: newton). Zero for two particles on one place.
Eigen::Vector3d StitchingForce(const Eigen::Vector3d& dp, const Eigen::Vector3d& dv, double force,
                               const StitchingOptions& options);

// Says whether two particles met, that is came nearer than `gap`, while dp moved in a straight line from before to
// after.
bool Met(const Eigen::Vector3d& dp_before, const Eigen::Vector3d& dp_after, double gap);

}  // namespace fitroom::paper
