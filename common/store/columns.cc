#include "common/store/columns.h"

#include <iterator>
#include <optional>

namespace fitroom::store {

Status Corrupt(const std::string& what) {
  return DataLoss("DATABASE_CORRUPT", "database: " + what + "; restore it from a backup");
}

std::span<const std::byte> HashBytes(const Hash256& hash) { return std::as_bytes(std::span(hash.bytes)); }

Result<Hash256> HashFromRow(const sqlite::Statement& row, int column) {
  const std::optional<Hash256> hash = Hash256::FromBytes(AsText(row.Bytes(column)));
  if (!hash) return Corrupt("a hash that is none");
  return *hash;
}

Result<int64_t> AppendPlainRows(sqlite::Database& database, int64_t blob, int64_t offset, std::string_view bytes) {
  for (size_t start = 0; start < bytes.size(); start += sqlite::kMaxBlobRowSize) {
    const std::string_view part = bytes.substr(start, sqlite::kMaxBlobRowSize);
    FR_RETURN_IF_ERROR(sqlite::AppendBlobBlock(database, blob, {offset, std::ssize(part), AsBytes(part)}));
    offset += std::ssize(part);
  }
  return offset;
}

}  // namespace fitroom::store
