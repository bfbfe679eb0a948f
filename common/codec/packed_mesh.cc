#include "common/codec/packed_mesh.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include <meshoptimizer.h>

#include "common/codec/crc32c.h"
#include "common/codec/zstd.h"

namespace fitroom {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "FRMESH";
constexpr uint16_t kVersion = 1;
constexpr size_t kVertexSize = 3 * sizeof(float);

// As it lies at the front of the bytes.
struct Header {
  std::array<char, 6> magic{};
  uint16_t version = 0;
  uint32_t vertex_count = 0;
  uint32_t triangle_count = 0;
  uint32_t vertex_code_size = 0;
  uint32_t index_code_size = 0;
  uint32_t payload_size = 0;
  uint32_t checksum = 0;
};
static_assert(sizeof(Header) == 32);

Status Damaged(std::string_view what) {
  return DataLoss("PACKED_MESH_DAMAGED", "the packed mesh is damaged (" + std::string(what) + "); fetch it again");
}

uint32_t Checksum(const Header& header, std::string_view payload) {
  const std::string_view bytes(reinterpret_cast<const char*>(&header), offsetof(Header, checksum));
  return ExtendCrc32c(Crc32c(bytes), payload);
}

Result<std::vector<float>> RoundToFloat(const TriangleMesh& mesh) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = static_cast<float>(vertex[axis]);
      if (!std::isfinite(coordinate)) {
        return InvalidArgument("MESH_NOT_FINITE", "a coordinate is not finite; repair the mesh before packing it");
      }
      coordinates.push_back(coordinate);
    }
  }
  return coordinates;
}

// The smallest code that meshoptimizer makes: a block of at most 256 vertices takes 2 bits a group of 16 for each of
// its 12 byte planes; an index of a sequence takes a byte. The largest is the bound that it encodes into. A count
// beyond either is a lie.
bool CountsFitCode(const Header& header) {
  const uint64_t block_count = (uint64_t{header.vertex_count} + 255) / 256;
  const uint64_t index_count = 3 * uint64_t{header.triangle_count};
  const bool is_vertex_code_possible =
      header.vertex_count == 0
          ? header.vertex_code_size == 0
          : header.vertex_code_size >= (block_count - 1) * 12 * 4 &&
                header.vertex_code_size <= meshopt_encodeVertexBufferBound(header.vertex_count, kVertexSize);
  const bool is_index_code_possible =
      index_count == 0
          ? header.index_code_size == 0
          : header.index_code_size >= index_count &&
                header.index_code_size <= meshopt_encodeIndexSequenceBound(index_count, header.vertex_count);
  return is_vertex_code_possible && is_index_code_possible;
}

Result<Header> ReadHeader(std::string_view bytes) {
  Header header;
  if (bytes.size() < sizeof(Header)) return Damaged("it is cut short");
  std::memcpy(&header, bytes.data(), sizeof(Header));
  if (std::string_view(header.magic.data(), header.magic.size()) != kMagic) return Damaged("it does not begin as one");
  if (header.version != kVersion) {
    return Damaged("its version is " + std::to_string(header.version) + ", this program reads " +
                   std::to_string(kVersion));
  }
  const std::string_view payload = bytes.substr(sizeof(Header));
  if (payload.size() != header.payload_size) return Damaged("its size is wrong");
  if (Checksum(header, payload) != header.checksum) return Damaged("its checksum is wrong");
  if (!CountsFitCode(header)) return Damaged("it declares more than it can hold");
  return header;
}

Status DecodeVertices(std::string_view code, std::vector<Eigen::Vector3d>& vertices, size_t count) {
  if (count == 0) return code.empty() ? Status() : Damaged("it holds vertices but declares none");
  std::vector<float> coordinates(3 * count);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(code.data());
  if (meshopt_decodeVertexBuffer(coordinates.data(), count, kVertexSize, bytes, code.size()) != 0) {
    return Damaged("its vertices cannot be decoded");
  }
  vertices.reserve(count);
  for (size_t i = 0; i < coordinates.size(); i += 3) {
    const Eigen::Vector3f vertex(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    if (!vertex.allFinite()) return Damaged("a coordinate is not finite");
    vertices.emplace_back(vertex.cast<double>());
  }
  return Status();
}

Status DecodeTriangles(std::string_view code, uint32_t vertex_count, std::vector<Eigen::Vector3i>& triangles,
                       size_t count) {
  if (count == 0) return code.empty() ? Status() : Damaged("it holds triangles but declares none");
  std::vector<uint32_t> indices(3 * count);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(code.data());
  if (meshopt_decodeIndexSequence(indices.data(), indices.size(), sizeof(uint32_t), bytes, code.size()) != 0) {
    return Damaged("its triangles cannot be decoded");
  }
  triangles.reserve(count);
  for (size_t i = 0; i < indices.size(); i += 3) {
    if (indices[i] >= vertex_count || indices[i + 1] >= vertex_count || indices[i + 2] >= vertex_count) {
      return Damaged("a triangle names a vertex that is not there");
    }
    triangles.emplace_back(static_cast<int>(indices[i]), static_cast<int>(indices[i + 1]),
                           static_cast<int>(indices[i + 2]));
  }
  return Status();
}

}  // namespace

Result<std::string> PackMesh(const TriangleMesh& mesh) {
  FR_ASSIGN_OR_RETURN(const std::vector<float> coordinates, RoundToFloat(mesh));
  const size_t vertex_count = mesh.vertices.size();
  std::vector<uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto index = static_cast<uint32_t>(triangle[corner]);  // A negative one becomes too large.
      if (index >= vertex_count) {
        return InvalidArgument("INDEX_OUT_OF_RANGE",
                               "a triangle names a vertex that is not there; repair the mesh before packing it");
      }
      indices.push_back(index);
    }
  }

  Header header;
  std::string code;
  if (vertex_count > 0) {
    code.resize(meshopt_encodeVertexBufferBound(vertex_count, kVertexSize));
    code.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(code.data()), code.size(),
                                           coordinates.data(), vertex_count, kVertexSize));
  }
  const size_t vertex_code_size = code.size();
  if (!indices.empty()) {
    code.resize(vertex_code_size + meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
    auto* const start = reinterpret_cast<unsigned char*>(code.data()) + vertex_code_size;
    code.resize(vertex_code_size +
                meshopt_encodeIndexSequence(start, code.size() - vertex_code_size, indices.data(), indices.size()));
  }
  const std::string payload = ZstdCompress(code);
  if (code.size() > UINT32_MAX || payload.size() > UINT32_MAX) {
    return ResourceExhausted("MESH_TOO_LARGE", "the mesh packs to more than 4 GiB; thin it out");
  }
  std::memcpy(header.magic.data(), kMagic.data(), kMagic.size());
  header.version = kVersion;
  header.vertex_count = static_cast<uint32_t>(vertex_count);
  header.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
  header.vertex_code_size = static_cast<uint32_t>(vertex_code_size);
  header.index_code_size = static_cast<uint32_t>(code.size() - vertex_code_size);
  header.payload_size = static_cast<uint32_t>(payload.size());
  header.checksum = Checksum(header, payload);

  std::string packed(reinterpret_cast<const char*>(&header), sizeof(Header));
  packed += payload;
  return packed;
}

Result<PackedMeshCounts> ReadPackedMeshCounts(std::string_view bytes) {
  FR_ASSIGN_OR_RETURN(const Header header, ReadHeader(bytes));
  return PackedMeshCounts{header.vertex_count, header.triangle_count};
}

Result<TriangleMesh> UnpackMesh(std::string_view bytes, const PackedMeshLimits& limits) {
  FR_ASSIGN_OR_RETURN(const Header header, ReadHeader(bytes));
  if (header.vertex_count > limits.max_vertex_count || header.triangle_count > limits.max_triangle_count) {
    return ResourceExhausted("MESH_TOO_LARGE", "the packed mesh has " + std::to_string(header.vertex_count) +
                                                   " vertices and " + std::to_string(header.triangle_count) +
                                                   " triangles, more than is accepted");
  }
  const uint64_t code_size = uint64_t{header.vertex_code_size} + header.index_code_size;
  ZstdLimits zstd_limits;
  zstd_limits.max_size = static_cast<size_t>(code_size);
  const Result<std::string> code = ZstdDecompress(bytes.substr(sizeof(Header)), zstd_limits);
  if (!code.ok()) return Damaged(code.status().message());
  if (code->size() != code_size) return Damaged("its parts have the wrong size");

  const std::string_view all(*code);
  TriangleMesh mesh;
  FR_RETURN_IF_ERROR(DecodeVertices(all.substr(0, header.vertex_code_size), mesh.vertices, header.vertex_count));
  FR_RETURN_IF_ERROR(
      DecodeTriangles(all.substr(header.vertex_code_size), header.vertex_count, mesh.triangles, header.triangle_count));
  return mesh;
}

}  // namespace fitroom
