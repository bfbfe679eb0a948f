#include "shop_catalog/store/sqlite_garment_store.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <mutex>
#include <random>
#include <utility>

#include "common/base/folder_lock.h"
#include "common/sqlite/blob_table.h"
#include "common/sqlite/database.h"
#include "shop_catalog/store/sqlite_garment_rows.h"

namespace fitroom::shop_catalog {
namespace {

using sqlite::Database;
using sqlite::Statement;
using sqlite::Transaction;

std::string NewUploadId() {
  std::random_device source;
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%08x%08x%08x%08x", source(), source(), source(), source());
  return text.data();
}

std::span<const std::byte> AsBytes(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }
std::string_view AsText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Status GarmentExists(const std::string& id) {
  return Status(StatusCode::kAlreadyExists, "GARMENT_EXISTS",
                "garments/" + id + " is published already; choose another id");
}

// Appends bytes to a blob in rows of at most 1 MiB and returns the blob's new size.
Result<int64_t> AppendRows(Database& database, int64_t blob, int64_t offset, std::string_view bytes) {
  for (size_t start = 0; start < bytes.size(); start += sqlite::kMaxBlobRowSize) {
    const std::string_view part = bytes.substr(start, sqlite::kMaxBlobRowSize);
    FR_RETURN_IF_ERROR(sqlite::AppendBlobBlock(database, blob, {offset, std::ssize(part), AsBytes(part)}));
    offset += std::ssize(part);
  }
  return offset;
}

class SqliteGarmentStore final : public GarmentStore {
 public:
  SqliteGarmentStore(FolderLock lock, Database writer, Database reader)
      : lock_(std::move(lock)), writer_(std::move(writer)), reader_(std::move(reader)) {}

  ~SqliteGarmentStore() override { (void)writer_.Checkpoint(); }

  Result<GarmentUpload> StartUpload(const GarmentUploadStatement& statement) override {
    const std::lock_guard guard(writer_mutex_);
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(writer_));
    const Status published = SelectGarment(writer_, statement.id).status();
    if (published.ok()) return GarmentExists(statement.id);
    if (published.code() != StatusCode::kNotFound) return published;
    Result<UploadRow> found = SelectUploadOfGarment(writer_, statement.id);
    if (found.ok()) {
      if (found->upload.statement == statement) return found->upload;
      return FailedPrecondition("UPLOAD_DIFFERS",
                                "another garment is being uploaded under this id; wait until it is "
                                "finished or dropped, or choose another id");
    }
    if (found.status().code() != StatusCode::kNotFound) return found.status();
    UploadRow row;
    row.upload = {.id = NewUploadId(), .statement = statement, .committed_sizes = {}};
    row.upload.committed_sizes.resize(statement.photos.size());
    for (size_t i = 0; i < statement.photos.size(); ++i) {
      FR_ASSIGN_OR_RETURN(const int64_t blob, sqlite::CreateBlob(writer_));
      row.blobs.push_back(blob);
    }
    FR_RETURN_IF_ERROR(InsertUpload(writer_, row));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return row.upload;
  }

  Result<GarmentUpload> FindUpload(std::string_view id) override {
    const std::lock_guard guard(reader_mutex_);
    FR_ASSIGN_OR_RETURN(UploadRow row, SelectUpload(reader_, id));
    return std::move(row.upload);
  }

  Result<int64_t> AppendToUpload(std::string_view id, GarmentSide side, int64_t offset,
                                 std::string_view bytes) override {
    const std::lock_guard guard(writer_mutex_);
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(writer_));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(writer_, id));
    FR_ASSIGN_OR_RETURN(const size_t photo, PhotoOf(row, side));
    FR_ASSIGN_OR_RETURN(const int64_t end, AppendRows(writer_, row.blobs[photo], offset, bytes));
    if (end > row.upload.statement.photos[photo].size) {
      return Status(StatusCode::kOutOfRange, "UPLOAD_TOO_LONG", "more bytes than were stated at the start");
    }
    FR_RETURN_IF_ERROR(TouchUpload(writer_, id));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return end;
  }

  Result<std::string> ReadUpload(std::string_view id, GarmentSide side) override {
    const std::lock_guard guard(reader_mutex_);
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(reader_, id));
    FR_ASSIGN_OR_RETURN(const size_t photo, PhotoOf(row, side));
    std::string bytes;
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlocks(reader_, row.blobs[photo], [&](const sqlite::BlobBlock& block) {
      bytes += AsText(block.stored);
      return Status();
    }));
    return bytes;
  }

  Status DropUpload(std::string_view id) override {
    const std::lock_guard guard(writer_mutex_);
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(writer_));
    const Result<UploadRow> row = SelectUpload(writer_, id);
    if (!row.ok()) return row.status().code() == StatusCode::kNotFound ? Status() : row.status();
    FR_RETURN_IF_ERROR(DeleteUpload(*row));
    return transaction.Commit();
  }

  Result<int64_t> DropUploadsBefore(int64_t unix_s) override {
    std::vector<std::string> ids;
    {
      const std::lock_guard guard(writer_mutex_);
      FR_ASSIGN_OR_RETURN(Statement select, writer_.Prepare("SELECT upload FROM uploads WHERE touch_time_unix_s < ?1"));
      select.Bind(1, unix_s);
      for (;;) {
        FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
        if (!has_row) break;
        ids.push_back(select.Text(0));
      }
    }
    for (const std::string& id : ids) FR_RETURN_IF_ERROR(DropUpload(id));
    return std::ssize(ids);
  }

  Status PublishGarment(std::string_view upload_id, const GarmentRecord& record,
                        std::span<const GarmentFile> files) override {
    const std::lock_guard guard(writer_mutex_);
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(writer_));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(writer_, upload_id));
    for (size_t i = 0; i < row.blobs.size(); ++i) {
      if (row.upload.committed_sizes[i] == row.upload.statement.photos[i].size) continue;
      return FailedPrecondition("UPLOAD_INCOMPLETE",
                                "bytes are missing; ask how far the upload is and go on from there");
    }
    FR_CHECK(record.garment.id == row.upload.statement.id);
    const Status published = SelectGarment(writer_, record.garment.id).status();
    if (published.ok()) return GarmentExists(record.garment.id);
    if (published.code() != StatusCode::kNotFound) return published;
    std::vector<int64_t> blobs;
    for (const GarmentImageRecord& image : record.images) {
      const auto file = std::find_if(files.begin(), files.end(),
                                     [&](const GarmentFile& candidate) { return candidate.name == image.file_name; });
      FR_CHECK(file != files.end() && std::ssize(file->bytes) == image.size);
      FR_ASSIGN_OR_RETURN(const int64_t blob, sqlite::CreateBlob(writer_));
      FR_RETURN_IF_ERROR(AppendRows(writer_, blob, /*offset=*/0, file->bytes).status());
      blobs.push_back(blob);
    }
    FR_RETURN_IF_ERROR(InsertGarment(writer_, record, blobs));
    FR_RETURN_IF_ERROR(DeleteUpload(row));
    return transaction.Commit();
  }

  Result<GarmentRecord> FindGarment(std::string_view id) override {
    const std::lock_guard guard(reader_mutex_);
    return SelectGarment(reader_, id);
  }

  Result<std::vector<GarmentRecord>> ListGarments(std::string_view after, int limit) override {
    const std::lock_guard guard(reader_mutex_);
    return SelectGarments(reader_, after, limit);
  }

  Result<std::string> ReadImage(std::string_view garment, std::string_view image, int64_t offset) override {
    const std::lock_guard guard(reader_mutex_);
    FR_ASSIGN_OR_RETURN(const ImageRow row, SelectImage(reader_, garment, image));
    if (offset == row.size) return std::string();
    std::string bytes;
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlock(reader_, row.blob, offset, [&](const sqlite::BlobBlock& block) {
      bytes = AsText(block.stored).substr(static_cast<size_t>(offset - block.offset));
      return Status();
    }));
    return bytes;
  }

 private:
  static Result<size_t> PhotoOf(const UploadRow& row, GarmentSide side) {
    const std::optional<size_t> photo = FindPhoto(row.upload.statement, side);
    if (!photo) return InvalidArgument("PHOTO_NOT_STATED", "no photograph of that side was stated at the start");
    return *photo;
  }

  Status DeleteUpload(const UploadRow& row) {
    FR_RETURN_IF_ERROR(DeleteUploadRows(writer_, row.upload.id));
    for (const int64_t blob : row.blobs) FR_RETURN_IF_ERROR(sqlite::DeleteBlob(writer_, blob));
    return Status();
  }

  FolderLock lock_;
  std::mutex writer_mutex_;
  Database writer_;  // The only connection that writes and checkpoints.
  std::mutex reader_mutex_;
  Database reader_;
};

}  // namespace

Result<std::unique_ptr<GarmentStore>> OpenSqliteGarmentStore(const std::filesystem::path& folder) {
  FR_ASSIGN_OR_RETURN(FolderLock lock, FolderLock::Take(folder));
  const std::filesystem::path path = folder / "shop_catalog.sqlite";
  FR_ASSIGN_OR_RETURN(Database writer, Database::Open(path, sqlite::Access::kReadWrite));
  const std::string first = std::string(sqlite::kBlobSchema) + kGarmentSchema;
  const std::array<const char*, 2> migrations = {first.c_str(), kShopStatementSchema};
  FR_RETURN_IF_ERROR(writer.Migrate(migrations));
  FR_ASSIGN_OR_RETURN(Database reader, Database::Open(path, sqlite::Access::kReadOnly));
  return std::unique_ptr<GarmentStore>(
      std::make_unique<SqliteGarmentStore>(std::move(lock), std::move(writer), std::move(reader)));
}

}  // namespace fitroom::shop_catalog
