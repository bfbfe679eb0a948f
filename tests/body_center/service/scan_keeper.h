#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/scan_record/scan_record.h"

namespace fitroom::testing {

// What both sides of the wire promise, so that one suite of tests can hold either to it: the store with its
// registration, and a client with a server.
class ScanKeeper {
 public:
  virtual ~ScanKeeper() = default;

  virtual Result<ScanUpload> Start(const ScanUploadStatement& statement) = 0;
  virtual Result<ScanUpload> Find(const ScanUpload& upload) = 0;
  virtual Result<int64_t> Append(const ScanUpload& upload, int64_t offset, std::string_view bytes) = 0;
  virtual Result<ScanRecord> Finish(const ScanUpload& upload) = 0;
  virtual Status Drop(const ScanUpload& upload) = 0;
  virtual Result<ScanRecord> Get(const ScanName& name) = 0;
  // All scans of a body, or of all bodies, gathered from pages of `page_size`.
  virtual Result<std::vector<ScanRecord>> List(std::string_view body, int page_size) = 0;
  // All bytes from `offset` to the end.
  virtual Result<std::string> Read(const ScanName& name, ScanContent content, int64_t offset) = 0;
  // Ends and starts again on the same folder.
  virtual void Reopen() = 0;
};

// Both begin with an empty folder of their own and accept what FakeAcceptor() does.
std::unique_ptr<ScanKeeper> MakeStoreKeeper();
std::unique_ptr<ScanKeeper> MakeWireKeeper();

}  // namespace fitroom::testing
