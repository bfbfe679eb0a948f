#pragma once

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// What was left out of a raw scan before anything was measured.
struct CleaningCounts {
  int merged_vertices = 0;         // At exactly the place of another one.
  int degenerate_triangles = 0;    // Without area, or with a vertex that is not a number.
  int duplicate_triangles = 0;     // The same three vertices as another one.
  int islands = 0;                 // Pieces that float beside the body.
  int unused_vertices = 0;         // Of no triangle that was kept.
  bool turned_inside_out = false;  // The triangles were clockwise seen from outside.
};

struct CleanedScan {
  TriangleMesh mesh;
  CleaningCounts counts;
};

// Returns the surfaces of a scan: vertices at one place merged, degenerate and duplicate triangles and floating islands
// dropped, triangles turned counter-clockwise seen from outside. Holes stay. INVALID_ARGUMENT NO_SURFACE where nothing
// with area is left, INDEX_OUT_OF_RANGE where a triangle names a vertex that does not exist.
Result<CleanedScan> CleanScan(const TriangleMesh& raw);

}  // namespace fitroom
