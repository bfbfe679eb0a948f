#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/codec/hash.h"
#include "common/sqlite/blob_table.h"
#include "common/sqlite/database.h"

// How bytes, hashes and blobs stand in the columns of a store.
namespace fitroom::store {

inline std::span<const std::byte> AsBytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}
inline std::string_view AsText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The error of a row that no program of ours has written: DATA_LOSS [DATABASE_CORRUPT].
Status Corrupt(const std::string& what);

// The bytes of a hash for binding; valid while the hash lives.
std::span<const std::byte> HashBytes(const Hash256& hash);
// Reads a column of 32 bytes; DATA_LOSS [DATABASE_CORRUPT] if it holds anything else.
Result<Hash256> HashFromRow(const sqlite::Statement& row, int column);

// Appends bytes as they are, in rows of at most 1 MiB, and returns the blob's new size. Errors of AppendBlobBlock().
Result<int64_t> AppendPlainRows(sqlite::Database& database, int64_t blob, int64_t offset, std::string_view bytes);

}  // namespace fitroom::store
