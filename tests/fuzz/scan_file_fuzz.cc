// Any bytes: a scan that keeps the promises of its header, or an error that names the file.
#include <cstddef>
#include <cstdint>

#include "common/base/check.h"
#include "common/scan_file/ase_writer.h"
#include "common/scan_file/scan_file.h"

namespace {

void CheckPromises(const fitroom::RawScan& scan) {
  const auto vertex_count = static_cast<int>(scan.mesh.vertices.size());
  FR_CHECK(!scan.mesh.triangles.empty() && !scan.objects.empty());
  for (const Eigen::Vector3d& vertex : scan.mesh.vertices) FR_CHECK(vertex.cwiseAbs().maxCoeff() <= 1e9);
  for (const Eigen::Vector3i& triangle : scan.mesh.triangles) {
    FR_CHECK(triangle.minCoeff() >= 0 && triangle.maxCoeff() < vertex_count);
  }
  FR_CHECK(scan.texture_triangles.empty() || scan.texture_triangles.size() == scan.mesh.triangles.size());
  for (const Eigen::Vector3i& triangle : scan.texture_triangles) {
    FR_CHECK(triangle.minCoeff() >= -1 && triangle.maxCoeff() < static_cast<int>(scan.texture_coordinates.size()));
    FR_CHECK((triangle.array() == -1).all() || triangle.minCoeff() >= 0);
  }
  for (const Eigen::Vector2f& coordinates : scan.texture_coordinates) FR_CHECK(coordinates.allFinite());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const fitroom::Result<fitroom::RawScan> scan = fitroom::ReadScan(bytes, "fuzz");
  if (!scan.ok()) {
    FR_CHECK(scan.status().message().starts_with("fuzz:"));
    return 0;
  }
  CheckPromises(*scan);
  return 0;
}
