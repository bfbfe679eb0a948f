#pragma once

#include <functional>
#include <string_view>

#include "shop_catalog/garment/extract_garment.h"
#include "shop_catalog/store/garment_store.h"

namespace fitroom::shop_catalog {

using GarmentExtractor = std::function<Result<GarmentExtraction>(const ExtractionRequest& request)>;

// Ends an upload: reads the photographs back from the store, checks size and hash of what is really held, extracts the
// garment and publishes it with its images in one transaction.
// FAILED_PRECONDITION [UPLOAD_INCOMPLETE], CANCELLED and the store's own errors leave the upload as it is; DATA_LOSS
// [UPLOAD_HASH_MISMATCH] and a refusal by the extractor drop it. Nothing is published unless the answer is OK.
Result<GarmentRecord> FinishPublication(GarmentStore& store, const GarmentExtractor& extractor,
                                        std::string_view upload_id, const std::function<bool()>& is_cancelled);

}  // namespace fitroom::shop_catalog
