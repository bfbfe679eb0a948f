#include "common/base/file.h"

#include <sys/stat.h>

#include <string>

#include <gtest/gtest.h>

#include "common/base/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace fitroom {
namespace {

TEST(File, ReadsBackWhatWasWritten) {
  const testing::TemporaryFolder folder;
  const std::string content("a\0b\r\n", 5);
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", content).ok());
  EXPECT_EQ(ReadFile(folder.path() / "x", 5).value(), content);
}

TEST(File, LeavesNoTemporaryFileBehind) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", "1").ok());
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", "2").ok());
  int file_count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++file_count;
  EXPECT_EQ(file_count, 1);
}

TEST(File, IsAsReadableAsTheProcessAllows) {
  const testing::TemporaryFolder folder;
  const auto mode_under = [&](mode_t umask) {
    const mode_t before = ::umask(umask);
    const Status written = WriteFileAtomically(folder.path() / "x", "1");
    ::umask(before);
    EXPECT_TRUE(written.ok()) << written.ToString();
    struct stat facts {};
    EXPECT_EQ(::stat((folder.path() / "x").c_str(), &facts), 0);
    return facts.st_mode & 0777;
  };
  EXPECT_EQ(mode_under(0022), 0644u);
  EXPECT_EQ(mode_under(0077), 0600u);
  EXPECT_EQ(mode_under(0002), 0664u);
}

TEST(File, IsUnchangedUntilTheNewOneIsWhole) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", "old").ok());
  {
    Result<AtomicFile> abandoned = AtomicFile::Create(folder.path() / "x");
    Result<AtomicFile> other = AtomicFile::Create(folder.path() / "x");
    ASSERT_TRUE(abandoned.ok() && other.ok());
    ASSERT_TRUE(abandoned->Write("ab").ok() && other->Write("ne").ok() && other->Write("w").ok());
    EXPECT_EQ(ReadFile(folder.path() / "x", 10).value(), "old");
    ASSERT_TRUE(other->Commit().ok());
  }
  EXPECT_EQ(ReadFile(folder.path() / "x", 10).value(), "new");
  std::filesystem::create_directory(folder.path() / "folder");
  EXPECT_FALSE(WriteFileAtomically(folder.path() / "folder", "1").ok());
  EXPECT_EQ(WriteFileAtomically(folder.path() / "none" / "x", "1").reason(), "FILE_NOT_FOUND");
  int entry_count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entry_count;
  EXPECT_EQ(entry_count, 2) << "a temporary file was left behind";
}

TEST(File, RefusesMoreThanTheLimitAFolderAndAMissingFile) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", "123").ok());
  EXPECT_EQ(ReadFile(folder.path() / "x", 2).status().code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(ReadFile(folder.path(), 2).status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(ReadFile(folder.path() / "y", 2).status().code(), StatusCode::kNotFound);
}

TEST(File, AnEmptyFileIsAnEmptyView) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "x", "").ok());
  EXPECT_TRUE(MappedFile::Open(folder.path() / "x").value().text().empty());
}

}  // namespace
}  // namespace fitroom
