#pragma once

#include <filesystem>
#include <string_view>

#include "common/base/progress.h"
#include "common/remote/shop_client.h"

namespace fitroom::fit_client {

// Pulls a garment with all its images into the cache as a garment's folder (common/garment) and returns its record.
// Goes on with an interrupted pull; does nothing where the same garment is cached. The cache never shows half a
// garment. Errors of ShopClient, of the disk, and of ValidateGarment(): a shop is not trusted. Sends nothing but the
// id.
Result<GarmentRecord> PullGarment(remote::ShopClient& client, const std::filesystem::path& cache, std::string_view name,
                                  const ProgressSink& progress);

}  // namespace fitroom::fit_client
