#pragma once

#include <chrono>
#include <filesystem>

#include "common/base/status.h"

namespace fitroom::fit_client {

// Keeps two pulls of one item apart, in this process and in others: they would write the same partial folder. Freed by
// the system when the process ends in any way; the empty file stays.
class PullLock {
 public:
  // Takes the lock on `path`, waiting for at most `patience`. UNAVAILABLE [PULL_UNDER_WAY] if another pull still holds
  // it then; PERMISSION_DENIED [FOLDER_NOT_WRITABLE].
  static Result<PullLock> Take(const std::filesystem::path& path, std::chrono::milliseconds patience);

  PullLock(PullLock&& other) noexcept;
  PullLock& operator=(PullLock&&) = delete;
  ~PullLock();

 private:
  explicit PullLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

// How long a pull waits for another one of the same item.
inline constexpr std::chrono::minutes kPullPatience{5};

}  // namespace fitroom::fit_client
