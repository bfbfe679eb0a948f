#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "common/garment/garment_json.h"
#include "common/sqlite/database.h"
#include "shop_catalog/store/sqlite_garment_store.h"
#include "tests/support/sample_garment.h"
#include "tests/support/service/foreign_keys.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

TEST(ShopSchema, LooksUpEveryForeignKeyInAnIndex) {
  const TemporaryFolder folder;
  ASSERT_TRUE(shop_catalog::OpenSqliteGarmentStore(folder.path()).ok());
  const Result<ForeignKeys> keys = FindForeignKeys(folder.path() / "shop_catalog.sqlite");
  ASSERT_TRUE(keys.ok()) << keys.status().ToString();
  EXPECT_EQ(keys->count, 5);
  EXPECT_EQ(keys->without_index, std::vector<std::string>());
}

// The first schema as the first databases had it: no statements of a shop, no indexes over blobs.
constexpr char kFirstSchema[] = R"sql(
CREATE TABLE blobs (
  blob_id INTEGER PRIMARY KEY AUTOINCREMENT,
  size_bytes INTEGER NOT NULL CHECK (size_bytes >= 0)
) STRICT;
CREATE TABLE blob_blocks (
  blob_id INTEGER NOT NULL REFERENCES blobs (blob_id) ON DELETE CASCADE,
  offset_bytes INTEGER NOT NULL CHECK (offset_bytes >= 0),
  size_bytes INTEGER NOT NULL CHECK (size_bytes > 0),
  stored BLOB NOT NULL,
  UNIQUE (blob_id, offset_bytes)
) STRICT;
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
INSERT INTO blobs (blob_id, size_bytes) VALUES (1, 5), (2, 3);
INSERT INTO blob_blocks VALUES (1, 0, 5, CAST('photo' AS BLOB)), (2, 0, 3, CAST('abc' AS BLOB));
INSERT INTO garment_images VALUES ('sample-tshirt', 'front-photo', 0, 0, 0, 'front.png', 5, zeroblob(32), 1);
INSERT INTO uploads VALUES ('u1', 'tee', 'Tee', 'tshirt', 0.68, '', 1700000000);
INSERT INTO upload_photos VALUES ('u1', 0, 0, 10, zeroblob(32), 2);
PRAGMA user_version = 1;
)sql";

// A garment's text as the first version wrote it.
std::string FirstGarmentJson() {
  std::string text = GarmentToJson(MakeSampleTShirt());
  const std::string version = "\"version\":2";
  const std::string fabric = "\"fabric\":\"jersey\",";
  text.replace(text.find(version), version.size(), "\"version\":1");
  text.erase(text.find(fabric), fabric.size());
  return text;
}

void MakeFirstDatabase(const std::filesystem::path& path) {
  Result<sqlite::Database> database = sqlite::Database::Open(path, sqlite::Access::kReadWrite);
  ASSERT_TRUE(database.ok()) << database.status().ToString();
  // The garment's row goes in last, so that its reference is checked at the end.
  ASSERT_TRUE(database->Execute("PRAGMA foreign_keys = OFF").ok());
  ASSERT_TRUE(database->Execute(kFirstSchema).ok());
  Result<sqlite::Statement> insert = database->Prepare("INSERT INTO garments VALUES (?1, ?2, 1700000001)");
  ASSERT_TRUE(insert.ok());
  const std::string json = FirstGarmentJson();
  ASSERT_TRUE(insert->Bind(1, "sample-tshirt").Bind(2, json).Run().ok());
}

TEST(ShopSchema, ADatabaseOfTheFirstVersionIsCarriedOnAndLosesNothing) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "shop_catalog.sqlite";
  MakeFirstDatabase(path);
  for (int opening = 0; opening < 2; ++opening) {  // The second finds it carried on already.
    auto store = shop_catalog::OpenSqliteGarmentStore(folder.path());
    ASSERT_TRUE(store.ok()) << store.status().ToString();
    const Result<GarmentRecord> record = (*store)->FindGarment("sample-tshirt");
    ASSERT_TRUE(record.ok()) << record.status().ToString();
    EXPECT_EQ(GarmentToJson(record->garment), GarmentToJson(MakeSampleTShirt()));
    EXPECT_EQ(record->publish_time_unix_s, 1700000001);
    EXPECT_EQ(record->images.size(), 1u);
    EXPECT_EQ(*(*store)->ReadImage("sample-tshirt", "front-photo", 0), "photo");
    const Result<GarmentUpload> upload = (*store)->FindUpload("u1");
    ASSERT_TRUE(upload.ok()) << upload.status().ToString();
    EXPECT_TRUE(upload->statement.stated == ShopStatement());
    EXPECT_EQ(upload->statement.title, "Tee");
    EXPECT_EQ(upload->committed_sizes, std::vector<int64_t>{3 + opening});
    EXPECT_EQ(*(*store)->AppendToUpload("u1", GarmentSide::kFront, 3 + opening, "d"), 4 + opening);
  }
  const Result<ForeignKeys> keys = FindForeignKeys(path);
  ASSERT_TRUE(keys.ok()) << keys.status().ToString();
  EXPECT_EQ(keys->without_index, std::vector<std::string>());
}

}  // namespace
}  // namespace fitroom::testing
