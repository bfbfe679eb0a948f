#include "fit_client/remote/resumed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "common/base/file.h"

namespace fitroom::fit_client {
namespace {

namespace fs = std::filesystem;

Status WriteError(const fs::path& path, int error) {
  const std::string message = path.string() + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT) return ResourceExhausted("DISK_FULL", message + "; free some space");
  return Unavailable("FILE_IO", message);
}

// A file that is appended to. Owns its descriptor.
class AppendedFile {
 public:
  explicit AppendedFile(const fs::path& path)
      : path_(path),
        descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600)),
        open_error_(descriptor_ < 0 ? errno : 0) {}
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;
  ~AppendedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  Status Append(std::string_view bytes) {
    if (descriptor_ < 0) return WriteError(path_, open_error_);
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return WriteError(path_, errno);
      bytes.remove_prefix(static_cast<size_t>(written));
    }
    return Status();
  }
  Status Flush() { return ::fsync(descriptor_) == 0 ? Status() : WriteError(path_, errno); }

 private:
  fs::path path_;
  int descriptor_;
  int open_error_;  // Why there is no descriptor.
};

Status CheckWhole(const fs::path& path, int64_t size, const Hash256& hash) {
  {
    FR_ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(path));
    if (std::ssize(file.text()) == size && Blake2b(file.text()) == hash) return Status();
  }
  std::error_code ignored;
  fs::remove(path, ignored);
  return DataLoss("DOWNLOAD_HASH_MISMATCH", "what arrived is not what the server announced; pull it again");
}

}  // namespace

Status DownloadResumed(const fs::path& path, int64_t size, const Hash256& hash, const ByteStream& stream,
                       const ProgressSink& progress) {
  std::error_code error;
  const auto there = fs::file_size(path, error);
  int64_t received = error ? 0 : static_cast<int64_t>(there);
  if (received > size) {
    fs::remove(path, error);
    received = 0;
  }
  if (received < size) {
    AppendedFile file(path);
    FR_RETURN_IF_ERROR(stream(received, [&](std::string_view bytes) -> Status {
      received += std::ssize(bytes);
      if (received > size)
        return DataLoss("DOWNLOAD_TOO_LONG", "the server sends more than it announced; pull it again");
      if (progress) progress("receiving", static_cast<double>(received) / static_cast<double>(size));
      return file.Append(bytes);
    }));
    FR_RETURN_IF_ERROR(file.Flush());
  }
  return CheckWhole(path, size, hash);
}

Status MakePrivateFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) fs::permissions(folder, fs::perms::owner_all, error);
  if (error) return Status(StatusCode::kPermissionDenied, "FOLDER_NOT_MADE", folder.string() + ": " + error.message());
  return Status();
}

Status ReplaceFolder(const fs::path& partial, const fs::path& folder) {
  // Exchanges both names in one step, so that a process that is killed leaves the old folder or the new one.
  if (::renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);  // What was there before.
    return Status();
  }
  const int exchange_error = errno;
  std::error_code error;
  if (exchange_error == ENOENT) {  // Nothing was there: one step as well.
    fs::rename(partial, folder, error);
    return error ? Unavailable("FILE_IO", folder.string() + ": " + error.message()) : Status();
  }
  // The file system cannot exchange (EINVAL, ENOSYS): two steps, the old folder under a name of its own between them.
  fs::path old = partial;
  old += "-old";
  fs::remove_all(old, error);
  fs::rename(folder, old, error);
  if (!error) fs::rename(partial, folder, error);
  std::error_code ignored;
  if (error) {
    if (!fs::exists(folder, ignored)) fs::rename(old, folder, ignored);  // What was there stays there.
    return Unavailable("FILE_IO", folder.string() + ": " + error.message());
  }
  fs::remove_all(old, ignored);
  return Status();
}

}  // namespace fitroom::fit_client
