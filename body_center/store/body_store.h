#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/content_hash.h"
#include "common/base/status.h"
#include "common/body/body.h"
#include "common/body/body_frame.h"

namespace fitroom::body_center {

// Names a scan: `bodies/{body}/scans/{scan}`. Both ids are [a-z0-9-]{1,63}.
struct ScanName {
  std::string body;
  std::string scan;

  friend auto operator<=>(const ScanName&, const ScanName&) = default;
};

// What an operator states before the bytes of a scan are sent. The same statement names the same upload.
struct UploadStatement {
  ScanName name;
  std::string file_name;   // Without folders; for people.
  int64_t size = 0;        // Of the whole file (unit: byte).
  ContentHash hash;        // Of the whole file.
  std::string up, facing;  // Overrides as ParseAxis() takes them; empty: detected.
  std::string unit;        // Override as ParseUnit() takes it; empty: detected.

  friend bool operator==(const UploadStatement&, const UploadStatement&) = default;
};

// An upload that is under way.
struct Upload {
  std::string id;  // [a-z0-9-]{1,63}
  UploadStatement statement;
  int64_t committed_size = 0;  // Bytes held for good: where to go on.
};

// A published scan without its bytes.
struct StoredScan {
  ScanName name;
  std::string file_name;
  int64_t original_size = 0;  // (unit: byte)
  ContentHash original_hash;
  int64_t packed_mesh_size = 0;  // (unit: byte)
  ContentHash packed_mesh_hash;
  int64_t register_time_unix_s = 0;
  int64_t vertex_count = 0;
  int64_t triangle_count = 0;
  FrameReport frame;
  BodyLandmarks landmarks;
  LimbAxis arm_left, arm_right, leg_left, leg_right;
  BodyMeasurements measurements;
};

enum class ScanContent { kOriginal, kPackedMesh };

// Keeps scans and uploads durably. Thread-safe.
//
// An upload belongs to nobody's view: only PublishScan() makes a scan, all of it in one step. When a call returns OK
// its effect survives the death of the process and of the machine. When it returns an error nothing has changed. Beside
// the errors named below any call may return the engine's: RESOURCE_EXHAUSTED [DISK_FULL], DATA_LOSS
// [DATABASE_CORRUPT], UNAVAILABLE [DATABASE_IO].
class BodyStore {
 public:
  virtual ~BodyStore() = default;

  // Starts an upload, or finds the one with the same statement. ALREADY_EXISTS [SCAN_EXISTS];
  // FAILED_PRECONDITION [UPLOAD_DIFFERS] if another file is on its way under that name.
  virtual Result<Upload> StartUpload(const UploadStatement& statement) = 0;

  // NOT_FOUND [UPLOAD_NOT_FOUND].
  virtual Result<Upload> FindUpload(std::string_view id) = 0;

  // Appends bytes at `offset` and returns the new committed size. ABORTED [UPLOAD_OFFSET_CONFLICT] if `offset` is not
  // the committed size; OUT_OF_RANGE [UPLOAD_TOO_LONG] past the stated size; NOT_FOUND [UPLOAD_NOT_FOUND].
  virtual Result<int64_t> AppendToUpload(std::string_view id, int64_t offset, std::string_view bytes) = 0;

  // Returns all bytes that an upload holds. NOT_FOUND [UPLOAD_NOT_FOUND].
  virtual Result<std::string> ReadUpload(std::string_view id) = 0;

  // Drops an upload and its bytes; OK if there is none.
  virtual Status DropUpload(std::string_view id) = 0;

  // Drops uploads that got their last bytes before `unix_s`; returns how many.
  virtual Result<int64_t> DropUploadsBefore(int64_t unix_s) = 0;

  // Turns a complete upload into a published scan. `scan.name` and the original's size and hash must be the upload's.
  // NOT_FOUND [UPLOAD_NOT_FOUND]; FAILED_PRECONDITION [UPLOAD_INCOMPLETE]; ALREADY_EXISTS [SCAN_EXISTS].
  virtual Status PublishScan(std::string_view upload_id, const StoredScan& scan, std::string_view packed_mesh) = 0;

  // NOT_FOUND [SCAN_NOT_FOUND].
  virtual Result<StoredScan> FindScan(const ScanName& name) = 0;

  // Returns at most `limit` scans behind `after` in the order of names; of one body, or of all if `body` is empty.
  virtual Result<std::vector<StoredScan>> ListScans(std::string_view body, const ScanName& after, int limit) = 0;

  // Returns bytes of a scan from `offset` on: at least 1, at most what one row holds (1 MiB); none at the end.
  // NOT_FOUND [SCAN_NOT_FOUND]; OUT_OF_RANGE [OFFSET_PAST_END].
  virtual Result<std::string> ReadContent(const ScanName& name, ScanContent content, int64_t offset) = 0;
};

}  // namespace fitroom::body_center
