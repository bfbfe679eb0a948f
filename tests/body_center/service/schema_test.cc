#include "body_center/store/sqlite_body_store.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fitroom::testing
