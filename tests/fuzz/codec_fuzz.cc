// Any bytes through the unpackers. A packed mesh's checksum is put right first, as one who means harm would do.
#include <cstddef>
#include <cstdint>
#include <string>

#include "common/base/check.h"
#include "common/codec/crc32c.h"
#include "common/codec/packed_mesh.h"
#include "common/codec/zstd.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  fitroom::ZstdLimits limits;
  limits.max_size = size_t{1} << 22;
  const auto unpacked = fitroom::ZstdDecompress(bytes, limits);
  FR_CHECK(!unpacked.ok() || unpacked->size() <= limits.max_size);

  if (bytes.size() < 32) return 0;
  const auto put = [&](size_t offset, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<char>(value >> (8 * i));
  };
  put(24, static_cast<uint32_t>(bytes.size() - 32));
  put(28, fitroom::ExtendCrc32c(fitroom::Crc32c(std::string_view(bytes).substr(0, 28)),
                                std::string_view(bytes).substr(32)));
  const fitroom::Result<fitroom::TriangleMesh> mesh = fitroom::UnpackMesh(bytes);
  if (!mesh.ok()) return 0;
  const auto vertex_count = static_cast<int>(mesh->vertices.size());
  for (const Eigen::Vector3d& vertex : mesh->vertices) FR_CHECK(vertex.allFinite());
  for (const Eigen::Vector3i& triangle : mesh->triangles) {
    FR_CHECK(triangle.minCoeff() >= 0 && triangle.maxCoeff() < vertex_count);
  }
  return 0;
}
