#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"

struct sqlite3;
struct sqlite3_stmt;

namespace fitroom::sqlite {

class Statement;

enum class Access {
  kReadWrite,  // The one connection that writes and checkpoints.
  kReadOnly,   // Reads beside it; never checkpoints.
};

// One connection to a database file. Not thread-safe: one thread at a time. Errors of the engine become
//   RESOURCE_EXHAUSTED [DISK_FULL]      no room left; nothing of the transaction is kept
//   DATA_LOSS [DATABASE_CORRUPT]        the file is damaged or is no database
//   UNAVAILABLE [DATABASE_BUSY]         another process holds it
//   ALREADY_EXISTS [DATABASE_CONFLICT]  a unique key is taken
//   UNAVAILABLE [DATABASE_IO]           the system refuses to read or write
class Database {
 public:
  // Opens `path`. For kReadWrite the file is made if it is not there (64 KiB pages, readable by its owner only) and set
  // to write-ahead logging, synchronous=FULL, secure_delete=ON.
  static Result<Database> Open(const std::filesystem::path& path, Access access);

  Database(Database&&) noexcept = default;
  Database& operator=(Database&&) noexcept = default;

  // Runs statements that return no rows and have no parameters.
  Status Execute(const char* sql);
  // Compiles one statement; it must not outlive the connection.
  Result<Statement> Prepare(std::string_view sql);
  // Brings the schema to version `migrations.size()`: runs the steps behind `PRAGMA user_version`, each in one
  // transaction. FAILED_PRECONDITION [SCHEMA_TOO_NEW] if the file was written by a later program.
  Status Migrate(std::span<const char* const> migrations);
  // Writes the log back into the database file and truncates it.
  Status Checkpoint();
  // Rows that the last statement changed.
  int64_t changed_row_count() const;

 private:
  friend class Statement;
  struct Closer {
    void operator()(sqlite3* database) const;
  };
  explicit Database(sqlite3* database) : database_(database) {}
  Result<int64_t> UserVersion();

  std::unique_ptr<sqlite3, Closer> database_;
};

// A prepared statement. Parameters count from 1, columns from 0. Bound text and bytes must live until Reset().
class Statement {
 public:
  Statement& Bind(int parameter, int64_t value);
  Statement& Bind(int parameter, double value);
  Statement& Bind(int parameter, std::string_view text);
  Statement& Bind(int parameter, std::span<const std::byte> bytes);

  // Goes to the next row: true if there is one, false at the end.
  Result<bool> Step();
  // Runs a statement that returns no rows, and resets it.
  Status Run();
  // Makes the statement ready for another run; bindings are dropped.
  void Reset();

  int64_t Integer(int column) const;
  double Real(int column) const;
  std::string Text(int column) const;
  // Valid until the next Step() or Reset().
  std::span<const std::byte> Bytes(int column) const;

 private:
  friend class Database;
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}
  void Keep(int code);

  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  int bind_code_ = 0;  // The first error of a Bind(); reported by Step().
};

// A write transaction that rolls back unless it is committed.
class Transaction {
 public:
  // Begins at once as a writer. The database must outlive the transaction.
  static Result<Transaction> Begin(Database& database);
  Transaction(Transaction&& other) noexcept;
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  // Makes all of it durable. On failure nothing of it is kept.
  Status Commit();

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;
};

}  // namespace fitroom::sqlite
