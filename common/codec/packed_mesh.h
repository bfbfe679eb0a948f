#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// What UnpackMesh() believes at most.
struct PackedMeshLimits {
  int64_t max_vertex_count = 8'000'000;
  int64_t max_triangle_count = 16'000'000;
};

// Packs a mesh for store and wire: vertices rounded to float32, everything else without loss. The order of vertices, of
// triangles and of each triangle's corners is kept. About 10 bytes a vertex of a laser scan, whose noise does not pack.
// INVALID_ARGUMENT if a coordinate is no finite float32 or an index is out of range.
//
// The bytes, all numbers little endian:
//   0  "FRMESH", version (2 bytes, now 1)
//   8  vertex count, triangle count (4 bytes each)
//  16  size of the vertex codec's and of the index codec's output (4 bytes each)
//  24  size of the payload (4 bytes), CRC-32C of bytes 0 to 27 and of the payload (4 bytes)
//  32  payload: one zstd frame of meshoptimizer's vertex buffer codec (12 bytes a vertex) and index sequence codec
Result<std::string> PackMesh(const TriangleMesh& mesh);

// Unpacks what PackMesh() made. Counts are checked before anything of their size is allocated; finiteness and indices
// are checked again after decoding. DATA_LOSS for bytes that are damaged, cut short or of another version,
// RESOURCE_EXHAUSTED where a limit is exceeded.
Result<TriangleMesh> UnpackMesh(std::string_view bytes, const PackedMeshLimits& limits = {});

// Returns the number of vertices and triangles that a packed mesh declares, without unpacking or believing it.
struct PackedMeshCounts {
  int64_t vertex_count = 0;
  int64_t triangle_count = 0;
};
Result<PackedMeshCounts> ReadPackedMeshCounts(std::string_view bytes);

}  // namespace fitroom
