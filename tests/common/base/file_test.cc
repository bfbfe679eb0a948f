#include "common/base/file.h"

#include <gtest/gtest.h>

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
