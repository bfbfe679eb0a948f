#include "fit_client/render/run_both.h"

#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

namespace fitroom::render {
namespace {

TEST(RunBoth, RunsBothWhateverTheThreads) {
  for (const int thread_count : {0, 1, 2}) {
    int first_count = 0;
    int second_count = 0;
    EXPECT_TRUE(RunBoth(
                    thread_count, [&] { ++first_count; }, [&] { ++second_count; })
                    .ok());
    EXPECT_EQ(first_count, 1);
    EXPECT_EQ(second_count, 1);
  }
}

TEST(RunBoth, TurnsAnExceptionOfEitherIntoAnErrorAndEndsTheOther) {
  for (const int thread_count : {1, 2}) {
    int other_count = 0;
    const Status first = RunBoth(
        thread_count, [] { throw std::bad_alloc(); }, [&] { ++other_count; });
    const Status second = RunBoth(
        thread_count, [&] { ++other_count; }, [] { throw std::runtime_error("no room"); });
    EXPECT_EQ(other_count, 2);
    for (const Status& status : {first, second}) {
      EXPECT_EQ(status.code(), StatusCode::kInternal);
      EXPECT_EQ(status.reason(), "DRAWING_FAILED");
    }
    EXPECT_NE(second.message().find("no room"), std::string::npos) << second.message();
    EXPECT_EQ(RunBoth(
                  thread_count, [] { throw 1; }, [] {})
                  .reason(),
              "DRAWING_FAILED");
  }
}

}  // namespace
}  // namespace fitroom::render
