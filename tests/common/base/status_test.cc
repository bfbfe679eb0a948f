#include "common/base/status.h"

#include <gtest/gtest.h>

#include "common/base/exit_code.h"

namespace fitroom {
namespace {

Result<int> Half(int value) {
  if (value % 2 != 0) return InvalidArgument("ODD", std::to_string(value) + " is odd; give an even number");
  return value / 2;
}

Result<int> Quarter(int value) {
  FR_ASSIGN_OR_RETURN(const int half, Half(value));
  return Half(half);
}

TEST(Result, HandsOnTheValue) { EXPECT_EQ(Quarter(8).value(), 2); }

TEST(Result, HandsOnTheFirstError) {
  const Result<int> quarter = Quarter(6);
  ASSERT_FALSE(quarter.ok());
  EXPECT_EQ(quarter.status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(quarter.status().reason(), "ODD");
  EXPECT_EQ(quarter.status().message(), "3 is odd; give an even number");
}

TEST(ResultDeathTest, ReadingTheValueOfAnErrorAborts) { EXPECT_DEATH((void)Half(1).value(), "check failed"); }

TEST(Status, AtNamesThePlaceAndKeepsCodeAndReason) {
  const Status status = NotFound("FILE_NOT_FOUND", "no such file").At("a.ase");
  EXPECT_EQ(status.ToString(), "NOT_FOUND [FILE_NOT_FOUND] a.ase: no such file");
  EXPECT_TRUE(Status().At("a.ase").ok());
}

TEST(ExitCode, FollowsTheDocumentedTable) {
  EXPECT_EQ(ExitCodeFor(Status()), ExitCode::kOk);
  EXPECT_EQ(ExitCodeFor(NotFound("X", "")), ExitCode::kNotFound);
  EXPECT_EQ(ExitCodeFor(FailedPrecondition("X", "")), ExitCode::kRefused);
  EXPECT_EQ(ExitCodeFor(InvalidArgument("X", "")), ExitCode::kInvalidInput);
  EXPECT_EQ(ExitCodeFor(Unavailable("X", "")), ExitCode::kUnavailable);
  EXPECT_EQ(ExitCodeFor(Internal("X", "")), ExitCode::kFailure);
}

}  // namespace
}  // namespace fitroom
