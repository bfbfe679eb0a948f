#pragma once

#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/collision/signed_distance_field.h"

namespace fitroom {

// Moves places that are nearer to the body than `clearance`, or in it, out along the distance's gradient, by at most
// 3 cm. Metres, body frame.
void PushOut(const SignedDistanceField& field, double clearance, std::vector<Eigen::Vector3d>& places);

// Returns the place at `distance` from the body (unit: metre) that is found along the gradient from `place`, or as near
// to it as the gradient leads.
Eigen::Vector3d PlaceAtDistance(const SignedDistanceField& field, Eigen::Vector3d place, double distance);

}  // namespace fitroom
