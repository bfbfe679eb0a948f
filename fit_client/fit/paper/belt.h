#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/paper/friction.h"

namespace fitroom::paper {

// A tape round the body at one height, from the centre front round over the body's left.
struct Belt {
  std::vector<Eigen::Vector3d> tape;  // Corners of the closed curve; the first is the centre front (unit: metre).
  double length = 0.0;                // Of the tape: the body's girth there (unit: metre).
  double height = 0.0;                // Along the frame's up (unit: metre).

  // Returns the place on the tape at arc length `distance` from the centre front, any number of times round.
  Eigen::Vector3d At(double distance) const;
};

// Lays a belt round `body` at `height`: cuts it, takes the outermost outline (the largest: trunk, not arms) and of it
// the convex hull, as a tape lies. FAILED_PRECONDITION (NO_BODY_AT_BELT) where the plane meets no body.
Result<Belt> LayBelt(const TriangleMesh& body, double height, const PaperFrame& frame);

// Returns the places of a garment's top edge on the belt. `rest_distances` are the arc lengths of its particles from
// the garment's centre front, round over the left, and `rest_length` is the whole edge: each particle gets the same
// part of the way round the body as it has round the garment.
std::vector<Eigen::Vector3d> PlaceOnBelt(const Belt& belt, std::span<const double> rest_distances, double rest_length);

}  // namespace fitroom::paper
