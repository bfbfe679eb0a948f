#include "body_center/store/sqlite_body_store.h"

#include <gtest/gtest.h>

#include "tests/support/service/fake_scan.h"
#include "tests/support/service/foreign_keys.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

TEST(BodySchema, LooksUpEveryForeignKeyInAnIndex) {
  const TemporaryFolder folder;
  ASSERT_TRUE(body_center::OpenSqliteBodyStore(folder.path()).ok());
  const Result<ForeignKeys> keys = FindForeignKeys(folder.path() / "body_center.sqlite");
  ASSERT_TRUE(keys.ok()) << keys.status().ToString();
  EXPECT_EQ(keys->count, 6);
  EXPECT_EQ(keys->without_index, std::vector<std::string>());
}

// The first databases were made without the indexes over blobs, and are otherwise the same.
TEST(BodySchema, ADatabaseOfTheFirstVersionGetsItsIndexesAndLosesNothing) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "body_center.sqlite";
  const std::string file = FakeScanFile(1, 5000);
  std::string upload_id;
  {
    auto store = body_center::OpenSqliteBodyStore(folder.path());
    ASSERT_TRUE(store.ok()) << store.status().ToString();
    const Result<ScanUpload> upload = (*store)->StartUpload(StatementOf("ann", "one", file));
    ASSERT_TRUE(upload.ok()) << upload.status().ToString();
    upload_id = upload->id;
    ASSERT_TRUE((*store)->AppendToUpload(upload_id, 0, file.substr(0, 3000)).ok());
  }
  {
    Result<sqlite::Database> database = sqlite::Database::Open(path, sqlite::Access::kReadWrite);
    ASSERT_TRUE(database.ok());
    ASSERT_TRUE(database
                    ->Execute("DROP INDEX scans_by_original_blob; DROP INDEX scans_by_packed_mesh_blob; "
                              "DROP INDEX uploads_by_blob; PRAGMA user_version = 1")
                    .ok());
  }
  ASSERT_EQ(FindForeignKeys(path)->without_index.size(), 3u);
  auto store = body_center::OpenSqliteBodyStore(folder.path());
  ASSERT_TRUE(store.ok()) << store.status().ToString();
  EXPECT_EQ((*store)->FindUpload(upload_id)->committed_size, 3000);
  EXPECT_TRUE(*(*store)->ReadUpload(upload_id) == file.substr(0, 3000));
  store->reset();
  EXPECT_EQ(FindForeignKeys(path)->without_index, std::vector<std::string>());
}

}  // namespace
}  // namespace fitroom::testing
