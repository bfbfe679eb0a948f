#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sqlite/database.h"

namespace fitroom::testing {

// The foreign keys of a database's tables.
struct ForeignKeys {
  int count = 0;
  std::vector<std::string>
      without_index;  // "table.column": no index begins with it, so a delete reads the whole table.
};

// Reads them from the engine's own description of the file.
inline Result<ForeignKeys> FindForeignKeys(const std::filesystem::path& path) {
  FR_ASSIGN_OR_RETURN(sqlite::Database database, sqlite::Database::Open(path, sqlite::Access::kReadWrite));
  FR_ASSIGN_OR_RETURN(
      sqlite::Statement select,
      database.Prepare(
          "SELECT tables.name || '.' || keys.\"from\", EXISTS (SELECT 1 FROM pragma_index_list(tables.name) "
          "AS indexes, pragma_index_info(indexes.name) AS columns WHERE columns.seqno = 0 AND "
          "columns.name = keys.\"from\") FROM sqlite_schema AS tables, "
          "pragma_foreign_key_list(tables.name) AS keys WHERE tables.type = 'table' ORDER BY 1"));
  ForeignKeys keys;
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return keys;
    ++keys.count;
    if (select.Integer(1) == 0) keys.without_index.push_back(select.Text(0));
  }
}

}  // namespace fitroom::testing
