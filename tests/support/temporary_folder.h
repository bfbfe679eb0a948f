#pragma once

#include <filesystem>

namespace fitroom::testing {

// A fresh folder that is removed with everything in it when the object dies. Owner only; not copyable.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace fitroom::testing
