#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/scan_record/scan_record.h"

namespace fitroom::body_center {

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
  virtual Result<ScanUpload> StartUpload(const ScanUploadStatement& statement) = 0;

  // NOT_FOUND [UPLOAD_NOT_FOUND].
  virtual Result<ScanUpload> FindUpload(std::string_view id) = 0;

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
  virtual Status PublishScan(std::string_view upload_id, const ScanRecord& scan, std::string_view packed_mesh) = 0;

  // NOT_FOUND [SCAN_NOT_FOUND].
  virtual Result<ScanRecord> FindScan(const ScanName& name) = 0;

  // Returns at most `limit` scans behind `after` in the order of names; of one body, or of all if `body` is empty.
  virtual Result<std::vector<ScanRecord>> ListScans(std::string_view body, const ScanName& after, int limit) = 0;

  // Returns bytes of a scan from `offset` on: at least 1, at most what one row holds (1 MiB); none at the end.
  // NOT_FOUND [SCAN_NOT_FOUND]; OUT_OF_RANGE [OFFSET_PAST_END].
  virtual Result<std::string> ReadContent(const ScanName& name, ScanContent content, int64_t offset) = 0;
};

}  // namespace fitroom::body_center
