#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/base/status.h"

namespace fitroom {

// A file that appears under its name only when it is whole: written under a name of its own beside it, flushed to the
// disk, then renamed. Two that write the same path do not meet; the later Commit() wins. Without Commit() nothing is
// left behind. Not thread-safe.
class AtomicFile {
 public:
  // Makes the temporary file, with the rights that the process gives to new files (its umask).
  static Result<AtomicFile> Create(const std::filesystem::path& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  // Removes the temporary file unless Commit() succeeded.
  ~AtomicFile();

  // Appends bytes. RESOURCE_EXHAUSTED [DISK_FULL], UNAVAILABLE [FILE_IO].
  Status Write(std::string_view bytes);
  // Replaces `path` by what was written; on failure the old file is unchanged. The last call.
  Status Commit();

 private:
  AtomicFile(std::filesystem::path path, std::string temporary, int descriptor);

  std::filesystem::path path_;
  std::string temporary_;  // Empty once it has been renamed.
  int descriptor_ = -1;
};

}  // namespace fitroom
