#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// What a cloth is, seen as a surface, once every seam is sewn.
struct ClothTopology {
  int particle_count = 0;
  int edge_count = 0;
  int triangle_count = 0;
  int component_count = 0;
  int boundary_loop_count = 0;  // Openings: see OpeningCount().
  bool is_manifold = false;     // Every edge has one or two triangles and no boundary touches itself.

  int euler_characteristic() const { return particle_count - edge_count + triangle_count; }
};

// Returns for every particle the smallest particle that it is sewn to, itself if to none.
std::vector<int> WeldedParticles(const ClothMesh& mesh);

// Counts the mesh with each seam pair welded to one particle.
ClothTopology ComputeWeldedTopology(const ClothMesh& mesh);

// Returns the Euler characteristic after welding: 2 - holes for a garment in one piece, -2 for a T-shirt.
int ComputeEulerCharacteristic(const ClothMesh& mesh);

// Returns how many holes a garment of the kind has once it is sewn: neck, hem and two sleeve ends or armholes: 4; a
// skirt 2; waist and two leg hems: 3.
int OpeningCount(GarmentKind kind);

// Returns the Euler characteristic of the sewn garment: a sphere with that many holes, 2 - OpeningCount(kind).
int ExpectedEulerCharacteristic(GarmentKind kind);

}  // namespace fitroom
