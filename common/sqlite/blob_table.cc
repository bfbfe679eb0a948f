#include "common/sqlite/blob_table.h"

#include <string>

namespace fitroom::sqlite {

const char kBlobSchema[] = R"sql(
CREATE TABLE blobs (
  blob_id INTEGER PRIMARY KEY AUTOINCREMENT,
  size_bytes INTEGER NOT NULL CHECK (size_bytes >= 0)
) STRICT;
CREATE TABLE blob_blocks (
  blob_id INTEGER NOT NULL REFERENCES blobs (blob_id) ON DELETE CASCADE,
  offset_bytes INTEGER NOT NULL CHECK (offset_bytes >= 0),
  size_bytes INTEGER NOT NULL CHECK (size_bytes > 0),
  stored BLOB NOT NULL,
  UNIQUE (blob_id, offset_bytes)
) STRICT;
)sql";

Result<int64_t> CreateBlob(Database& database) {
  FR_ASSIGN_OR_RETURN(Statement insert,
                      database.Prepare("INSERT INTO blobs (size_bytes) VALUES (0) RETURNING blob_id"));
  FR_ASSIGN_OR_RETURN(const bool has_row, insert.Step());
  if (!has_row) return Internal("DATABASE_ERROR", "database: a new blob got no id");
  return insert.Integer(0);
}

Status AppendBlobBlock(Database& database, int64_t blob, const BlobBlock& block) {
  if (block.stored.size() > kMaxBlobRowSize) return Internal("BLOB_ROW_TOO_LARGE", "database: a row over 1 MiB");
  FR_ASSIGN_OR_RETURN(Statement grow, database.Prepare("UPDATE blobs SET size_bytes = size_bytes + ?1 "
                                                       "WHERE blob_id = ?2 AND size_bytes = ?3"));
  FR_RETURN_IF_ERROR(grow.Bind(1, block.size).Bind(2, blob).Bind(3, block.offset).Run());
  if (database.changed_row_count() != 1) {
    return Status(StatusCode::kAborted, "UPLOAD_OFFSET_CONFLICT",
                  "the bytes do not start where the upload ends; ask how far it is and go on from there");
  }
  FR_ASSIGN_OR_RETURN(Statement insert,
                      database.Prepare("INSERT INTO blob_blocks (blob_id, offset_bytes, size_bytes, stored) "
                                       "VALUES (?1, ?2, ?3, ?4)"));
  return insert.Bind(1, blob).Bind(2, block.offset).Bind(3, block.size).Bind(4, block.stored).Run();
}

Result<int64_t> BlobSize(Database& database, int64_t blob) {
  FR_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT size_bytes FROM blobs WHERE blob_id = ?1"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, blob).Step());
  return has_row ? select.Integer(0) : 0;
}

Status VisitBlobBlock(Database& database, int64_t blob, int64_t offset,
                      const std::function<Status(const BlobBlock&)>& visit) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare("SELECT offset_bytes, size_bytes, stored FROM blob_blocks "
                                       "WHERE blob_id = ?1 AND offset_bytes <= ?2 ORDER BY offset_bytes DESC LIMIT 1"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, blob).Bind(2, offset).Step());
  if (!has_row || select.Integer(0) + select.Integer(1) <= offset) {
    return Status(StatusCode::kOutOfRange, "OFFSET_PAST_END", "there is no byte at offset " + std::to_string(offset));
  }
  return visit({select.Integer(0), select.Integer(1), select.Bytes(2)});
}

Status VisitBlobBlocks(Database& database, int64_t blob, const std::function<Status(const BlobBlock&)>& visit) {
  FR_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT offset_bytes, size_bytes, stored FROM blob_blocks "
                                                         "WHERE blob_id = ?1 ORDER BY offset_bytes"));
  select.Bind(1, blob);
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status();
    FR_RETURN_IF_ERROR(visit({select.Integer(0), select.Integer(1), select.Bytes(2)}));
  }
}

Status DeleteBlob(Database& database, int64_t blob) {
  FR_ASSIGN_OR_RETURN(Statement remove, database.Prepare("DELETE FROM blobs WHERE blob_id = ?1"));
  return remove.Bind(1, blob).Run();
}

}  // namespace fitroom::sqlite
