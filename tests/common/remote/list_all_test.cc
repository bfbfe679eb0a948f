#include "common/remote/list_all.h"

#include <gtest/gtest.h>

namespace fitroom::remote {
namespace {

using Page = ListPage<int>;

// Pages of one entry each, numbered from 0. Behind page `last` comes page `back_to`, or the end if that is negative.
Result<std::vector<int>> ListPages(int last, int back_to) {
  return ListAll<int>([=](const std::string& token) -> Result<Page> {
    const int number = token.empty() ? 0 : std::stoi(token);
    const int next = number == last ? back_to : number + 1;
    return Page{{number}, next < 0 ? std::string() : std::to_string(next)};
  });
}

TEST(ListAll, GathersEveryPageInOrder) {
  for (const int last : {0, 1, 2, 7, 100}) {
    const Result<std::vector<int>> all = ListPages(last, -1);
    ASSERT_TRUE(all.ok()) << all.status().ToString();
    ASSERT_EQ(std::ssize(*all), last + 1);
    for (int i = 0; i <= last; ++i) EXPECT_EQ((*all)[static_cast<size_t>(i)], i);
  }
}

TEST(ListAll, EndsInAnyCircleOfTokens) {
  for (const int last : {1, 2, 3, 10, 97}) {
    for (int back_to = 1; back_to <= last; ++back_to) {
      EXPECT_EQ(ListPages(last, back_to).status().reason(), "PAGE_TOKEN_REPEATED") << last << " " << back_to;
    }
  }
}

TEST(ListAll, EndsWithAListThatDoesNotEnd) {
  EXPECT_EQ(ListPages(-1, -1).status().reason(), "LIST_TOO_LONG");
  int fetch_count = 0;
  const auto empty_pages = [&](const std::string&) -> Result<Page> { return Page{{}, std::to_string(++fetch_count)}; };
  EXPECT_EQ(ListAll<int>(empty_pages).status().reason(), "LIST_TOO_LONG");
  EXPECT_LE(fetch_count, kMaxListSize + 1);
}

TEST(ListAll, TakesAsMuchAsTheLimitAllows) {
  const auto of_size = [](int64_t size) {
    return ListAll<int>([=](const std::string&) -> Result<Page> {
      return Page{std::vector<int>(static_cast<size_t>(size)), std::string()};
    });
  };
  EXPECT_TRUE(of_size(kMaxListSize).ok());
  EXPECT_EQ(of_size(kMaxListSize + 1).status().code(), StatusCode::kResourceExhausted);
}

TEST(ListAll, PassesOnAnError) {
  const auto refuse = [](const std::string&) -> Result<Page> { return Unavailable("SERVER_GONE", "x"); };
  EXPECT_EQ(ListAll<int>(refuse).status().reason(), "SERVER_GONE");
}

}  // namespace
}  // namespace fitroom::remote
