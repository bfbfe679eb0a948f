#pragma once

#include <filesystem>
#include <string_view>

#include "common/base/progress.h"
#include "common/remote/body_client.h"

namespace fitroom::fit_client {

// Pulls a scan's packed mesh and record into the cache (fit_client/cache) and returns the record; the last registered
// scan if only a body is named. Goes on with an interrupted pull; does nothing where the same scan is cached. The cache
// never shows half a scan. NOT_FOUND [BODY_NOT_FOUND] if the body has no scans; errors of BodyClient and of the disk.
Result<ScanRecord> PullBody(remote::BodyClient& client, const std::filesystem::path& cache, std::string_view name,
                            const ProgressSink& progress);

}  // namespace fitroom::fit_client
