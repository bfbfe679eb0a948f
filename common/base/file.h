#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/base/status.h"

namespace fitroom {

// A read-only memory map of a whole file. Owns the mapping; the view stays valid while the object lives.
class MappedFile {
 public:
  // Maps `path`. NOT_FOUND if it does not exist, INVALID_ARGUMENT for a folder or special file,
  // UNAVAILABLE where the system refuses. An empty file maps to an empty view.
  static Result<MappedFile> Open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::string_view text() const { return {static_cast<const char*>(address_), size_}; }
  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(address_), size_}; }

 private:
  MappedFile(void* address, size_t size) : address_(address), size_(size) {}
  void* address_ = nullptr;
  size_t size_ = 0;
};

// Reads a whole file of at most `max_size` bytes; RESOURCE_EXHAUSTED if it is larger.
Result<std::string> ReadFile(const std::filesystem::path& path, size_t max_size);

// Replaces `path` by `content` atomically: a temporary file beside it, flushed, then renamed. On failure the old file
// is unchanged.
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

}  // namespace fitroom
