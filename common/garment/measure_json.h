#pragma once

#include <vector>

#include "common/garment/garment.h"
#include "common/garment/json_reader.h"

// Measures and charts as JSON, shared by garment.json, by chart files and by what a store keeps of a statement. Not for
// other rooms.
namespace fitroom {

// Lengths that people state are whole tenths of a millimetre: so they come back from centimetres bit for bit. Values
// that are no such number are rounded, those that are not finite are passed on. Unit: metre.
double FromCentimetres(double centimetres);
double ToCentimetres(double metres);

// {"chest_width": 48.0, "front_rise": {"cm": 24.5, "provenance": "stated"}, "back_rise": {"provenance": "unknown"}}:
// what was measured is a bare number.
Json MeasuresToJson(const std::vector<GarmentMeasure>& measures);
Result<std::vector<GarmentMeasure>> MeasuresFromJson(const ObjectReader& reader);

// {"photographed_size": "M", "sizes": [{"name": "S", "measures_cm": {…}, "body_cm": {…}}, …]}; all bare numbers.
Json ChartToJson(const SizeChart& chart);
// Reads form and bounds; ValidateSizeChart() says whether it is a chart of the kind. Without "photographed_size" that
// stays empty.
Result<SizeChart> ChartFromJson(const ObjectReader& reader);

}  // namespace fitroom
