#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "common/rpc/server_call.h"
#include "common/transfer/chunk.h"

namespace fitroom::transfer {

// One download stream of a server: chunks out of a store's rows. `Request` has an `offset_bytes`, `Response` a `chunk`.
template <typename Request, typename Response>
class DownloadSource final : public rpc::MessageSource<Response> {
 public:
  // Returns the bytes from an offset on, at least 1; none at the end.
  using Read = std::function<Result<std::string>(int64_t offset)>;
  // Checks the names of a request and says how to read what it asks for.
  using Open = std::function<Result<Read>(const Request& request)>;

  DownloadSource(const Request& request, Open open) : request_(request), open_(std::move(open)) {}

  Result<int64_t> Next(Response& response) override {
    if (used_ == row_.size()) FR_RETURN_IF_ERROR(LoadRow());
    if (row_.empty()) return 0;
    const std::string_view piece = std::string_view(row_).substr(used_, kMaxChunkSize);
    FillChunk(offset_, piece, *response.mutable_chunk());
    used_ += piece.size();
    offset_ += std::ssize(piece);
    return std::ssize(piece);
  }

 private:
  Status LoadRow() {
    if (!read_) {
      FR_ASSIGN_OR_RETURN(read_, open_(request_));
      offset_ = request_.offset_bytes();
      if (offset_ < 0) return Status(StatusCode::kOutOfRange, "OFFSET_PAST_END", "offset_bytes: below 0");
    }
    used_ = 0;
    FR_ASSIGN_OR_RETURN(row_, read_(offset_));
    return Status();
  }

  const Request request_;
  const Open open_;
  Read read_;
  int64_t offset_ = 0;
  std::string row_;
  size_t used_ = 0;
};

}  // namespace fitroom::transfer
