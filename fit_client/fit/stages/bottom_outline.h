#pragma once

#include <array>
#include <vector>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// A particle of the waist's edge and where it lies on it.
struct WaistParticle {
  int particle = 0;
  double place = 0.0;  // Way at rest from the centre front over the wearer's left; up to the whole edge (unit: metre).
};

// The seams of a bottom, found by what is sewn to what: it may be cut of two pieces (front and back) or of four (each
// side left and right). Chains run downwards, from the waist or from the crotch. Indices: 0 the wearer's left, 1 right.
struct BottomOutline {
  struct Chain {
    std::vector<int> particles;
    int panel = 0;  // 0 front, 1 back.
    int side = 0;   // 0 left, 1 right.
  };
  std::array<std::array<Chain, 2>, 2> outseams;    // [side][panel]: e1 to e2, e3 to e4.
  std::array<std::vector<Chain>, 2> inseams;       // [side]: from the crotch to the hem; none on a skirt.
  std::array<std::vector<Chain>, 2> centre_seams;  // [panel]: from the waist to the crotch, one a piece.
  std::vector<WaistParticle> waist;                // The whole edge, front and back, all pieces.
  double waist_girth = 0.0;                        // Length of the edge at rest (unit: metre).
  std::vector<int> crotch;                         // All particles at the point where the inseams begin.

  bool has_legs() const { return !crotch.empty(); }
};

// Finds the seams. INVALID_ARGUMENT (BOTTOM_OUTLINE) where the mesh is not sewn like a bottom or lacks the corners e1
// to e4.
Result<BottomOutline> FindBottomOutline(const ClothMesh& cloth);

}  // namespace fitroom
