#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/progress.h"
#include "common/base/status.h"
#include "common/scan_record/scan_record.h"

namespace fitroom::remote {

// One page of scans; an empty token ends the list.
struct ScanPage {
  std::vector<ScanRecord> scans;
  std::string next_page_token;
};

// Speaks to a body data center. Thread-safe. Every call has a deadline; calls that may be repeated are, with growing
// pauses. Beside the server's own errors (fitroom/body/v1/scan_service.proto) any call may return UNAVAILABLE
// [SERVER_UNAVAILABLE], [STREAM_CUT] or DEADLINE_EXCEEDED.
class BodyClient {
 public:
  // `address` is HOST:PORT. Connects with the first call. `attempt_count` is how often a call is tried in all.
  explicit BodyClient(const std::string& address, int attempt_count = 5);
  BodyClient(const BodyClient&) = delete;
  BodyClient& operator=(const BodyClient&) = delete;
  ~BodyClient();

  // Registers a whole file and returns the published scan. Goes on with an upload that an earlier call left, and after
  // a cut. A scan that is there already with the same hash is returned as it is. `file` must be what the statement
  // says.
  Result<ScanRecord> Register(const ScanUploadStatement& statement, std::string_view file,
                              const ProgressSink& progress);

  // The steps of Register().
  Result<ScanUpload> StartUpload(const ScanUploadStatement& statement);
  Result<ScanUpload> GetUpload(const ScanUpload& upload);
  // Sends `bytes` from `offset` on in one stream; returns what the center holds then.
  Result<int64_t> SendBytes(const ScanUpload& upload, int64_t offset, std::string_view bytes,
                            const std::function<void(int64_t sent)>& progress);
  Result<ScanRecord> FinishUpload(const ScanUpload& upload, const Hash256& hash);
  Status CancelUpload(const ScanUpload& upload);

  Result<ScanRecord> GetScan(const ScanName& name);
  // `body` empty: all bodies.
  Result<ScanPage> ListScans(std::string_view body, int page_size, const std::string& page_token);
  // Goes through all pages.
  Result<std::vector<ScanRecord>> ListAllScans(std::string_view body);

  // Hands the content from `offset` on to `sink`, piece by piece; goes on by itself after a cut. An error of `sink`
  // ends it. The hash of the whole is the caller's to check.
  Status Download(const ScanName& name, ScanContent content, int64_t offset,
                  const std::function<Status(std::string_view)>& sink);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fitroom::remote
