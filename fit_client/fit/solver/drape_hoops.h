#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// A point on an edge of the cloth: (1 - t) p + t q.
struct EdgePoint {
  int p = 0;  // Vertices of the mesh.
  int q = 0;
  double t = 0.0;

  Eigen::Vector3d In(std::span<const Eigen::Vector3d> positions) const {
    return (1.0 - t) * positions[static_cast<size_t>(p)] + t * positions[static_cast<size_t>(q)];
  }
};

// A line of the cloth's own that runs round the body and comes back to where it began: across each piece square to the
// garment's length (level at rest; on a sleeve square to the sleeve), from piece to piece where they are sewn. It
// begins in the middle of a piece of seam, between two neighbouring pairs, and ends on that seam's other side.
struct GarmentHoop {
  std::array<int, 2> pairs = {};  // Of ClothMesh::seams, the neighbours between which it begins.
  bool is_sleeve = false;
  double seam_length = 0.0;  // Between the two pairs at rest (unit: metre).
  double rest_length = 0.0;  // (unit: metre)
  Eigen::Vector3d rest_start = Eigen::Vector3d::Zero();
  std::vector<std::vector<EdgePoint>> parts;  // One a piece of cloth that it crosses, in order.

  // Returns the length of the cloth along the hoop; a gap between two pieces counts nothing (unit: metre).
  double ClothLength(std::span<const Eigen::Vector3d> positions) const;
};

// Returns the hoops of a garment, one a pair of neighbours on the seam that would give way round it: of a trunk the
// wearer's left side seam (a zip's place), of a leg its outseam, of a sleeve its underside. Lines that end at an
// opening, or come back more than two centimetres from their beginning, are no hoops. Empty where nothing is sewn.
std::vector<GarmentHoop> FindHoops(const ClothMesh& mesh);

}  // namespace fitroom
