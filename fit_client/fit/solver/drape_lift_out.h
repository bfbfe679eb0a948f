#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_model.h"

namespace fitroom {

// Signed distance that everything is to have in the end (unit: metre).
inline constexpr double kLiftedDistance = 2e-4;

// Puts what a crease of the body or of a layer holds on its surface or just below it a little outside: particles, and
// the edge middles and triangle centres between particles that are outside themselves, as where an edge lies across a
// ridge. Those move their corners, one sample after the other. What is farther from the body than kLiftedDistance stays
// where it is.
// Where two surfaces leave no room, the way out of one leads into the other: later rounds follow the coarser field out
// of the crevice between them, and of all rounds the places are returned that left least to go, which may be `places`
// themselves. `places` holds one place a particle (unit: metre).
std::vector<Eigen::Vector3d> LiftOut(const ClothModel& model, const SignedDistanceField& body,
                                     std::vector<Eigen::Vector3d> places);

}  // namespace fitroom
