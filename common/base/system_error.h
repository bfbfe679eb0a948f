#pragma once

#include <filesystem>

#include "common/base/status.h"

namespace fitroom {

// Says what the operating system refused, with the file's name. `error` is an errno: NOT_FOUND [FILE_NOT_FOUND],
// PERMISSION_DENIED with `refused` as the reason, RESOURCE_EXHAUSTED [DISK_FULL], else UNAVAILABLE [FILE_IO].
Status SystemError(const std::filesystem::path& path, int error, const char* refused);

}  // namespace fitroom
