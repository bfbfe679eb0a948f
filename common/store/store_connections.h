#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>

#include "common/base/folder_lock.h"
#include "common/sqlite/database.h"

namespace fitroom::store {

// The connections of one store: a folder's lock, a writer and a reader, each behind its own mutex. Closing writes the
// log back into the database.
class StoreConnections {
 public:
  // Takes the folder, opens or makes `file_name` in it and brings its schema up to date. FAILED_PRECONDITION
  // [FOLDER_IN_USE], and the errors of Database::Open() and Database::Migrate().
  static Result<std::unique_ptr<StoreConnections>> Open(const std::filesystem::path& folder,
                                                        const std::filesystem::path& file_name,
                                                        std::span<const char* const> migrations);
  StoreConnections(const StoreConnections&) = delete;
  StoreConnections& operator=(const StoreConnections&) = delete;
  ~StoreConnections();

  // A connection and its mutex, held while this lives.
  class Held {
   public:
    Held(std::mutex& mutex, sqlite::Database& database) : guard_(mutex), database_(database) {}
    sqlite::Database& operator*() const { return database_; }

   private:
    std::lock_guard<std::mutex> guard_;
    sqlite::Database& database_;
  };
  Held Writer() { return Held(writer_mutex_, writer_); }
  Held Reader() { return Held(reader_mutex_, reader_); }

 private:
  StoreConnections(FolderLock lock, sqlite::Database writer, sqlite::Database reader);

  FolderLock lock_;
  std::mutex writer_mutex_;
  sqlite::Database writer_;  // The only connection that writes and checkpoints.
  std::mutex reader_mutex_;
  sqlite::Database reader_;
};

// Drops the uploads that got their last bytes before `unix_s`, each in a transaction of its own; returns how many.
Result<int64_t> DropStaleUploads(StoreConnections& connections, int64_t unix_s,
                                 const std::function<Status(std::string_view id)>& drop);

}  // namespace fitroom::store
