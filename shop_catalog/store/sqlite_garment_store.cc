#include "shop_catalog/store/sqlite_garment_store.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/sqlite/blob_table.h"
#include "common/store/columns.h"
#include "common/store/store_connections.h"
#include "common/store/upload_rows.h"
#include "shop_catalog/store/sqlite_garment_rows.h"

namespace fitroom::shop_catalog {
namespace {

using sqlite::Database;
using sqlite::Transaction;
using store::StoreConnections;

Status GarmentExists(const std::string& id) {
  return Status(StatusCode::kAlreadyExists, "GARMENT_EXISTS",
                "garments/" + id + " is published already; choose another id");
}

class SqliteGarmentStore final : public GarmentStore {
 public:
  explicit SqliteGarmentStore(std::unique_ptr<StoreConnections> connections) : connections_(std::move(connections)) {}

  Result<GarmentUpload> StartUpload(const GarmentUploadStatement& statement) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    const Status published = SelectGarment(*writer, statement.id).status();
    if (published.ok()) return GarmentExists(statement.id);
    if (published.code() != StatusCode::kNotFound) return published;
    Result<UploadRow> found = SelectUploadOfGarment(*writer, statement.id);
    if (found.ok()) {
      if (found->upload.statement == statement) return found->upload;
      return FailedPrecondition("UPLOAD_DIFFERS",
                                "another garment is being uploaded under this id; wait until it is "
                                "finished or dropped, or choose another id");
    }
    if (found.status().code() != StatusCode::kNotFound) return found.status();
    UploadRow row;
    row.upload = {.id = store::NewUploadId(), .statement = statement, .committed_sizes = {}};
    row.upload.committed_sizes.resize(statement.photos.size());
    for (size_t i = 0; i < statement.photos.size(); ++i) {
      FR_ASSIGN_OR_RETURN(const int64_t blob, sqlite::CreateBlob(*writer));
      row.blobs.push_back(blob);
    }
    FR_RETURN_IF_ERROR(InsertUpload(*writer, row));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return row.upload;
  }

  Result<GarmentUpload> FindUpload(std::string_view id) override {
    const StoreConnections::Held reader = connections_->Reader();
    FR_ASSIGN_OR_RETURN(UploadRow row, SelectUpload(*reader, id));
    return std::move(row.upload);
  }

  Result<int64_t> AppendToUpload(std::string_view id, GarmentSide side, int64_t offset,
                                 std::string_view bytes) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*writer, id));
    FR_ASSIGN_OR_RETURN(const size_t photo, PhotoOf(row, side));
    FR_ASSIGN_OR_RETURN(const int64_t end, store::AppendPlainRows(*writer, row.blobs[photo], offset, bytes));
    if (end > row.upload.statement.photos[photo].size) {
      return store::UploadTooLong();
    }
    FR_RETURN_IF_ERROR(store::TouchUpload(*writer, id));
    FR_RETURN_IF_ERROR(transaction.Commit());
    return end;
  }

  Result<std::string> ReadUpload(std::string_view id, GarmentSide side) override {
    const StoreConnections::Held reader = connections_->Reader();
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*reader, id));
    FR_ASSIGN_OR_RETURN(const size_t photo, PhotoOf(row, side));
    std::string bytes;
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlocks(*reader, row.blobs[photo], [&](const sqlite::BlobBlock& block) {
      bytes += store::AsText(block.stored);
      return Status();
    }));
    return bytes;
  }

  Status DropUpload(std::string_view id) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    const Result<UploadRow> row = SelectUpload(*writer, id);
    if (!row.ok()) return row.status().code() == StatusCode::kNotFound ? Status() : row.status();
    FR_RETURN_IF_ERROR(DeleteUpload(*writer, *row));
    return transaction.Commit();
  }

  Result<int64_t> DropUploadsBefore(int64_t unix_s) override {
    return store::DropStaleUploads(*connections_, unix_s, [this](std::string_view id) { return DropUpload(id); });
  }

  Status PublishGarment(std::string_view upload_id, const GarmentRecord& record,
                        std::span<const GarmentFile> files) override {
    const StoreConnections::Held writer = connections_->Writer();
    FR_ASSIGN_OR_RETURN(Transaction transaction, Transaction::Begin(*writer));
    FR_ASSIGN_OR_RETURN(const UploadRow row, SelectUpload(*writer, upload_id));
    for (size_t i = 0; i < row.blobs.size(); ++i) {
      if (row.upload.committed_sizes[i] == row.upload.statement.photos[i].size) continue;
      return store::UploadIncomplete();
    }
    FR_CHECK(record.garment.id == row.upload.statement.id);
    const Status published = SelectGarment(*writer, record.garment.id).status();
    if (published.ok()) return GarmentExists(record.garment.id);
    if (published.code() != StatusCode::kNotFound) return published;
    std::vector<int64_t> blobs;
    for (const GarmentImageRecord& image : record.images) {
      const auto file = std::find_if(files.begin(), files.end(),
                                     [&](const GarmentFile& candidate) { return candidate.name == image.file_name; });
      FR_CHECK(file != files.end() && std::ssize(file->bytes) == image.size);
      FR_ASSIGN_OR_RETURN(const int64_t blob, sqlite::CreateBlob(*writer));
      FR_RETURN_IF_ERROR(store::AppendPlainRows(*writer, blob, /*offset=*/0, file->bytes).status());
      blobs.push_back(blob);
    }
    FR_RETURN_IF_ERROR(InsertGarment(*writer, record, blobs));
    FR_RETURN_IF_ERROR(DeleteUpload(*writer, row));
    return transaction.Commit();
  }

  Result<GarmentRecord> FindGarment(std::string_view id) override {
    const StoreConnections::Held reader = connections_->Reader();
    return SelectGarment(*reader, id);
  }

  Result<std::vector<GarmentRecord>> ListGarments(std::string_view after, int limit) override {
    const StoreConnections::Held reader = connections_->Reader();
    return SelectGarments(*reader, after, limit);
  }

  Result<std::string> ReadImage(std::string_view garment, std::string_view image, int64_t offset) override {
    const StoreConnections::Held reader = connections_->Reader();
    FR_ASSIGN_OR_RETURN(const ImageRow row, SelectImage(*reader, garment, image));
    if (offset == row.size) return std::string();
    std::string bytes;
    FR_RETURN_IF_ERROR(sqlite::VisitBlobBlock(*reader, row.blob, offset, [&](const sqlite::BlobBlock& block) {
      bytes = store::AsText(block.stored).substr(static_cast<size_t>(offset - block.offset));
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

  static Status DeleteUpload(Database& database, const UploadRow& row) {
    FR_RETURN_IF_ERROR(store::DeleteUploadRow(database, row.upload.id));
    for (const int64_t blob : row.blobs) FR_RETURN_IF_ERROR(sqlite::DeleteBlob(database, blob));
    return Status();
  }

  std::unique_ptr<StoreConnections> connections_;
};

}  // namespace

Result<std::unique_ptr<GarmentStore>> OpenSqliteGarmentStore(const std::filesystem::path& folder) {
  const std::string first = std::string(sqlite::kBlobSchema) + kGarmentSchema;
  const std::array<const char*, 2> migrations = {first.c_str(), kShopStatementSchema};
  FR_ASSIGN_OR_RETURN(std::unique_ptr<StoreConnections> connections,
                      StoreConnections::Open(folder, "shop_catalog.sqlite", migrations));
  return std::unique_ptr<GarmentStore>(std::make_unique<SqliteGarmentStore>(std::move(connections)));
}

}  // namespace fitroom::shop_catalog
