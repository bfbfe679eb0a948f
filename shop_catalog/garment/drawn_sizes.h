#pragma once

#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "shop_catalog/garment/fork_draft.h"

namespace fitroom::shop_catalog {

// The girths that a size is cut for (unit: centimetre).
struct BodyGirths {
  double bust = 92.0;
  double waist = 76.0;
  double hip = 100.0;
};

// Returns the sizes in which a kind is drawn: women's 6 to 24, or XS to XXL where `photographed_size` is a letter, with
// the body girths of EN 13402-3. INVALID_ARGUMENT SIZE_UNKNOWN where there is no such size; the message lists them.
Result<SizeChart> DrawnSizeChart(GarmentKind kind, std::string_view photographed_size, ForkRule rule);

// Returns the flat measures of a kind, cut for a body (unit: metre). The rules are ours; they stand beside the numbers.
std::vector<GarmentMeasure> DrawnMeasures(GarmentKind kind, const BodyGirths& body, ForkRule rule);

// Returns the fabric in which a kind is drawn: a preset of the fit.
std::string_view DrawnFabric(GarmentKind kind);

// Checks measures with which something else than a built-in size is to be drawn: INVALID_ARGUMENT MEASURE_OUT_OF_RANGE
// naming the measure and its range, which goes a third beyond the smallest and largest size.
Status ValidateDrawnMeasures(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

// Writes a chart as JSON: what `extract --chart` reads.
std::string SizeChartAsJson(const SizeChart& chart, std::string_view fabric);

}  // namespace fitroom::shop_catalog
