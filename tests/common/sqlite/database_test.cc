#include "common/sqlite/database.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "common/sqlite/blob_table.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::sqlite {
namespace {

std::span<const std::byte> AsBytes(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

class DatabaseTest : public ::testing::Test {
 protected:
  Database Open(Access access = Access::kReadWrite) {
    Result<Database> database = Database::Open(path_, access);
    EXPECT_TRUE(database.ok()) << database.status().ToString();
    return std::move(database).value();
  }
  int64_t Number(Database& database, const char* sql) {
    Result<Statement> statement = database.Prepare(sql);
    EXPECT_TRUE(statement.ok()) << statement.status().ToString();
    EXPECT_TRUE(*statement->Step());
    return statement->Integer(0);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "test.sqlite";
};

TEST_F(DatabaseTest, HasTheSettingsThatDurabilityNeeds) {
  Database database = Open();
  ASSERT_TRUE(database.Execute("CREATE TABLE t (x)").ok());
  EXPECT_EQ(Number(database, "PRAGMA page_size"), 65536);
  EXPECT_EQ(Number(database, "PRAGMA synchronous"), 2) << "2 is FULL";
  EXPECT_EQ(Number(database, "PRAGMA secure_delete"), 1);
  EXPECT_EQ(Number(database, "PRAGMA foreign_keys"), 1);
  Database reader = Open(Access::kReadOnly);
  EXPECT_EQ(Number(reader, "PRAGMA wal_autocheckpoint"), 0);
  EXPECT_FALSE(reader.Execute("INSERT INTO t VALUES (1)").ok());
  EXPECT_EQ(std::filesystem::status(path_).permissions() & std::filesystem::perms::others_all,
            std::filesystem::perms::none);
}

TEST_F(DatabaseTest, ATransactionRollsBackUnlessItIsCommitted) {
  Database database = Open();
  ASSERT_TRUE(database.Execute("CREATE TABLE t (x)").ok());
  {
    Result<Transaction> transaction = Transaction::Begin(database);
    ASSERT_TRUE(transaction.ok());
    ASSERT_TRUE(database.Execute("INSERT INTO t VALUES (1)").ok());
  }
  EXPECT_EQ(Number(database, "SELECT count(*) FROM t"), 0);
  Result<Transaction> transaction = Transaction::Begin(database);
  ASSERT_TRUE(transaction.ok());
  ASSERT_TRUE(database.Execute("INSERT INTO t VALUES (1)").ok());
  ASSERT_TRUE(transaction->Commit().ok());
  EXPECT_EQ(Number(database, "SELECT count(*) FROM t"), 1);
}

TEST_F(DatabaseTest, MigratesForwardOnceAndAllOrNothing) {
  const char* first = "CREATE TABLE a (x)";
  const char* second = "CREATE TABLE b (x); INSERT INTO b VALUES (7)";
  {
    Database database = Open();
    ASSERT_TRUE(database.Migrate(std::array{first}).ok());
    ASSERT_TRUE(database.Migrate(std::array{first, second}).ok());
    ASSERT_TRUE(database.Migrate(std::array{first, second}).ok());
    EXPECT_EQ(Number(database, "SELECT x FROM b"), 7);
    EXPECT_FALSE(database.Migrate(std::array{first, second, "CREATE TABLE c (x); nonsense"}).ok());
    EXPECT_EQ(Number(database, "SELECT count(*) FROM sqlite_schema WHERE name = 'c'"), 0);
    EXPECT_EQ(Number(database, "PRAGMA user_version"), 2);
  }
  Database older = Open();
  EXPECT_EQ(older.Migrate(std::array{first}).reason(), "SCHEMA_TOO_NEW");
}

TEST_F(DatabaseTest, SaysWhatAFileIsThatIsNoDatabase) {
  std::ofstream(path_) << std::string(100000, 'x');
  EXPECT_EQ(Database::Open(path_, Access::kReadWrite).status().reason(), "DATABASE_CORRUPT");
}

TEST_F(DatabaseTest, AFullDiskKeepsNothingOfTheTransactionAndTheNextOneWorks) {
  Database database = Open();
  ASSERT_TRUE(database.Execute("CREATE TABLE t (x)").ok());
  ASSERT_TRUE(database.Execute("PRAGMA max_page_count = 10").ok());  // The engine then answers as on a full disk.
  {
    Result<Transaction> transaction = Transaction::Begin(database);
    ASSERT_TRUE(transaction.ok());
    ASSERT_TRUE(database.Execute("INSERT INTO t VALUES (1)").ok());
    EXPECT_EQ(database.Execute("INSERT INTO t VALUES (zeroblob(5000000))").reason(), "DISK_FULL");
  }
  EXPECT_EQ(Number(database, "SELECT count(*) FROM t"), 0);
  EXPECT_TRUE(database.Execute("INSERT INTO t VALUES (1)").ok());
}

TEST_F(DatabaseTest, BindsEveryKindOfValueExactly) {
  Database database = Open();
  Result<Statement> statement = database.Prepare("SELECT ?1, ?2, ?3, ?4, typeof(?5), typeof(?6)");
  ASSERT_TRUE(statement.ok());
  const std::string text("a\0b'; DROP TABLE t; --", 22);
  const std::string bytes("\xff\0\x01", 3);
  statement->Bind(1, int64_t{-1} << 62).Bind(2, 0.1).Bind(3, std::string_view(text)).Bind(4, AsBytes(bytes));
  statement->Bind(5, std::string_view()).Bind(6, std::span<const std::byte>());
  ASSERT_TRUE(*statement->Step());
  EXPECT_EQ(statement->Integer(0), int64_t{-1} << 62);
  EXPECT_EQ(statement->Real(1), 0.1);
  EXPECT_EQ(statement->Text(2), text);
  EXPECT_EQ(statement->Text(3), bytes);
  EXPECT_EQ(statement->Text(4), "text");
  EXPECT_EQ(statement->Text(5), "blob");
  EXPECT_FALSE(statement->Bind(99, int64_t{1}).Step().ok());
}

TEST_F(DatabaseTest, ABlobGrowsOnlyAtItsEnd) {
  Database database = Open();
  ASSERT_TRUE(database.Migrate(std::array{kBlobSchema}).ok());
  const Result<int64_t> blob = CreateBlob(database);
  ASSERT_TRUE(blob.ok());
  ASSERT_TRUE(AppendBlobBlock(database, *blob, {0, 100, AsBytes("first")}).ok());
  ASSERT_TRUE(AppendBlobBlock(database, *blob, {100, 50, AsBytes("second")}).ok());
  for (const int64_t offset : {0, 100, 149, 151}) {
    EXPECT_EQ(AppendBlobBlock(database, *blob, {offset, 1, AsBytes("x")}).reason(), "UPLOAD_OFFSET_CONFLICT") << offset;
  }
  EXPECT_EQ(AppendBlobBlock(database, *blob + 1, {0, 1, AsBytes("x")}).reason(), "UPLOAD_OFFSET_CONFLICT");
  EXPECT_EQ(*BlobSize(database, *blob), 150);
  const auto block_at = [&](int64_t offset) {
    std::string stored;
    const Status status = VisitBlobBlock(database, *blob, offset, [&](const BlobBlock& block) {
      stored.assign(reinterpret_cast<const char*>(block.stored.data()), block.stored.size());
      return Status();
    });
    return status.ok() ? stored : status.reason();
  };
  EXPECT_EQ(block_at(0), "first");
  EXPECT_EQ(block_at(99), "first");
  EXPECT_EQ(block_at(100), "second");
  EXPECT_EQ(block_at(150), "OFFSET_PAST_END");
  EXPECT_EQ(block_at(-1), "OFFSET_PAST_END");
  const std::string too_large(kMaxBlobRowSize + 1, 'x');
  EXPECT_EQ(AppendBlobBlock(database, *blob, {150, 1, AsBytes(too_large)}).reason(), "BLOB_ROW_TOO_LARGE");
}

// Whatever is deleted is overwritten, in the database and, after a checkpoint, in the log.
TEST_F(DatabaseTest, DeletedBytesAreGoneFromTheFiles) {
  std::string secret(300000, '\0');
  std::mt19937 random(4);
  for (char& c : secret) c = static_cast<char>(random());
  const auto is_on_disk = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string content(std::istreambuf_iterator<char>(stream), {});
      for (size_t place = 0; place + 64 < secret.size(); place += 20000) {
        if (content.find(secret.substr(place, 64)) != std::string::npos) return true;
      }
    }
    return false;
  };
  Database database = Open();
  ASSERT_TRUE(database.Migrate(std::array{kBlobSchema}).ok());
  const Result<int64_t> blob = CreateBlob(database);
  ASSERT_TRUE(AppendBlobBlock(database, *blob, {0, std::ssize(secret), AsBytes(secret)}).ok());
  ASSERT_TRUE(database.Checkpoint().ok());
  ASSERT_TRUE(is_on_disk()) << "the test must be able to see the bytes";
  ASSERT_TRUE(DeleteBlob(database, *blob).ok());
  ASSERT_TRUE(database.Checkpoint().ok());
  EXPECT_FALSE(is_on_disk());
}

}  // namespace
}  // namespace fitroom::sqlite
