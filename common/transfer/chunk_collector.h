#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/rpc/byte_budget.h"

namespace fitroom::common::v1 {
class Chunk;
}

namespace fitroom::transfer {

// An upload as one stream finds it.
struct OpenUpload {
  int64_t stated_size = 0;     // (unit: byte)
  int64_t committed_size = 0;  // Where the stream's first chunk must begin (unit: byte).
  // Makes bytes at an offset durable and returns the new committed size.
  std::function<Result<int64_t>(int64_t offset, std::string_view bytes)> append;
};

// Gathers the chunks of one stream and commits them in groups. One thread at a time.
class ChunkCollector {
 public:
  // `budget` is what all streams of a server may hold together; `commit_size` is what one gathers at most (unit: byte).
  ChunkCollector(rpc::ByteBudget& budget, size_t commit_size) : loan_(budget), commit_size_(commit_size) {}

  void Open(OpenUpload upload);
  bool is_open() const { return static_cast<bool>(upload_.append); }
  int64_t committed_size() const { return upload_.committed_size; }

  // Takes the next chunk and returns its size. Errors of CheckChunk(); OUT_OF_RANGE [UPLOAD_TOO_LONG]; those of
  // `append`. What came before a faulty chunk is committed.
  Result<int64_t> Accept(const fitroom::common::v1::Chunk& chunk);
  // Commits what is pending.
  Status Commit();

 private:
  int64_t NextOffset() const { return upload_.committed_size + static_cast<int64_t>(pending_.size()); }

  OpenUpload upload_;
  std::string pending_;
  rpc::ByteLoan loan_;
  const size_t commit_size_;
};

}  // namespace fitroom::transfer
