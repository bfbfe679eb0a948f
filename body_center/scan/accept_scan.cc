#include "body_center/scan/accept_scan.h"

#include <utility>

#include "common/body/analyse_scan.h"
#include "common/codec/hash.h"
#include "common/codec/packed_mesh.h"
#include "common/scan_file/scan_file.h"

namespace fitroom::body_center {
namespace {

// Of a scan that came packed (unit: byte); keeps the memory of one registration bounded.
constexpr size_t kMaxUnpackedSize = size_t{256} << 20;

Status Cancelled() {
  return Status(StatusCode::kCancelled, "CANCELLED", "the client is gone; register the scan again");
}

}  // namespace

Result<AcceptedScan> AcceptScan(std::string_view bytes, std::string_view file_name, const FrameOverrides& overrides,
                                const std::function<bool()>& is_cancelled) {
  const auto cancelled = [&] { return is_cancelled && is_cancelled(); };
  FR_ASSIGN_OR_RETURN(RawScan raw, ReadScan(bytes, file_name, {.max_file_size = kMaxUnpackedSize}));
  if (cancelled()) return Cancelled();
  Result<BodyAnalysis> analysis = AnalyseScan(raw.mesh, overrides);
  if (!analysis.ok()) return analysis.status().At(file_name);
  raw = RawScan();  // Its memory is needed for packing.
  if (cancelled()) return Cancelled();
  AcceptedScan accepted;
  accepted.frame = std::move(analysis->frame);
  accepted.body = std::move(analysis->body);
  FR_ASSIGN_OR_RETURN(accepted.packed_mesh, PackMesh(accepted.body.mesh));
  accepted.packed_mesh_hash = Blake2b(accepted.packed_mesh);
  return accepted;
}

}  // namespace fitroom::body_center
