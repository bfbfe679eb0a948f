#pragma once

#include <functional>
#include <utility>

#include "common/rpc/server_call.h"
#include "common/transfer/chunk_collector.h"

namespace fitroom::transfer {

// One upload stream of a server. `Request` has a `chunk`, `Response` a `committed_size_bytes`; only the stream's first
// message names the upload.
template <typename Request, typename Response>
class UploadSink final : public rpc::MessageSink<Request> {
 public:
  // Finds the upload that the first message names.
  using Open = std::function<Result<OpenUpload>(const Request& first)>;
  // Says whether a message names an upload.
  using IsNamed = bool (*)(const Request& request);

  UploadSink(Open open, IsNamed is_named, rpc::ByteBudget& budget, size_t commit_size, Response* response)
      : open_(std::move(open)), is_named_(is_named), chunks_(budget, commit_size), response_(response) {}

  Result<int64_t> Accept(const Request& request) override {
    if (!chunks_.is_open()) {
      FR_ASSIGN_OR_RETURN(OpenUpload upload, open_(request));
      chunks_.Open(std::move(upload));
    } else if (is_named_(request)) {
      return InvalidArgument("UPLOAD_NAME_INVALID", "only the first message of a stream names the upload");
    }
    return chunks_.Accept(request.chunk());
  }

  Status Finish() override {
    if (!chunks_.is_open()) return InvalidArgument("UPLOAD_NAME_INVALID", "the stream named no upload");
    FR_RETURN_IF_ERROR(chunks_.Commit());
    response_->set_committed_size_bytes(chunks_.committed_size());
    return Status();
  }

  void Cut() override { (void)chunks_.Commit(); }

 private:
  const Open open_;
  const IsNamed is_named_;
  ChunkCollector chunks_;
  Response* const response_;
};

}  // namespace fitroom::transfer
