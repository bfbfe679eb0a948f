#include "common/transfer/chunk.h"

#include <string>

#include "common/codec/crc32c.h"
#include "fitroom/common/v1/chunk.pb.h"

namespace fitroom::transfer {

void FillChunk(int64_t offset, std::string_view data, fitroom::common::v1::Chunk& chunk) {
  chunk.set_offset_bytes(offset);
  chunk.set_data(data.data(), data.size());
  chunk.set_crc32c(int64_t{Crc32c(data)});
}

Status CheckChunk(const fitroom::common::v1::Chunk& chunk, int64_t expected_offset) {
  if (chunk.data().empty() || chunk.data().size() > kMaxChunkSize) {
    return InvalidArgument("CHUNK_SIZE_INVALID",
                           "a chunk holds 1 to 262144 bytes, not " + std::to_string(chunk.data().size()));
  }
  if (chunk.crc32c() != int64_t{Crc32c(chunk.data())}) {
    return DataLoss("CHUNK_CHECKSUM_MISMATCH", "the chunk at offset " + std::to_string(chunk.offset_bytes()) +
                                                   " was damaged on its way; send it again");
  }
  if (chunk.offset_bytes() != expected_offset) {
    return Status(StatusCode::kAborted, "UPLOAD_OFFSET_CONFLICT",
                  "a chunk begins at " + std::to_string(chunk.offset_bytes()) + ", expected " +
                      std::to_string(expected_offset) + "; ask how far it is and go on from there");
  }
  return Status();
}

}  // namespace fitroom::transfer
