#pragma once

#include <string>
#include <vector>

#include "common/sqlite/database.h"
#include "shop_catalog/store/garment_store.h"

// The rows of garments and of uploads. Used by the store alone.
namespace fitroom::shop_catalog {

// The tables beside those of the blobs; part of the first migration.
extern const char kGarmentSchema[];
// The second migration: what shops state of an upload, and the indexes that the first databases were made without.
extern const char kShopStatementSchema[];

// Inserts a garment with its images; `blobs` are theirs, in their order.
Status InsertGarment(sqlite::Database& database, const GarmentRecord& record, const std::vector<int64_t>& blobs);

// Returns the garment, or NOT_FOUND [GARMENT_NOT_FOUND].
Result<GarmentRecord> SelectGarment(sqlite::Database& database, std::string_view id);

// Returns up to `limit` garments behind `after`.
Result<std::vector<GarmentRecord>> SelectGarments(sqlite::Database& database, std::string_view after, int limit);

// Returns blob and size of an image, or NOT_FOUND [IMAGE_NOT_FOUND].
struct ImageRow {
  int64_t blob = 0;
  int64_t size = 0;  // (unit: byte)
};
Result<ImageRow> SelectImage(sqlite::Database& database, std::string_view garment, std::string_view image);

// An upload with the blobs of its photographs, in the order of the statement.
struct UploadRow {
  GarmentUpload upload;
  std::vector<int64_t> blobs;
};
Status InsertUpload(sqlite::Database& database, const UploadRow& row);
// Each NOT_FOUND [UPLOAD_NOT_FOUND].
Result<UploadRow> SelectUpload(sqlite::Database& database, std::string_view id);
Result<UploadRow> SelectUploadOfGarment(sqlite::Database& database, std::string_view garment);

}  // namespace fitroom::shop_catalog
