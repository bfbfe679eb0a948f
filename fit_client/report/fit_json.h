#pragma once

// The parts of the JSON report that say how a garment fits. Private to fit_client/report.

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "fit_client/report/fit_report.h"

namespace fitroom {

// An array, one object a zone; a zone that was not measured has no numbers.
nlohmann::ordered_json ZonesJson(const std::vector<ZoneFit>& zones);
nlohmann::ordered_json VerdictJson(const SizeVerdict& verdict);
nlohmann::ordered_json SizesJson(const std::vector<SizeVerdict>& sizes);
nlohmann::ordered_json RecommendationJson(const std::optional<SizeRecommendation>& recommendation);
nlohmann::ordered_json MeasuresJson(const std::vector<GarmentMeasure>& measures);
nlohmann::ordered_json LayersJson(const std::vector<LayerReport>& layers);

}  // namespace fitroom
