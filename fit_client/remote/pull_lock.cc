#include "fit_client/remote/pull_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

namespace fitroom::fit_client {

Result<PullLock> PullLock::Take(const std::filesystem::path& path, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kPause{50};
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    return Status(StatusCode::kPermissionDenied, "FOLDER_NOT_WRITABLE", path.string() + ": " + std::strerror(errno));
  }
  PullLock lock(descriptor);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) {
      return Unavailable("FILE_IO", path.string() + ": " + std::strerror(errno));
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      return Unavailable("PULL_UNDER_WAY",
                         path.string() + ": another pull of the same is under way; wait until it ends");
    }
    std::this_thread::sleep_for(kPause);
  }
  return lock;
}

PullLock::PullLock(PullLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PullLock::~PullLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace fitroom::fit_client
