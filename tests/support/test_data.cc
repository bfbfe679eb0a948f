#include "tests/support/test_data.h"

#include <cstdlib>

namespace fitroom::testing {

std::filesystem::path TestDataFolder() {
  const char* folder = std::getenv("FITROOM_TEST_DATA");
  return folder != nullptr ? folder : FITROOM_TEST_DATA_DIR;
}

bool HasTestData() {
  std::error_code ignored;
  return !TestDataFolder().empty() && std::filesystem::is_directory(TestDataFolder() / "bodies", ignored);
}

}  // namespace fitroom::testing
