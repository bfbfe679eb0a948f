// Any bytes through the readers of size charts and of garments: what they let through is valid, and what is written of
// it reads back.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/base/check.h"
#include "common/garment/garment_json.h"
#include "common/garment/size_chart_file.h"
#include "common/garment/validate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace fitroom;
  if (size == 0) return 0;
  const auto kind = static_cast<GarmentKind>(data[0] % kGarmentKindCount);
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Result<SizeChart> chart = SizeChartFromText(text, kind, "M");
  if (chart.ok()) {
    FR_CHECK(ValidateSizeChart(kind, *chart).ok());
    const Result<SizeChart> again = SizeChartFromText(SizeChartToCsv(*chart, kind), kind, "M");
    FR_CHECK(again.ok());
    FR_CHECK(again->sizes.size() == chart->sizes.size());
  }
  (void)PointAnnotationFromJson(text, kind);
  (void)ShopStatementFromJson(text);
  const Result<Garment> garment = GarmentFromJson(text);
  if (garment.ok()) FR_CHECK(GarmentFromJson(GarmentToJson(*garment)).ok());
  return 0;
}
