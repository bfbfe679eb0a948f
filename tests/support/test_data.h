#pragma once

#include <filesystem>

#include <gtest/gtest.h>

namespace fitroom::testing {

// Returns the folder of external test data: the environment's FITROOM_TEST_DATA, else the one configured in CMake;
// empty where neither names one.
std::filesystem::path TestDataFolder();

// Says whether the external test data is there.
bool HasTestData();

}  // namespace fitroom::testing

// Skips the test, loudly, where the external test data is absent; fails instead where FITROOM_REQUIRE_TEST_DATA is set,
// as it is in CI, so that a lost folder cannot pass as green.
#define FR_REQUIRE_TEST_DATA()                                                                            \
  do {                                                                                                    \
    if (!::fitroom::testing::HasTestData()) {                                                             \
      if (std::getenv("FITROOM_REQUIRE_TEST_DATA") != nullptr) {                                          \
        FAIL() << "external test data is required but missing: " << ::fitroom::testing::TestDataFolder(); \
      }                                                                                                   \
      GTEST_SKIP() << "external test data is absent: " << ::fitroom::testing::TestDataFolder();           \
    }                                                                                                     \
  } while (false)
