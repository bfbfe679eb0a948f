#include "shop_catalog/store/sqlite_garment_store.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fitroom::testing
