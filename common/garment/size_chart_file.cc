#include "common/garment/size_chart_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "common/base/file.h"
#include "common/garment/json_reader.h"
#include "common/garment/measure_json.h"
#include "common/garment/validate.h"

namespace fitroom {
namespace {

constexpr size_t kMaxFileSize = size_t{256} << 10;  // (unit: byte)
constexpr size_t kMaxColumns = 64;
constexpr std::string_view kBodyPrefix = "body_";
constexpr std::array<std::string_view, 3> kGirthNames = {"bust", "waist", "hip"};

Status Bad(int line, const std::string& what) {
  return InvalidArgument("CHART_FILE", "line " + std::to_string(line) + ": " + what);
}

struct Line {
  int number = 0;  // In the file, from 1.
  std::string_view text;
};

// Returns the lines that hold something; ends in "\n", "\r\n" or "\r".
std::vector<Line> LinesOf(std::string_view text) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.find_first_not_of(" \t;,") != std::string_view::npos && line.front() != '#')
      lines.push_back({number, line});
    const bool is_pair = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (is_pair ? 2 : 1), text.size()));
  }
  return lines;
}

std::string Trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

// Parts a line at `separator`; a cell may stand in double quotes, in which two stand for one.
Result<std::vector<std::string>> CellsOf(const Line& line, char separator) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (size_t i = 0; i < line.text.size(); ++i) {
    const char c = line.text[i];
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t') return Bad(line.number, "holds a control character");
    if (c == '"') {
      const bool is_escaped = is_quoted && i + 1 < line.text.size() && line.text[i + 1] == '"';
      if (is_escaped) {
        cells.back() += c;
        ++i;
      } else {
        is_quoted = !is_quoted;
      }
    } else if (c == separator && !is_quoted) {
      if (cells.size() == kMaxColumns) return Bad(line.number, "has more than 64 columns");
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (is_quoted) return Bad(line.number, "a quoted cell does not end");
  for (std::string& cell : cells) cell = Trimmed(cell);
  return cells;
}

char SeparatorOf(std::string_view header) {
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

// "Chest width (cm)" and "chest_width_cm" are "chest_width".
std::string ColumnName(std::string cell) {
  for (char& c : cell) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == ' ' || c == '-') c = '_';
  }
  for (const std::string_view unit : {"_(cm)", "_cm"}) {
    if (cell.ends_with(unit)) cell.resize(cell.size() - unit.size());
  }
  return cell;
}

struct Column {
  std::string name;  // As in GarmentMeasure::name; "size" in the first.
  bool is_body = false;
};

Result<std::vector<Column>> ColumnsOf(const Line& header, char separator, GarmentKind kind) {
  FR_ASSIGN_OR_RETURN(const std::vector<std::string> cells, CellsOf(header, separator));
  const std::vector<std::string>& measures = MeasureNames(kind);
  std::vector<Column> columns;
  std::set<std::string> seen;
  for (const std::string& cell : cells) {
    const std::string name = ColumnName(cell);
    if (!seen.insert(name).second) return Bad(header.number, "column \"" + name.substr(0, 40) + "\" stands twice");
    Column column{name, false};
    if (columns.empty()) {
      if (name != "size") return Bad(header.number, "the first column must be named \"size\"");
    } else if (name.starts_with(kBodyPrefix)) {
      column = {name.substr(kBodyPrefix.size()), true};
      if (std::find(kGirthNames.begin(), kGirthNames.end(), column.name) == kGirthNames.end()) {
        return Bad(header.number, "column \"" + name.substr(0, 40) + "\": name body_bust, body_waist or body_hip");
      }
    } else if (std::find(measures.begin(), measures.end(), name) == measures.end()) {
      std::string known;
      for (const std::string& measure : measures) known += ", " + measure;
      return Bad(header.number, "column \"" + name.substr(0, 40) + "\" is not a measure of a " +
                                    std::string(GarmentKindName(kind)) + "; name" + known.substr(1) +
                                    ", body_bust, body_waist, body_hip");
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

Result<double> NumberOf(std::string cell, const Line& line, const Column& column, char separator) {
  if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
  double centimetres = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), centimetres);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(centimetres)) {
    return Bad(line.number,
               "column " + column.name + ": \"" + cell.substr(0, 40) + "\" is not a plain number of centimetres");
  }
  return FromCentimetres(centimetres);
}

Result<GarmentSize> SizeOf(const Line& line, const std::vector<Column>& columns, char separator) {
  FR_ASSIGN_OR_RETURN(const std::vector<std::string> cells, CellsOf(line, separator));
  if (cells.size() > columns.size()) {
    return Bad(line.number, "has " + std::to_string(cells.size()) + " cells under " + std::to_string(columns.size()) +
                                " column names");
  }
  if (cells[0].empty()) return Bad(line.number, "names no size");
  GarmentSize size;
  size.name = cells[0];
  for (size_t i = 1; i < cells.size(); ++i) {
    if (cells[i].empty()) continue;
    FR_ASSIGN_OR_RETURN(const double length, NumberOf(cells[i], line, columns[i], separator));
    (columns[i].is_body ? size.body : size.measures).push_back({columns[i].name, length, Provenance::kStated});
  }
  return size;
}

Result<SizeChart> ChartFromTable(std::string_view text, GarmentKind kind) {
  const std::vector<Line> lines = LinesOf(text);
  if (lines.size() < 2) return Bad(1, "the table needs a line of column names and a line for each size");
  if (lines.size() - 1 > static_cast<size_t>(kMaxChartSizes)) {
    return Bad(lines[static_cast<size_t>(kMaxChartSizes) + 1].number,
               "more than " + std::to_string(kMaxChartSizes) + " sizes");
  }
  const char separator = SeparatorOf(lines[0].text);
  FR_ASSIGN_OR_RETURN(const std::vector<Column> columns, ColumnsOf(lines[0], separator, kind));
  SizeChart chart;
  for (size_t i = 1; i < lines.size(); ++i) {
    FR_ASSIGN_OR_RETURN(GarmentSize size, SizeOf(lines[i], columns, separator));
    chart.sizes.push_back(std::move(size));
  }
  return chart;
}

Result<SizeChart> ChartFromJsonText(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const Json json, ParseJsonObject(text, kMaxFileSize, "CHART_FILE"));
  return ChartFromJson(ObjectReader(json, "chart", "CHART_FILE"));
}

}  // namespace

std::string SizeChartFileHelp() {
  std::set<std::string> names;
  for (int kind = 0; kind < kGarmentKindCount; ++kind) {
    for (const std::string& name : MeasureNames(static_cast<GarmentKind>(kind))) names.insert(name);
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  return "Size chart: a CSV table with the columns size (first), flat measures in cm (" + known +
         "; each kind has its own) and body_bust, body_waist, body_hip (full girths in cm); one line a size, the "
         "smallest first. Or JSON: {\"photographed_size\": \"M\", \"sizes\": [{\"name\": \"S\", \"measures_cm\": "
         "{\"chest_width\": 46}, \"body_cm\": {\"bust\": 84}}, ...]}";
}

Result<SizeChart> SizeChartFromText(std::string_view text, GarmentKind kind, std::string_view photographed_size) {
  if (text.size() > kMaxFileSize) {
    return ResourceExhausted("CHART_FILE_TOO_LARGE", "a size chart has at most 256 KB");
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const size_t first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string_view::npos && text[first] == '{';
  FR_ASSIGN_OR_RETURN(SizeChart chart, is_json ? ChartFromJsonText(text) : ChartFromTable(text, kind));
  if (!photographed_size.empty()) chart.photographed_size = photographed_size;
  if (chart.photographed_size.empty() && chart.sizes.size() == 1) chart.photographed_size = chart.sizes[0].name;
  if (chart.photographed_size.empty()) {
    return InvalidArgument("CHART_PHOTOGRAPHED_SIZE",
                           "which size do the photographs show? State it with --photographed-size");
  }
  FR_RETURN_IF_ERROR(ValidateSizeChart(kind, chart));
  return chart;
}

Result<SizeChart> ReadSizeChartFile(const std::filesystem::path& path, GarmentKind kind,
                                    std::string_view photographed_size) {
  FR_ASSIGN_OR_RETURN(const std::string text, ReadFile(path, kMaxFileSize));
  Result<SizeChart> chart = SizeChartFromText(text, kind, photographed_size);
  if (!chart.ok()) return chart.status().At(path.string());
  return chart;
}

std::string SizeChartToCsv(const SizeChart& chart, GarmentKind kind) {
  std::vector<Column> columns;
  for (const std::string& name : MeasureNames(kind)) columns.push_back({name, false});
  for (const std::string_view name : kGirthNames) columns.push_back({std::string(name), true});
  const auto cell_of = [](const GarmentSize& size, const Column& column) {
    return FindMeasure(column.is_body ? size.body : size.measures, column.name);
  };
  std::erase_if(columns, [&](const Column& column) {
    return std::none_of(chart.sizes.begin(), chart.sizes.end(),
                        [&](const GarmentSize& size) { return cell_of(size, column) != nullptr; });
  });
  std::string text = "size";
  for (const Column& column : columns) text += "," + std::string(column.is_body ? kBodyPrefix : "") + column.name;
  text += "\n";
  for (const GarmentSize& size : chart.sizes) {
    // A name may hold a comma or a quote.
    text += '"';
    for (const char c : size.name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    text += '"';
    for (const Column& column : columns) {
      text += ',';
      const GarmentMeasure* measure = cell_of(size, column);
      if (measure == nullptr) continue;
      std::array<char, 40> number{};
      std::snprintf(number.data(), number.size(), "%.2f", ToCentimetres(measure->value));
      text += number.data();
    }
    text += "\n";
  }
  return text;
}

}  // namespace fitroom
