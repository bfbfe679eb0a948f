#pragma once

#include <cstdint>
#include <string_view>

#include "common/base/status.h"

namespace fitroom::common::v1 {
class Chunk;
}

namespace fitroom::transfer {

// The largest piece of a stream (unit: byte).
inline constexpr size_t kMaxChunkSize = size_t{256} << 10;

// Fills a chunk with the bytes that begin at `offset`, and their checksum.
void FillChunk(int64_t offset, std::string_view data, fitroom::common::v1::Chunk& chunk);

// Checks a foreign chunk: INVALID_ARGUMENT [CHUNK_SIZE_INVALID], DATA_LOSS [CHUNK_CHECKSUM_MISMATCH], and ABORTED
// [UPLOAD_OFFSET_CONFLICT] if it does not begin at `expected_offset`.
Status CheckChunk(const fitroom::common::v1::Chunk& chunk, int64_t expected_offset);

}  // namespace fitroom::transfer
