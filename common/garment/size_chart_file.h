#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/garment/garment.h"

// Size charts as people write them.
//
// A table (CSV, as a spreadsheet saves it): the first line names the columns, each further line is a size, the smallest
// first.
//   size,chest_width,sleeve_length,body_bust
//   S,46,20.5,84
//   M,49,21,90
// Columns: "size" first; measures of the kind, flat, in centimetres; "body_bust", "body_waist", "body_hip", the full
// girths of the body that the size is cut for. An empty cell is not stated. Columns are parted by ',', ';' or tabs;
// with the last two a number may have a decimal comma. Lines that start with '#' and empty lines are skipped.
//
// JSON: {"photographed_size": "M", "sizes": [{"name": "S", "measures_cm": {"chest_width": 46}, "body_cm": {"bust":
// 84}}]}
namespace fitroom {

// Returns what --help says of such a file.
std::string SizeChartFileHelp();

// Reads a chart of either form and validates it. `photographed_size` says which size the photographs show; empty: the
// JSON's own, or the only size there is. INVALID_ARGUMENT CHART_FILE names line and column; CHART_PHOTOGRAPHED_SIZE;
// the reasons of ValidateSizeChart(). RESOURCE_EXHAUSTED CHART_FILE_TOO_LARGE above 256 KB.
Result<SizeChart> SizeChartFromText(std::string_view text, GarmentKind kind, std::string_view photographed_size);

// Reads such a file. Beside these the errors of ReadFile(); the message names the file.
Result<SizeChart> ReadSizeChartFile(const std::filesystem::path& path, GarmentKind kind,
                                    std::string_view photographed_size);

// Writes a chart as such a table, with the columns that any size states.
std::string SizeChartToCsv(const SizeChart& chart, GarmentKind kind);

}  // namespace fitroom
