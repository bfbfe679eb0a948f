#pragma once

#include <filesystem>
#include <memory>

#include "body_center/store/body_store.h"

namespace fitroom::body_center {

// Opens the store in `folder`, making both if they are not there; one process at a time (FAILED_PRECONDITION
// [FOLDER_IN_USE]). Originals are kept as independent zstd frames of up to 960 KiB of the file each, so that a download
// can begin anywhere.
Result<std::unique_ptr<BodyStore>> OpenSqliteBodyStore(const std::filesystem::path& folder);

}  // namespace fitroom::body_center
