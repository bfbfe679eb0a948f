#pragma once

#include <filesystem>
#include <memory>

#include "shop_catalog/store/garment_store.h"

namespace fitroom::shop_catalog {

// Opens the store in `folder`, making both if they are not there; one process at a time (FAILED_PRECONDITION
// [FOLDER_IN_USE]). Images are kept as they are: they are compressed already.
Result<std::unique_ptr<GarmentStore>> OpenSqliteGarmentStore(const std::filesystem::path& folder);

}  // namespace fitroom::shop_catalog
