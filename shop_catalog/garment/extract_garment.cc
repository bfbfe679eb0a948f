#include "shop_catalog/garment/extract_garment.h"

namespace fitroom::shop_catalog {

Result<GarmentExtraction> ExtractGarment(const ExtractionRequest&) {
  return Status(StatusCode::kUnimplemented, "NOT_BUILT_YET", "extraction is not built yet");
}

}  // namespace fitroom::shop_catalog
