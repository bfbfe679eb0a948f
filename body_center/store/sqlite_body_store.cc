#include "body_center/store/sqlite_body_store.h"

#include <array>
#include <ctime>
#include <utility>

#include "body_center/store/sqlite_scan_rows.h"
#include "common/codec/zstd.h"
#include "common/sqlite/blob_table.h"
#include "common/store/columns.h"
#include "common/store/store_connections.h"
#include "common/store/upload_rows.h"

namespace fitroom::body_center {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;
using store::AsBytes;
using store::AsText;
using store::HashBytes;
using store::HashFromRow;
using store::StoreConnections;

// How much of an original goes into one frame (unit: byte): its frame fits a 1 MiB row even if it does not shrink.
constexpr size_t kOriginalBlockSize = size_t{960} << 10;
constexpr int kOriginalZstdLevel = 3;

// Conditions of SelectUpload().
constexpr char kById[] = "upload = ?1 AND ?2 = ''";
constexpr char kByName[] = "body = ?1 AND scan = ?2";

struct UploadRow {
  ScanUpload upload;
  int64_t blob = 0;
};

// A stretch of bytes in its stored form.
struct PackedBlock {
  int64_t size = 0;
  std::string stored;
};

Status ScanExists(const ScanName& name) {
  return Status(StatusCode::kAlreadyExists, "SCAN_EXISTS",
                ToString(name) + " is registered already; choose another scan id");
}

std::vector<PackedBlock> PackBlocks(std::string_view bytes) {
  std::vector<PackedBlock> blocks;
  for (size_t start = 0; start < bytes.size(); start += kOriginalBlockSize) {
    const std::string_view part = bytes.substr(start, kOriginalBlockSize);
    blocks.push_back({static_cast<int64_t>(part.size()), ZstdCompress(part, kOriginalZstdLevel)});
  }
  return blocks;
}

Result<std::string> UnpackBlock(const sqlite::BlobBlock& block) {
  const ZstdLimits limits{.max_size = kOriginalBlockSize, .max_ratio = 1e6};
  Result<std::string> bytes = ZstdDecompress(AsText(block.stored), limits);
  if (!bytes.ok() || std::ssize(*bytes) != block.size) {
    return DataLoss("DATABASE_CORRUPT", "database: a block of an original is damaged; restore it from a backup");
  }
  return bytes;
}

class SqliteBodyStore final : public BodyStore {
 public:
  explicit SqliteBodyStore(std::unique_ptr<StoreConnections> connections) : connections_(std::move(connections)) {}

  Result<ScanUpload> StartUpload(const ScanUploadStatement& statement) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    FR_RETURN_IF_ERROR(CheckNotPublished(*writer, statement.name));
    Result<UploadRow> found = SelectUpload(*writer, kByName, statement.name.body, statement.name.scan);
    if (found.ok()) {
      if (found->upload.statement == statement) return found->upload;
      return FailedPrecondition("UPLOAD_DIFFERS",
                                "another file is being uploaded under this name; wait until it is "
                                "finished or dropped, or choose another scan id");
    }
    if (found.status().code() != StatusCode::kNotFound) return found.status();
    ScanUpload upload{.id = store::NewUploadId(), .statement = statement};
    FR_ASSIGN_OR_RETURN(const int64_t blob, sqlite::CreateBlob(*writer));
    FR_RETURN_IF_ERROR(InsertUpload(*writer, upload, blob));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return upload;
  }

  Result<ScanUpload> FindUpload(std::string_view id) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(UploadRow row, SelectUpload(*writer, kById, id, ""));
    return std::move(row.upload);
  }

  Result<int64_t> AppendToUpload(std::string_view id, int64_t offset, std::string_view bytes) override {
    const std::vector<PackedBlock> blocks = PackBlocks(bytes);
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*writer, kById, id, ""));
    int64_t end = offset;
    for (const PackedBlock& block : blocks) {
      FR_RETURN_IF_ERROR(sqlite::AppendBlobBlock(*writer, row.blob, {end, block.size, AsBytes(block.stored)}));
      end += block.size;
    }
    if (end > row.upload.statement.size) {
      return store::UploadTooLong();
    }
    FR_RETURN_IF_ERROR(store::TouchUpload(*writer, id));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return end;
  }

  Result<std::string> ReadUpload(std::string_view id) override {
    const StoreConnections::Held reader = connections_->Reader();
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*reader, kById, id, ""));
    std::string bytes;
    bytes.reserve(static_cast<size_t>(row.upload.committed_size));
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlocks(*reader, row.blob, [&](const sqlite::BlobBlock& block) -> Status {
      FR_ASSIGN_OR_RETURN(const std::string part, UnpackBlock(block));
      bytes += part;
      return Status();
    }));
    return bytes;
  }

  Status DropUpload(std::string_view id) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    const Result<UploadRow> row = SelectUpload(*writer, kById, id, "");
    if (!row.ok()) return row.status().code() == StatusCode::kNotFound ? Status() : row.status();
    FR_RETURN_IF_ERROR(store::DeleteUploadRow(*writer, id));
    FR_RETURN_IF_ERROR(sqlite::DeleteBlob(*writer, row->blob));
    return transaction.Commit();
  }

  Result<int64_t> DropUploadsBefore(int64_t unix_s) override {
    return store::DropStaleUploads(*connections_, unix_s, [this](std::string_view id) { return DropUpload(id); });
  }

  Status PublishScan(std::string_view upload_id, const ScanRecord& scan, std::string_view packed_mesh) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*writer, kById, upload_id, ""));
    const ScanUploadStatement& statement = row.upload.statement;
    if (row.upload.committed_size != statement.size) {
      return store::UploadIncomplete();
    }
    FR_CHECK(scan.name == statement.name && scan.original_hash == statement.hash);
    FR_CHECK(scan.original_size == statement.size && scan.packed_mesh_size == std::ssize(packed_mesh));
    FR_RETURN_IF_ERROR(CheckNotPublished(*writer, scan.name));
    FR_ASSIGN_OR_RETURN(const int64_t mesh_blob, sqlite::CreateBlob(*writer));
    FR_RETURN_IF_ERROR(store::AppendPlainRows(*writer, mesh_blob, /*offset=*/0, packed_mesh).status());
    FR_RETURN_IF_ERROR(InsertScan(*writer, scan, row.blob, mesh_blob));
    FR_RETURN_IF_ERROR(store::DeleteUploadRow(*writer, upload_id));
    return transaction.Commit();
  }

  Result<ScanRecord> FindScan(const ScanName& name) override {
    const StoreConnections::Held reader = connections_->Reader();
    return SelectScan(*reader, name);
  }

  Result<std::vector<ScanRecord>> ListScans(std::string_view body, const ScanName& after, int limit) override {
    const StoreConnections::Held reader = connections_->Reader();
    return SelectScans(*reader, body, after, limit);
  }

  Result<std::string> ReadContent(const ScanName& name, ScanContent content, int64_t offset) override {
    const StoreConnections::Held reader = connections_->Reader();
    FR_ASSIGN_OR_RETURN(const ContentRow row, SelectContent(*reader, name, content));
    if (offset == row.size) return std::string();
    std::string bytes;
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlock(*reader, row.blob, offset, [&](const sqlite::BlobBlock& block) -> Status {
      if (content == ScanContent::kPackedMesh) {
        bytes = AsText(block.stored);
      } else {
        FR_ASSIGN_OR_RETURN(bytes, UnpackBlock(block));
      }
      bytes.erase(0, static_cast<size_t>(offset - block.offset));
      return Status();
    }));
    return bytes;
  }

 private:
  static Status CheckNotPublished(Database& database, const ScanName& name) {
    const Status found = SelectScan(database, name).status();
    if (found.ok()) return ScanExists(name);
    return found.code() == StatusCode::kNotFound ? Status() : found;
  }

  // `condition` is kById (the second key is empty) or kByName.
  static Result<UploadRow> SelectUpload(Database& database, const char* condition, std::string_view first,
                                        std::string_view second) {
    FR_ASSIGN_OR_RETURN(Statement select,
                        database.Prepare(std::string("SELECT upload, body, scan, file_name, uploads.size_bytes, "
                                                     "blake2b_256, up, facing, unit, blob_id, blobs.size_bytes "
                                                     "FROM uploads JOIN blobs USING (blob_id) WHERE ") +
                                         condition));
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, first).Bind(2, second).Step());
    if (!has_row) return store::UploadNotFound();
    UploadRow row;
    row.upload.id = select.Text(0);
    ScanUploadStatement& statement = row.upload.statement;
    statement.name = {select.Text(1), select.Text(2)};
    statement.file_name = select.Text(3);
    statement.size = select.Integer(4);
    FR_ASSIGN_OR_RETURN(statement.hash, HashFromRow(select, 5));
    statement.up = select.Text(6);
    statement.facing = select.Text(7);
    statement.unit = select.Text(8);
    row.blob = select.Integer(9);
    row.upload.committed_size = select.Integer(10);
    return row;
  }

  static Status InsertUpload(Database& database, const ScanUpload& upload, int64_t blob) {
    const ScanUploadStatement& statement = upload.statement;
    FR_ASSIGN_OR_RETURN(Statement insert,
                        database.Prepare("INSERT INTO uploads (upload, body, scan, file_name, size_bytes, blake2b_256, "
                                         "up, facing, unit, blob_id, touch_time_unix_s) "
                                         "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)"));
    insert.Bind(1, upload.id).Bind(2, statement.name.body).Bind(3, statement.name.scan).Bind(4, statement.file_name);
    insert.Bind(5, statement.size).Bind(6, HashBytes(statement.hash));
    insert.Bind(7, statement.up).Bind(8, statement.facing).Bind(9, statement.unit);
    return insert.Bind(10, blob).Bind(11, int64_t{std::time(nullptr)}).Run();
  }

  std::unique_ptr<StoreConnections> connections_;
};

}  // namespace

Result<std::unique_ptr<BodyStore>> OpenSqliteBodyStore(const std::filesystem::path& folder) {
  const std::string first = std::string(sqlite::kBlobSchema) + kScanSchema;
  const std::array<const char*, 2> migrations = {first.c_str(), kScanIndexSchema};
  FR_ASSIGN_OR_RETURN(std::unique_ptr<StoreConnections> connections,
                      StoreConnections::Open(folder, "body_center.sqlite", migrations));
  return std::unique_ptr<BodyStore>(std::make_unique<SqliteBodyStore>(std::move(connections)));
}

}  // namespace fitroom::body_center
