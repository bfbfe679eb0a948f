#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "common/base/status.h"
#include "common/sqlite/database.h"

namespace fitroom::sqlite {

// Big byte strings in rows of at most 1 MiB: the tables `blobs` and `blob_blocks` of a store's database. A block holds
// a stretch of the blob in a form that its owner chooses (as it is, or compressed); the table knows the stretch's place
// only. All calls act inside the caller's transaction.
inline constexpr size_t kMaxBlobRowSize = size_t{1} << 20;  // (unit: byte)

// The tables; part of a store's first migration.
extern const char kBlobSchema[];

// One stretch of a blob: bytes [offset, offset + size) in their stored form.
struct BlobBlock {
  int64_t offset = 0;                 // (unit: byte)
  int64_t size = 0;                   // (unit: byte)
  std::span<const std::byte> stored;  // Valid during the visit or until the statement's next step.
};

// Makes an empty blob and returns its id.
Result<int64_t> CreateBlob(Database& database);

// Appends a block behind the last one. ABORTED [UPLOAD_OFFSET_CONFLICT] if it does not start at the blob's end,
// which is how a second writer to the same blob is found out. INTERNAL for a row over the limit.
Status AppendBlobBlock(Database& database, int64_t blob, const BlobBlock& block);

// Returns how many bytes the blob holds; 0 for a blob that is not there.
Result<int64_t> BlobSize(Database& database, int64_t blob);

// Calls `visit` for the block that holds `offset`. OUT_OF_RANGE [OFFSET_PAST_END] if no block does.
Status VisitBlobBlock(Database& database, int64_t blob, int64_t offset,
                      const std::function<Status(const BlobBlock&)>& visit);

// Calls `visit` for all blocks in order.
Status VisitBlobBlocks(Database& database, int64_t blob, const std::function<Status(const BlobBlock&)>& visit);

// Removes a blob; the bytes are overwritten with zeros (secure_delete).
Status DeleteBlob(Database& database, int64_t blob);

}  // namespace fitroom::sqlite
