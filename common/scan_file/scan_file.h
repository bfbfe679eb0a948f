#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// The file formats that a scan may come in.
enum class ScanFormat { kAse, kPly, kObj };

// How the file's bytes carry it.
enum class ScanEncoding { kText, kUtf16LittleEndian, kUtf16BigEndian, kBinaryLittleEndian, kBinaryBigEndian };

// Returns "ASE", "PLY" or "OBJ".
std::string_view ScanFormatName(ScanFormat format);
// Returns, for example, "text" or "binary little endian".
std::string_view ScanEncodingName(ScanEncoding encoding);

// One named part of a scan file: a GEOMOBJECT of an ASE, an object or group of an OBJ, the whole of a PLY. The ranges
// are what the file lists under the name; a triangle of an OBJ may use vertices of another object.
struct ScanObject {
  std::string name;  // UTF-8 without control characters, at most 255 bytes; may be empty.
  int32_t first_vertex = 0;
  int32_t vertex_count = 0;
  int32_t first_triangle = 0;
  int32_t triangle_count = 0;
};

// A scan exactly as its file tells it, with all objects in one mesh: the file's own frame and unit, its own order of
// vertices and triangles. Nothing is welded, dropped or turned; which axis is up and what the unit is are not decided
// here. Every triangle index is in range and every coordinate finite and at most 1e9 in size.
struct RawScan {
  TriangleMesh mesh;  // (unit: the file's own)
  std::vector<ScanObject> objects;

  // Texture coordinates, v upwards, where the file has them; texture_triangles then holds for each triangle of the mesh
  // the three indices into texture_coordinates, or -1 three times for a triangle without.
  std::vector<Eigen::Vector2f> texture_coordinates;
  std::vector<Eigen::Vector3i> texture_triangles;
  bool has_texture_coordinates() const { return !texture_triangles.empty(); }

  bool has_normals = false;               // The file states normals; they are not kept.
  std::string texture_path;               // As written in the file, UTF-8; never opened.
  std::vector<std::string> comments;      // Comment lines of the head, at most 64; a unit may be told there.
  int32_t degenerate_triangle_count = 0;  // Triangles that name a vertex twice; they are kept.

  ScanFormat format = ScanFormat::kAse;
  ScanEncoding encoding = ScanEncoding::kText;
  bool is_compressed = false;  // The file was a zstd frame.
};

// What a reader refuses to exceed. Memory is bounded by twice the (unpacked) file's size and a constant besides.
struct ReadScanLimits {
  size_t max_file_size = size_t{512} << 20;  // After unpacking (unit: byte).
  int64_t max_vertex_count = 8'000'000;      // All objects together.
  int64_t max_triangle_count = 16'000'000;   // All objects together.
  int64_t max_object_count = 10'000;         // Objects with a mesh.
  double max_compression_ratio = 200.0;      // Unpacked by packed size of a zstd frame.
};

// Reads a scan from the bytes of a file. The format is recognised by content: ASE (3ds Max ASCII export), PLY (ascii,
// binary of both endians, triangle strips, Cyberware range grids) or OBJ; text also as UTF-16 or with a byte order
// mark; any of them inside one zstd frame. `file_name` is used in messages only.
// INVALID_ARGUMENT with file, line (or byte offset of a binary file) and remedy for bytes that are no whole scan;
// RESOURCE_EXHAUSTED where a limit is exceeded. A file cut short is an error, never half a mesh.
Result<RawScan> ReadScan(std::string_view bytes, std::string_view file_name, const ReadScanLimits& limits = {});

// Maps the file and reads it as ReadScan() does; also the errors of MappedFile::Open().
Result<RawScan> ReadScanFile(const std::filesystem::path& path, const ReadScanLimits& limits = {});

}  // namespace fitroom
