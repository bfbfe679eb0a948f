#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/status.h"
#include "common/scan_file/scan_file.h"
#include "common/scan_file/source_text.h"

namespace fitroom {

// Says whether all three coordinates are finite and at most 1e9 in size (a body in micrometres is below 1e7).
inline bool IsUsableCoordinate(const Eigen::Vector3d& point) {
  return std::abs(point.x()) <= 1e9 && std::abs(point.y()) <= 1e9 && std::abs(point.z()) <= 1e9;
}

// Collects a RawScan for a reader and keeps the limits: no count of a file is believed beyond them, and the memory of
// all arrays together stays below twice the file's size and a constant.
class ScanBuilder {
 public:
  ScanBuilder(const SourceText& source, const ReadScanLimits& limits);

  // Opens an object, which gets all vertices and triangles until EndObject().
  Status BeginObject(const char* position, std::string name);
  void EndObject();
  void RenameObject(std::string name) { scan_.objects.back().name = std::move(name); }

  // Each appends `count` places to its array: coordinates are NaN and indices -1 until the reader sets them.
  Status AppendVertices(const char* position, int64_t count);
  Status AppendTriangles(const char* position, int64_t count);
  Status AppendTextureVertices(const char* position, int64_t count);
  // Makes the texture indices of the `count` triangles from `first_triangle`.
  Status AppendTextureTriangles(const char* position, int64_t first_triangle, int64_t count);

  // Each makes room for `count` more without adding any.
  Status ReserveVertices(const char* position, int64_t count);
  Status ReserveTriangles(const char* position, int64_t count);
  Status ReserveTextureVertices(const char* position, int64_t count);
  // Accounts for memory that a reader itself is about to take (unit: byte).
  Status ReserveScratch(const char* position, int64_t bytes) { return Reserve(position, bytes); }

  Eigen::Vector3d* vertices() { return scan_.mesh.vertices.data(); }
  Eigen::Vector3i* triangles() { return scan_.mesh.triangles.data(); }
  Eigen::Vector2f* texture_vertices() { return scan_.texture_coordinates.data(); }
  Eigen::Vector3i* texture_triangles() { return scan_.texture_triangles.data(); }
  int32_t vertex_count() const { return static_cast<int32_t>(scan_.mesh.vertices.size()); }
  int32_t triangle_count() const { return static_cast<int32_t>(scan_.mesh.triangles.size()); }
  bool has_texture_triangles() const { return !scan_.texture_triangles.empty(); }
  int32_t texture_vertex_count() const { return static_cast<int32_t>(scan_.texture_coordinates.size()); }

  void AddComment(std::string_view comment);
  void SetTexturePath(std::string_view path) { scan_.texture_path = CleanText(path); }
  void SetEncoding(ScanEncoding encoding) { scan_.encoding = encoding; }
  void SetHasNormals() { scan_.has_normals = true; }

  // Errors on the three numbers of a vertex.
  Status MalformedCoordinates(const char* position) const;
  Status UnusableCoordinates(const char* position) const;

  // Checks that there is a mesh with every place filled and every index in range, and hands the scan over.
  Result<RawScan> Finish(ScanFormat format);

 private:
  Status Reserve(const char* position, int64_t bytes);
  template <typename T>
  Status ReserveIn(std::vector<T>& values, const char* position, int64_t count);

  const SourceText& source_;
  const ReadScanLimits& limits_;
  RawScan scan_;
  int64_t memory_left_ = 0;  // (unit: byte)
};

}  // namespace fitroom
