#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/garment_record/garment_record.h"
#include "shop_catalog/service/publication.h"

namespace fitroom::testing {

// Bytes that FakeExtractor() takes for a photograph; two seeds give two photographs.
std::string FakePhoto(uint32_t seed, size_t size);

// The statement of a T-shirt with a front and, unless it is empty, a back.
GarmentUploadStatement GarmentStatementOf(const std::string& id, const std::string& front, const std::string& back);

// The statement of a pair of trousers with front, back and side-folded photograph, and with all that a shop can state:
// fabric, chart and front rise of MakeSampleTrousers().
GarmentUploadStatement TrouserStatementOf(const std::string& id, const std::vector<std::string_view>& photos);

// Makes the garment of tests/support (one that ValidateGarment() accepts) out of what FakePhoto() makes, with the
// photographs as received; refuses everything else with FAILED_PRECONDITION [NO_GARMENT_FOUND].
Result<shop_catalog::GarmentExtraction> FakeExtractor(const shop_catalog::ExtractionRequest& request);

}  // namespace fitroom::testing
