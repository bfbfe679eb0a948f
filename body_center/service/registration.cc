#include "body_center/service/registration.h"

#include <ctime>
#include <future>
#include <utility>

#include "common/codec/hash.h"

namespace fitroom::body_center {
namespace {

Result<FrameOverrides> OverridesOf(const ScanUploadStatement& statement) {
  FrameOverrides overrides;
  if (!statement.up.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.up, ParseAxis(statement.up));
  }
  if (!statement.facing.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.facing, ParseAxis(statement.facing));
  }
  if (!statement.unit.empty()) {
    FR_ASSIGN_OR_RETURN(overrides.unit, ParseUnit(statement.unit));
  }
  return overrides;
}

ScanRecord MakeRecord(const ScanUploadStatement& statement, const AcceptedScan& accepted) {
  ScanRecord record;
  record.name = statement.name;
  record.file_name = statement.file_name;
  record.original_size = statement.size;
  record.original_hash = statement.hash;
  record.packed_mesh_size = static_cast<int64_t>(accepted.packed_mesh.size());
  record.packed_mesh_hash = accepted.packed_mesh_hash;
  record.register_time_unix_s = std::time(nullptr);
  record.vertex_count = std::ssize(accepted.body.mesh.vertices);
  record.triangle_count = std::ssize(accepted.body.mesh.triangles);
  record.frame = accepted.frame;
  record.landmarks = accepted.body.landmarks;
  record.arm_left = accepted.body.arm_left;
  record.arm_right = accepted.body.arm_right;
  record.leg_left = accepted.body.leg_left;
  record.leg_right = accepted.body.leg_right;
  record.measurements = accepted.body.measurements;
  return record;
}

// An acceptor's error that another try with the same bytes would meet again.
bool IsFinal(const Status& status) {
  return status.code() != StatusCode::kCancelled && status.code() != StatusCode::kUnavailable &&
         status.code() != StatusCode::kInternal;
}

// Lets the acceptor work on the upload's bytes while a second thread hashes them.
Result<AcceptedScan> CheckAndAccept(const ScanAcceptor& acceptor, const ScanUploadStatement& statement,
                                    std::string_view bytes, const std::function<bool()>& is_cancelled) {
  FR_ASSIGN_OR_RETURN(const FrameOverrides overrides, OverridesOf(statement));
  std::future<bool> is_intact = std::async(std::launch::async, [&] { return Blake2b(bytes) == statement.hash; });
  Result<AcceptedScan> accepted = acceptor(bytes, statement.file_name, overrides, is_cancelled);
  if (!is_intact.get()) {
    return DataLoss("UPLOAD_HASH_MISMATCH",
                    statement.file_name + ": what arrived is not the file that was stated; register it again");
  }
  return accepted;
}

}  // namespace

Result<ScanRecord> FinishRegistration(BodyStore& store, const ScanAcceptor& acceptor, std::string_view upload_id,
                                      const std::function<bool()>& is_cancelled) {
  FR_ASSIGN_OR_RETURN(const ScanUpload upload, store.FindUpload(upload_id));
  if (upload.committed_size != upload.statement.size) {
    return FailedPrecondition("UPLOAD_INCOMPLETE", "bytes are missing; ask how far the upload is and go on from there");
  }
  // What the store itself fails at is no fault of the scan: the upload stays.
  FR_ASSIGN_OR_RETURN(std::string bytes, store.ReadUpload(upload.id));
  const Result<AcceptedScan> accepted = CheckAndAccept(acceptor, upload.statement, bytes, is_cancelled);
  bytes = std::string();  // A scan is large, and publishing does not need it.
  if (!accepted.ok()) {
    if (IsFinal(accepted.status())) FR_RETURN_IF_ERROR(store.DropUpload(upload_id));
    return accepted.status();
  }
  ScanRecord record = MakeRecord(upload.statement, *accepted);
  FR_RETURN_IF_ERROR(store.PublishScan(upload_id, record, accepted->packed_mesh));
  return record;
}

}  // namespace fitroom::body_center
