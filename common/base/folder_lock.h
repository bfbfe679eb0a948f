#pragma once

#include <filesystem>

#include "common/base/status.h"

namespace fitroom {

// Keeps a folder for this process: a lock on the file `lock` in it, freed by the system when the process ends in any
// way.
class FolderLock {
 public:
  // Makes the folder (for its owner only) if it is not there and takes the lock.
  // FAILED_PRECONDITION [FOLDER_IN_USE] if another process has it.
  static Result<FolderLock> Take(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace fitroom
