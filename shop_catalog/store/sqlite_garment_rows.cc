#include "shop_catalog/store/sqlite_garment_rows.h"

#include <ctime>
#include <utility>

#include "common/garment/garment_json.h"
#include "common/store/columns.h"
#include "common/store/upload_rows.h"

namespace fitroom::shop_catalog {

using sqlite::Database;
using sqlite::Statement;
using store::Corrupt;
using store::HashBytes;
using store::HashFromRow;

const char kGarmentSchema[] = R"sql(
CREATE TABLE garments (
  garment TEXT PRIMARY KEY,
  garment_json TEXT NOT NULL,
  publish_time_unix_s INTEGER NOT NULL
) STRICT;
CREATE TABLE garment_images (
  garment TEXT NOT NULL REFERENCES garments (garment) ON DELETE CASCADE,
  image TEXT NOT NULL,
  position INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  side INTEGER NOT NULL,
  file_name TEXT NOT NULL,
  size_bytes INTEGER NOT NULL,
  blake2b_256 BLOB NOT NULL CHECK (length(blake2b_256) = 32),
  blob_id INTEGER NOT NULL REFERENCES blobs (blob_id),
  PRIMARY KEY (garment, image)
) STRICT;
CREATE INDEX garment_images_by_blob ON garment_images (blob_id);
CREATE TABLE uploads (
  upload TEXT PRIMARY KEY,
  garment TEXT NOT NULL UNIQUE,
  title TEXT NOT NULL,
  kind TEXT NOT NULL,
  length_m REAL NOT NULL,
  annotation_json TEXT NOT NULL,
  touch_time_unix_s INTEGER NOT NULL
) STRICT;
CREATE TABLE upload_photos (
  upload TEXT NOT NULL REFERENCES uploads (upload) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  side INTEGER NOT NULL,
  size_bytes INTEGER NOT NULL,
  blake2b_256 BLOB NOT NULL CHECK (length(blake2b_256) = 32),
  blob_id INTEGER NOT NULL REFERENCES blobs (blob_id),
  PRIMARY KEY (upload, side)
) STRICT;
CREATE INDEX upload_photos_by_blob ON upload_photos (blob_id);
)sql";

const char kShopStatementSchema[] = R"sql(
ALTER TABLE uploads ADD COLUMN statement_json TEXT NOT NULL DEFAULT '{}';
CREATE INDEX IF NOT EXISTS garment_images_by_blob ON garment_images (blob_id);
CREATE INDEX IF NOT EXISTS upload_photos_by_blob ON upload_photos (blob_id);
)sql";

namespace {

Result<GarmentSide> SideFromRow(const Statement& row, int column) {
  const int64_t side = row.Integer(column);
  if (side < 0 || side >= kGarmentSideCount) return Corrupt("an unknown side");
  return static_cast<GarmentSide>(side);
}

Status SelectImages(Database& database, GarmentRecord& record) {
  FR_ASSIGN_OR_RETURN(Statement select, database.Prepare("SELECT kind, side, file_name, size_bytes, blake2b_256 "
                                                         "FROM garment_images WHERE garment = ?1 ORDER BY position"));
  select.Bind(1, record.garment.id);
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status();
    const int64_t kind = select.Integer(0);
    if (kind < 0 || kind > static_cast<int64_t>(GarmentImageKind::kExtraction)) return Corrupt("an unknown image");
    GarmentImageRecord image;
    image.kind = static_cast<GarmentImageKind>(kind);
    FR_ASSIGN_OR_RETURN(image.side, SideFromRow(select, 1));
    image.file_name = select.Text(2);
    image.size = select.Integer(3);
    FR_ASSIGN_OR_RETURN(image.hash, HashFromRow(select, 4));
    record.images.push_back(std::move(image));
  }
}

Result<GarmentRecord> ReadGarmentRow(Database& database, const Statement& row) {
  GarmentRecord record;
  Result<Garment> garment = GarmentFromJson(row.Text(0));
  if (!garment.ok()) return Corrupt("a garment that cannot be read: " + garment.status().message());
  record.garment = std::move(garment).value();
  record.publish_time_unix_s = row.Integer(1);
  FR_RETURN_IF_ERROR(SelectImages(database, record));
  return record;
}

Status SelectPhotos(Database& database, UploadRow& row) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare("SELECT side, upload_photos.size_bytes, blake2b_256, blob_id, blobs.size_bytes "
                                       "FROM upload_photos JOIN blobs USING (blob_id) WHERE upload = ?1 "
                                       "ORDER BY position"));
  select.Bind(1, row.upload.id);
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status();
    PhotoStatement photo;
    FR_ASSIGN_OR_RETURN(photo.side, SideFromRow(select, 0));
    photo.size = select.Integer(1);
    FR_ASSIGN_OR_RETURN(photo.hash, HashFromRow(select, 2));
    row.upload.statement.photos.push_back(photo);
    row.blobs.push_back(select.Integer(3));
    row.upload.committed_sizes.push_back(select.Integer(4));
  }
}

// `condition` is one of this file's literals over ?1.
Result<UploadRow> SelectUploadWhere(Database& database, const char* condition, std::string_view key) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare(std::string("SELECT upload, garment, title, kind, length_m, annotation_json, "
                                                   "statement_json FROM uploads WHERE ") +
                                       condition));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, key).Step());
  if (!has_row) {
    return store::UploadNotFound();
  }
  UploadRow row;
  row.upload.id = select.Text(0);
  GarmentUploadStatement& statement = row.upload.statement;
  statement.id = select.Text(1);
  statement.title = select.Text(2);
  const std::optional<GarmentKind> kind = GarmentKindFromName(select.Text(3));
  if (!kind) return Corrupt("an unknown kind");
  statement.kind = *kind;
  statement.length = select.Real(4);
  statement.annotation_json = select.Text(5);
  Result<ShopStatement> stated = ShopStatementFromJson(select.Text(6));
  if (!stated.ok()) return Corrupt("a statement that cannot be read: " + stated.status().message());
  statement.stated = std::move(stated).value();
  FR_RETURN_IF_ERROR(SelectPhotos(database, row));
  return row;
}

}  // namespace

Status InsertGarment(Database& database, const GarmentRecord& record, const std::vector<int64_t>& blobs) {
  FR_ASSIGN_OR_RETURN(Statement insert,
                      database.Prepare("INSERT INTO garments (garment, garment_json, publish_time_unix_s) "
                                       "VALUES (?1, ?2, ?3)"));
  const std::string json = GarmentToJson(record.garment);
  FR_RETURN_IF_ERROR(insert.Bind(1, record.garment.id).Bind(2, json).Bind(3, record.publish_time_unix_s).Run());
  FR_ASSIGN_OR_RETURN(
      Statement images,
      database.Prepare("INSERT INTO garment_images (garment, image, position, kind, side, file_name, "
                       "size_bytes, blake2b_256, blob_id) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)"));
  for (size_t i = 0; i < record.images.size(); ++i) {
    const GarmentImageRecord& image = record.images[i];
    const std::string id = ImageId(image.kind, image.side);
    images.Bind(1, record.garment.id).Bind(2, id).Bind(3, static_cast<int64_t>(i));
    images.Bind(4, static_cast<int64_t>(image.kind)).Bind(5, static_cast<int64_t>(image.side));
    images.Bind(6, image.file_name).Bind(7, image.size).Bind(8, HashBytes(image.hash)).Bind(9, blobs[i]);
    FR_RETURN_IF_ERROR(images.Run());
  }
  return Status();
}

Result<GarmentRecord> SelectGarment(Database& database, std::string_view id) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare("SELECT garment_json, publish_time_unix_s FROM garments WHERE garment = ?1"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, id).Step());
  if (!has_row) return NotFound("GARMENT_NOT_FOUND", "garments/" + std::string(id) + ": no such garment");
  return ReadGarmentRow(database, select);
}

Result<std::vector<GarmentRecord>> SelectGarments(Database& database, std::string_view after, int limit) {
  FR_ASSIGN_OR_RETURN(Statement select,
                      database.Prepare("SELECT garment_json, publish_time_unix_s FROM garments WHERE garment > ?1 "
                                       "ORDER BY garment LIMIT ?2"));
  select.Bind(1, after).Bind(2, int64_t{limit});
  std::vector<GarmentRecord> records;
  for (;;) {
    FR_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return records;
    FR_ASSIGN_OR_RETURN(GarmentRecord record, ReadGarmentRow(database, select));
    records.push_back(std::move(record));
  }
}

Result<ImageRow> SelectImage(Database& database, std::string_view garment, std::string_view image) {
  FR_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT blob_id, size_bytes FROM garment_images WHERE garment = ?1 AND image = ?2"));
  FR_ASSIGN_OR_RETURN(const bool has_row, select.Bind(1, garment).Bind(2, image).Step());
  if (!has_row) {
    return NotFound("IMAGE_NOT_FOUND",
                    "garments/" + std::string(garment) + "/images/" + std::string(image) + ": no such image");
  }
  return ImageRow{select.Integer(0), select.Integer(1)};
}

Status InsertUpload(Database& database, const UploadRow& row) {
  const GarmentUploadStatement& statement = row.upload.statement;
  FR_ASSIGN_OR_RETURN(Statement insert,
                      database.Prepare("INSERT INTO uploads (upload, garment, title, kind, length_m, annotation_json, "
                                       "touch_time_unix_s, statement_json) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)"));
  insert.Bind(1, row.upload.id).Bind(2, statement.id).Bind(3, statement.title);
  insert.Bind(4, GarmentKindName(statement.kind)).Bind(5, statement.length).Bind(6, statement.annotation_json);
  const std::string stated = ShopStatementToJson(statement.stated);
  FR_RETURN_IF_ERROR(insert.Bind(7, int64_t{std::time(nullptr)}).Bind(8, stated).Run());
  FR_ASSIGN_OR_RETURN(Statement photos, database.Prepare("INSERT INTO upload_photos (upload, position, side, "
                                                         "size_bytes, blake2b_256, blob_id) "
                                                         "VALUES (?1, ?2, ?3, ?4, ?5, ?6)"));
  for (size_t i = 0; i < statement.photos.size(); ++i) {
    const PhotoStatement& photo = statement.photos[i];
    photos.Bind(1, row.upload.id).Bind(2, static_cast<int64_t>(i)).Bind(3, static_cast<int64_t>(photo.side));
    FR_RETURN_IF_ERROR(photos.Bind(4, photo.size).Bind(5, HashBytes(photo.hash)).Bind(6, row.blobs[i]).Run());
  }
  return Status();
}

Result<UploadRow> SelectUpload(Database& database, std::string_view id) {
  return SelectUploadWhere(database, "upload = ?1", id);
}

Result<UploadRow> SelectUploadOfGarment(Database& database, std::string_view garment) {
  return SelectUploadWhere(database, "garment = ?1", garment);
}

}  // namespace fitroom::shop_catalog
