#include "common/transfer/chunk_collector.h"

#include <iterator>
#include <utility>

#include "common/transfer/chunk.h"
#include "fitroom/common/v1/chunk.pb.h"

namespace fitroom::transfer {

void ChunkCollector::Open(OpenUpload upload) { upload_ = std::move(upload); }

Result<int64_t> ChunkCollector::Accept(const fitroom::common::v1::Chunk& chunk) {
  const Status chunk_status = CheckChunk(chunk, NextOffset());
  if (!chunk_status.ok()) {
    FR_RETURN_IF_ERROR(Commit());  // What came before is whole.
    return chunk_status;
  }
  const int64_t size = std::ssize(chunk.data());
  if (NextOffset() + size > upload_.stated_size) {
    FR_RETURN_IF_ERROR(Commit());  // As above: the next stream goes on where this one was right.
    return Status(StatusCode::kOutOfRange, "UPLOAD_TOO_LONG", "more bytes than were stated at the start");
  }
  pending_ += chunk.data();
  // Where the budget of all streams is used up, a stream commits each chunk at once.
  const bool may_wait = loan_.TryTake(size);
  if (!may_wait || pending_.size() >= commit_size_) FR_RETURN_IF_ERROR(Commit());
  return size;
}

Status ChunkCollector::Commit() {
  if (pending_.empty()) return Status();
  const std::string bytes = std::exchange(pending_, {});
  loan_.GiveBackAll();
  FR_ASSIGN_OR_RETURN(upload_.committed_size, upload_.append(upload_.committed_size, bytes));
  return Status();
}

}  // namespace fitroom::transfer
