#include "common/sqlite/database.h"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include <sqlite3.h>

namespace fitroom::sqlite {
namespace {

// How long a connection waits for another one's lock (unit: millisecond).
constexpr int kBusyTimeoutMs = 5000;

Status ErrorFor(int code, const char* message) {
  const std::string text = std::string("database: ") + message;
  switch (code & 0xff) {
    case SQLITE_FULL:
      return ResourceExhausted("DISK_FULL", text + "; free some space, nothing was stored");
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return DataLoss("DATABASE_CORRUPT", text + "; restore it from a backup");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return Unavailable("DATABASE_BUSY", text + "; another process holds it");
    case SQLITE_CONSTRAINT:
      return Status(StatusCode::kAlreadyExists, "DATABASE_CONFLICT", text);
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return Unavailable("DATABASE_IO", text + "; look at the disk and at who owns the folder");
    default:
      return Internal("DATABASE_ERROR", text);
  }
}

Status ErrorOf(sqlite3* database) { return ErrorFor(sqlite3_extended_errcode(database), sqlite3_errmsg(database)); }

// Makes the file with narrow rights before the engine would make it with wide ones.
void CreatePrivately(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (fd >= 0) ::close(fd);
}

}  // namespace

void Database::Closer::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void Statement::Finalizer::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Result<Database> Database::Open(const std::filesystem::path& path, Access access) {
  const bool writes = access == Access::kReadWrite;
  if (writes) CreatePrivately(path);
  sqlite3* raw = nullptr;
  // Read-only connections too are opened for writing: a reader of a write-ahead log needs the shared memory file.
  const int code = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(raw);
  if (code != SQLITE_OK)
    return ErrorFor(code, raw != nullptr ? sqlite3_errmsg(raw) : "out of memory").At(path.string());
  sqlite3_extended_result_codes(raw, 1);
  sqlite3_busy_timeout(raw, kBusyTimeoutMs);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  if (!writes) {
    // SQLite 3.40 can lose a committed transaction when two connections checkpoint: readers never do.
    sqlite3_db_config(raw, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    FR_RETURN_IF_ERROR(database.Execute("PRAGMA wal_autocheckpoint=0; PRAGMA query_only=ON; PRAGMA cache_size=-4096"));
    return database;
  }
  // The page size must be set before the first page is written. Checkpoints come after 16 MiB of log. Changing to the
  // log takes a last rollback journal; EXTRA flushes the folder once that is removed, or a power cut much later could
  // bring it back and undo all.
  FR_RETURN_IF_ERROR(
      database.Execute("PRAGMA page_size=65536; PRAGMA secure_delete=ON; PRAGMA synchronous=EXTRA").At(path.string()));
  FR_ASSIGN_OR_RETURN(Statement journal, database.Prepare("PRAGMA journal_mode=WAL"));
  FR_ASSIGN_OR_RETURN(const bool has_row, journal.Step());
  if (!has_row || journal.Text(0) != "wal") {
    return FailedPrecondition("DATABASE_NO_WAL", path.string() + ": the file system cannot hold a write-ahead log");
  }
  journal.Reset();  // Only now the change is committed, still under EXTRA.
  FR_RETURN_IF_ERROR(database.Execute(
      "PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON; PRAGMA wal_autocheckpoint=256; PRAGMA cache_size=-8192"));
  return database;
}

Status Database::Execute(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) return ErrorOf(database_.get());
  return Status();
}

Result<Statement> Database::Prepare(std::string_view sql) {
  sqlite3_stmt* raw = nullptr;
  const int code = sqlite3_prepare_v3(database_.get(), sql.data(), static_cast<int>(sql.size()), 0, &raw, nullptr);
  if (code != SQLITE_OK) return ErrorOf(database_.get());
  return Statement(raw);
}

Result<int64_t> Database::UserVersion() {
  FR_ASSIGN_OR_RETURN(Statement statement, Prepare("PRAGMA user_version"));
  FR_ASSIGN_OR_RETURN(const bool has_row, statement.Step());
  return has_row ? statement.Integer(0) : 0;
}

Status Database::Migrate(std::span<const char* const> migrations) {
  FR_ASSIGN_OR_RETURN(const int64_t version, UserVersion());
  const int64_t newest = static_cast<int64_t>(migrations.size());
  if (version > newest) {
    return FailedPrecondition("SCHEMA_TOO_NEW", "database: written by a later version of this program (schema " +
                                                    std::to_string(version) + ", known " + std::to_string(newest) +
                                                    "); use that version");
  }
  for (int64_t step = version; step < newest; ++step) {
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*this));
    FR_RETURN_IF_ERROR(Execute(migrations[static_cast<size_t>(step)]));
    FR_RETURN_IF_ERROR(Execute(("PRAGMA user_version=" + std::to_string(step + 1)).c_str()));
    FR_RETURN_IF_ERROR(transaction.Commit());
  }
  return Status();
}

Status Database::Checkpoint() { return Execute("PRAGMA wal_checkpoint(TRUNCATE)"); }

int64_t Database::changed_row_count() const { return sqlite3_changes64(database_.get()); }

void Statement::Keep(int code) {
  if (bind_code_ == SQLITE_OK) bind_code_ = code;
}

Statement& Statement::Bind(int parameter, int64_t value) {
  Keep(sqlite3_bind_int64(statement_.get(), parameter, value));
  return *this;
}

Statement& Statement::Bind(int parameter, double value) {
  Keep(sqlite3_bind_double(statement_.get(), parameter, value));
  return *this;
}

Statement& Statement::Bind(int parameter, std::string_view text) {
  // A null pointer would bind NULL, and an empty view may have one.
  Keep(sqlite3_bind_text64(statement_.get(), parameter, text.empty() ? "" : text.data(), text.size(), SQLITE_STATIC,
                           SQLITE_UTF8));
  return *this;
}

Statement& Statement::Bind(int parameter, std::span<const std::byte> bytes) {
  Keep(bytes.empty() ? sqlite3_bind_zeroblob(statement_.get(), parameter, 0)
                     : sqlite3_bind_blob64(statement_.get(), parameter, bytes.data(), bytes.size(), SQLITE_STATIC));
  return *this;
}

Result<bool> Statement::Step() {
  if (bind_code_ != SQLITE_OK) return ErrorFor(bind_code_, sqlite3_errstr(bind_code_));
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return ErrorOf(sqlite3_db_handle(statement_.get()));
}

Status Statement::Run() {
  const Result<bool> stepped = Step();
  Reset();
  return stepped.status();
}

void Statement::Reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
  bind_code_ = SQLITE_OK;
}

int64_t Statement::Integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::Real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string Statement::Text(int column) const {
  const auto bytes = Bytes(column);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::span<const std::byte> Statement::Bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  if (data == nullptr) return {};
  return {static_cast<const std::byte*>(data), static_cast<size_t>(size)};
}

Result<Transaction> Transaction::Begin(Database& database) {
  FR_RETURN_IF_ERROR(database.Execute("BEGIN IMMEDIATE"));
  return Transaction(database);
}

Transaction::Transaction(Transaction&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}

Transaction::~Transaction() {
  // Fails only where the engine has rolled back by itself, which is what is wanted.
  if (database_ != nullptr) (void)database_->Execute("ROLLBACK");
}

Status Transaction::Commit() {
  FR_RETURN_IF_ERROR(database_->Execute("COMMIT"));
  database_ = nullptr;
  return Status();
}

}  // namespace fitroom::sqlite
