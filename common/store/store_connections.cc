#include "common/store/store_connections.h"

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "common/store/upload_rows.h"

namespace fitroom::store {

using sqlite::Database;

StoreConnections::StoreConnections(FolderLock lock, Database writer, Database reader)
    : lock_(std::move(lock)), writer_(std::move(writer)), reader_(std::move(reader)) {}

StoreConnections::~StoreConnections() { (void)writer_.Checkpoint(); }

Result<std::unique_ptr<StoreConnections>> StoreConnections::Open(const std::filesystem::path& folder,
                                                                 const std::filesystem::path& file_name,
                                                                 std::span<const char* const> migrations) {
  FR_ASSIGN_OR_RETURN(FolderLock lock, FolderLock::Take(folder));
  FR_ASSIGN_OR_RETURN(Database writer, Database::Open(folder / file_name, sqlite::Access::kReadWrite));
  FR_RETURN_IF_ERROR(writer.Migrate(migrations));
  FR_ASSIGN_OR_RETURN(Database reader, Database::Open(folder / file_name, sqlite::Access::kReadOnly));
  return std::unique_ptr<StoreConnections>(new StoreConnections(std::move(lock), std::move(writer), std::move(reader)));
}

Result<int64_t> DropStaleUploads(StoreConnections& connections, int64_t unix_s,
                                 const std::function<Status(std::string_view id)>& drop) {
  const auto find = [&] { return StaleUploads(*connections.Writer(), unix_s); };  // The mutex is free again after it.
  FR_ASSIGN_OR_RETURN(const std::vector<std::string> ids, find());
  for (const std::string& id : ids) FR_RETURN_IF_ERROR(drop(id));
  return std::ssize(ids);
}

}  // namespace fitroom::store
