#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "common/base/progress.h"
#include "common/base/status.h"
#include "common/codec/hash.h"

namespace fitroom::fit_client {

// Sends bytes from an offset on to a sink, as BodyClient and ShopClient do.
using ByteStream = std::function<Status(int64_t offset, const std::function<Status(std::string_view)>& sink)>;

// Downloads into `path` and goes on where an earlier, interrupted download to the same path stopped. On success the
// file has exactly `size` bytes with that hash and is flushed to disk. DATA_LOSS [DOWNLOAD_HASH_MISMATCH] removes the
// file.
Status DownloadResumed(const std::filesystem::path& path, int64_t size, const Hash256& hash, const ByteStream& stream,
                       const ProgressSink& progress);

// Makes a folder that only its owner may enter, with all folders above it.
Status MakePrivateFolder(const std::filesystem::path& folder);

// Puts the finished folder `partial` in the place of `folder`, which may be there already: in one step, where the file
// system can exchange two names, so that nobody ever finds it missing. On failure what was there stays there.
Status ReplaceFolder(const std::filesystem::path& partial, const std::filesystem::path& folder);

}  // namespace fitroom::fit_client
