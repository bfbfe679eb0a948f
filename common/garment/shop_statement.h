#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"

namespace fitroom {

// What a shop states of a garment beside its photographs and its length.
struct ShopStatement {
  std::string fabric = "jersey";         // See Garment::fabric.
  SizeChart chart;                       // May be empty.
  std::vector<GarmentMeasure> measures;  // By tape, flat: front_rise, thigh_width, …; provenance kStated.

  friend bool operator==(const ShopStatement&, const ShopStatement&) = default;
};

// Reads what a person types: "front_rise=24.5" (unit: cm). INVALID_ARGUMENT MEASURE_TEXT, MEASURE_UNKNOWN.
Result<GarmentMeasure> StatedMeasureFromText(std::string_view text, GarmentKind kind);

// Enters fabric, chart and measures into a garment; what is stated stands in for what was found of that name. Does not
// validate the garment.
void ApplyShopStatement(const ShopStatement& statement, Garment& garment);

}  // namespace fitroom
