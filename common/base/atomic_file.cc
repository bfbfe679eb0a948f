#include "common/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <random>
#include <utility>

#include "common/base/system_error.h"

namespace fitroom {
namespace {

// How many names are tried. A second one is needed once in 2^32 files.
constexpr int kNameCount = 100;

std::string TemporaryName(const std::filesystem::path& path) {
  std::random_device source;
  std::array<char, 16> suffix{};
  std::snprintf(suffix.data(), suffix.size(), ".%08x.part", source());
  return path.string() + suffix.data();
}

Status WriteError(const std::filesystem::path& path, int error) {
  return SystemError(path, error, "FILE_NOT_WRITABLE");
}

}  // namespace

Result<AtomicFile> AtomicFile::Create(const std::filesystem::path& path) {
  for (int i = 0; i < kNameCount; ++i) {
    std::string temporary = TemporaryName(path);
    // Not mkstemp(): its files are the owner's alone. Here the system applies the umask, which cannot be read without
    // being changed for every thread.
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return AtomicFile(path, std::move(temporary), descriptor);
    if (errno != EEXIST) return WriteError(path, errno);
  }
  return WriteError(path, EEXIST);
}

AtomicFile::AtomicFile(std::filesystem::path path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, std::string())),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(temporary_, other.temporary_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status AtomicFile::Write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return WriteError(path_, errno);
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return Status();
}

Status AtomicFile::Commit() {
  if (::fsync(descriptor_) != 0) return WriteError(path_, errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return WriteError(path_, errno);
  temporary_.clear();
  return Status();
}

}  // namespace fitroom
