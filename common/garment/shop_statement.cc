#include "common/garment/shop_statement.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fitroom {

Result<GarmentMeasure> StatedMeasureFromText(std::string_view text, GarmentKind kind) {
  const size_t middle = std::min(text.find('='), text.size());
  const std::string name(text.substr(0, middle));
  const std::vector<std::string>& names = MeasureNames(kind);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const std::string& candidate : names) known += (known.empty() ? "" : ", ") + candidate;
    return InvalidArgument("MEASURE_UNKNOWN", "\"" + name.substr(0, 40) + "\" is not a measure of a " +
                                                  std::string(GarmentKindName(kind)) + "; name one of " + known);
  }
  double centimetres = 0.0;
  const char* const first = text.data() + std::min(middle + 1, text.size());
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, centimetres);
  if (error != std::errc() || end != last || !std::isfinite(centimetres)) {
    return InvalidArgument("MEASURE_TEXT", name + ": write a measure as NAME=CM, for example " + name + "=24.5");
  }
  return GarmentMeasure{name, std::round(centimetres * 100.0) / 1e4, Provenance::kStated};
}

void ApplyShopStatement(const ShopStatement& statement, Garment& garment) {
  garment.fabric = statement.fabric;
  garment.chart = statement.chart;
  for (const GarmentMeasure& stated : statement.measures) {
    const auto known = std::find_if(garment.measures.begin(), garment.measures.end(),
                                    [&](const GarmentMeasure& measure) { return measure.name == stated.name; });
    if (known == garment.measures.end()) {
      garment.measures.push_back(stated);
    } else {
      *known = stated;
    }
  }
}

}  // namespace fitroom
