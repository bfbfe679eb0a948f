#include "common/base/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/base/atomic_file.h"
#include "common/base/system_error.h"

namespace fitroom {
namespace {

Status ReadError(const std::filesystem::path& path, int error) { return SystemError(path, error, "FILE_NOT_READABLE"); }

// Closes a descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

Status SystemError(const std::filesystem::path& path, int error, const char* refused) {
  const std::string message = path.string() + ": " + std::strerror(error);
  if (error == ENOENT || error == ENOTDIR) return NotFound("FILE_NOT_FOUND", message);
  if (error == EACCES || error == EPERM) return Status(StatusCode::kPermissionDenied, refused, message);
  if (error == ENOSPC || error == EDQUOT) return ResourceExhausted("DISK_FULL", message + "; free some space");
  return Unavailable("FILE_IO", message);
}

Result<MappedFile> MappedFile::Open(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return ReadError(path, errno);
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) return ReadError(path, errno);
  if (!S_ISREG(facts.st_mode)) {
    return InvalidArgument("NOT_A_FILE", path.string() + " is not a regular file; name a file");
  }
  const auto size = static_cast<size_t>(facts.st_size);
  if (size == 0) return MappedFile(nullptr, 0);
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (address == MAP_FAILED) return ReadError(path, errno);
  return MappedFile(address, size);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : address_(std::exchange(other.address_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(address_, other.address_);
  std::swap(size_, other.size_);
  return *this;
}

MappedFile::~MappedFile() {
  if (address_ != nullptr) ::munmap(address_, size_);
}

Result<std::string> ReadFile(const std::filesystem::path& path, size_t max_size) {
  FR_ASSIGN_OR_RETURN(MappedFile file, MappedFile::Open(path));
  if (file.text().size() > max_size) {
    return ResourceExhausted("FILE_TOO_LARGE", path.string() + " has " + std::to_string(file.text().size()) +
                                                   " bytes; at most " + std::to_string(max_size) + " are read");
  }
  return std::string(file.text());
}

Status WriteFileAtomically(const std::filesystem::path& path, std::string_view content) {
  FR_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::Create(path));
  FR_RETURN_IF_ERROR(file.Write(content));
  return file.Commit();
}

}  // namespace fitroom
