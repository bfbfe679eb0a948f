#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "common/garment/validate.h"

namespace fitroom {
namespace {

constexpr double kMinMeasure = 0.01;  // (unit: metre)
constexpr double kMaxMeasure = 2.5;   // (unit: metre)
constexpr double kMinGirth = 0.4;     // Of a body (unit: metre).
constexpr double kMaxGirth = 2.0;     // (unit: metre)
// From one size to the next a measure grows by a tenth where steps are wide (S, M, L) and by a third where a chart
// leaves sizes out; a misplaced decimal point is a factor of ten, a girth in place of a flat width one of two.
constexpr double kMaxStep = 1.45;
// Elastic waists are photographed relaxed and charted stretched, about half as wide again; inches for centimetres are
// 2.54, girths for flat widths 2.
constexpr double kMaxAgainstPhotograph = 1.7;

constexpr std::array<std::string_view, 4> kFabrics = {"jersey", "woven", "denim", "stretch"};
constexpr std::array<std::string_view, 3> kGirthNames = {"bust", "waist", "hip"};

// Between a newborn's and the largest sizes that are sold.
struct PlausibleRange {
  std::string_view name;
  double least;  // (unit: metre)
  double most;   // (unit: metre)
};
constexpr PlausibleRange kPlausible[] = {
    {"shoulder_width", 0.10, 1.00}, {"chest_width", 0.15, 1.20}, {"waist_width", 0.12, 1.20},
    {"hip_width", 0.15, 1.20},      {"hem_width", 0.05, 2.50},   {"sleeve_length", 0.02, 1.10},
    {"sleeve_opening", 0.03, 0.80}, {"neck_width", 0.05, 0.60},  {"front_length", 0.15, 2.00},
    {"back_length", 0.15, 2.00},    {"thigh_width", 0.08, 0.80}, {"knee_width", 0.06, 0.70},
    {"front_rise", 0.08, 0.60},     {"back_rise", 0.10, 0.70},   {"inseam", 0.01, 1.20},
    {"length", 0.10, 2.00},
};

std::string Centimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f cm", metres * 100.0);
  return text;
}

std::string Quoted(const std::string& text) { return "\"" + text.substr(0, 40) + "\""; }

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool IsIn(double value, double least, double most) { return value >= least && value <= most; }

// A name and nothing else: printable, so that a table and a terminal show it as it is.
bool IsSizeName(const std::string& name) {
  const auto is_printable = [](unsigned char c) { return c >= 0x20 && c < 0x7f; };
  return !name.empty() && name.size() <= static_cast<size_t>(kMaxSizeNameSize) && name.front() != ' ' &&
         name.back() != ' ' && std::all_of(name.begin(), name.end(), is_printable);
}

Status CheckSizeNames(const SizeChart& chart) {
  std::set<std::string> names;
  std::vector<std::string> order;
  for (const GarmentSize& size : chart.sizes) {
    order.push_back(size.name);
    if (!IsSizeName(size.name)) {
      return InvalidArgument("CHART_SIZE_NAME", "size " + std::to_string(names.size() + 1) +
                                                    " of the chart: a size's name is 1 to 16 printable ASCII "
                                                    "characters without spaces at its ends");
    }
    if (!names.insert(size.name).second) {
      return InvalidArgument("CHART_SIZE_NAME", "size " + size.name + " stands twice in the chart; keep one row");
    }
  }
  if (!names.contains(chart.photographed_size)) {
    return InvalidArgument("CHART_PHOTOGRAPHED_SIZE",
                           "the photographed size " + Quoted(chart.photographed_size) +
                               " is none of the chart's; name the size that the photographs show: " + Listed(order));
  }
  return {};
}

Status CheckRow(GarmentKind kind, const GarmentSize& size) {
  const std::vector<std::string>& known = MeasureNames(kind);
  std::set<std::string_view> seen;
  for (const GarmentMeasure& measure : size.measures) {
    if (std::find(known.begin(), known.end(), measure.name) == known.end()) {
      return InvalidArgument("CHART_MEASURE", "size " + size.name + ": " + Quoted(measure.name) +
                                                  " is not a measure of a " + std::string(GarmentKindName(kind)) +
                                                  "; name " + Listed(known));
    }
    if (!seen.insert(measure.name).second) {
      return InvalidArgument("CHART_MEASURE", "size " + size.name + " states " + measure.name + " twice");
    }
    if (!IsIn(measure.value, kMinMeasure, kMaxMeasure)) {
      return InvalidArgument("CHART_MEASURE", "size " + size.name + ": a " + measure.name + " of " +
                                                  Centimetres(measure.value) +
                                                  " cannot be; state flat centimetres, 1 to 250");
    }
  }
  seen.clear();
  for (const GarmentMeasure& girth : size.body) {
    if (std::find(kGirthNames.begin(), kGirthNames.end(), girth.name) == kGirthNames.end() ||
        !seen.insert(girth.name).second) {
      return InvalidArgument("CHART_BODY_GIRTH", "size " + size.name + ": " + Quoted(girth.name) +
                                                     " is not a body girth, or stands twice; name bust, waist and hip");
    }
    if (!IsIn(girth.value, kMinGirth, kMaxGirth)) {
      return InvalidArgument("CHART_BODY_GIRTH", "size " + size.name + ": a body's " + girth.name + " of " +
                                                     Centimetres(girth.value) +
                                                     " cannot be; state the full girth in centimetres, 40 to 200");
    }
  }
  return {};
}

// Body girths grow from each size that states one to the next that does.
Status CheckGirthsGrow(const SizeChart& chart) {
  for (const std::string_view name : kGirthNames) {
    const GarmentSize* before = nullptr;
    for (const GarmentSize& size : chart.sizes) {
      const GarmentMeasure* girth = FindMeasure(size.body, name);
      if (girth == nullptr) continue;
      if (before != nullptr && !(girth->value > FindMeasure(before->body, name)->value)) {
        return InvalidArgument("CHART_BODY_GIRTH", "the body's " + std::string(name) + " does not grow from size " +
                                                       before->name + " to " + size.name +
                                                       "; order the sizes from the smallest up and check the girths");
      }
      before = &size;
    }
  }
  return {};
}

// One step of the chart: something that all sizes state grows, and nothing leaps.
Status CheckStep(const GarmentSize& smaller, const GarmentSize& larger, const std::vector<std::string>& shared) {
  bool grows = false;
  for (const GarmentMeasure& measure : larger.measures) {
    const GarmentMeasure* before = FindMeasure(smaller.measures, measure.name);
    if (before == nullptr) continue;
    const bool is_shared = std::find(shared.begin(), shared.end(), measure.name) != shared.end();
    grows = grows || (is_shared && measure.value > before->value);
    const double ratio = measure.value / before->value;
    if (ratio > kMaxStep || ratio < 1.0 / kMaxStep) {
      return InvalidArgument("CHART_JUMP", measure.name + " jumps from " + Centimetres(before->value) + " in size " +
                                               smaller.name + " to " + Centimetres(measure.value) + " in size " +
                                               larger.name + "; check the decimal point");
    }
  }
  if (grows) return {};
  return InvalidArgument("CHART_NOT_INCREASING", "no measure grows from size " + smaller.name + " to " + larger.name +
                                                     "; order the sizes from the smallest up and check both rows");
}

Status CheckStatedMeasure(GarmentKind kind, const GarmentMeasure& measure) {
  const std::vector<std::string>& known = MeasureNames(kind);
  const PlausibleRange* range = std::find_if(std::begin(kPlausible), std::end(kPlausible),
                                             [&](const PlausibleRange& r) { return r.name == measure.name; });
  if (range == std::end(kPlausible) || std::find(known.begin(), known.end(), measure.name) == known.end()) {
    return InvalidArgument("GARMENT_MEASURE", Quoted(measure.name) + " is not a measure of a " +
                                                  std::string(GarmentKindName(kind)) + "; name " + Listed(known));
  }
  if (IsIn(measure.value, range->least, range->most)) return {};
  return InvalidArgument("GARMENT_MEASURE", "a " + measure.name + " of " + Centimetres(measure.value) +
                                                " cannot be; measure it flat, " + Centimetres(range->least) + " to " +
                                                Centimetres(range->most));
}

}  // namespace

Status ValidateSizeChart(GarmentKind kind, const SizeChart& chart) {
  if (chart.sizes.empty() || chart.sizes.size() > static_cast<size_t>(kMaxChartSizes)) {
    return InvalidArgument("CHART_SIZE_COUNT", "a size chart has 1 to " + std::to_string(kMaxChartSizes) +
                                                   " sizes, not " + std::to_string(chart.sizes.size()));
  }
  FR_RETURN_IF_ERROR(CheckSizeNames(chart));
  for (const GarmentSize& size : chart.sizes) FR_RETURN_IF_ERROR(CheckRow(kind, size));
  std::vector<std::string> shared;
  for (const GarmentMeasure& measure : chart.sizes.front().measures) {
    const auto states = [&](const GarmentSize& size) { return FindMeasure(size.measures, measure.name) != nullptr; };
    if (std::all_of(chart.sizes.begin(), chart.sizes.end(), states)) shared.push_back(measure.name);
  }
  if (shared.empty()) {
    return InvalidArgument("CHART_NO_SHARED_MEASURE", "no measure is stated for all sizes; state at least one of " +
                                                          Listed(MeasureNames(kind)) + " in every row");
  }
  for (size_t i = 1; i < chart.sizes.size(); ++i) {
    FR_RETURN_IF_ERROR(CheckStep(chart.sizes[i - 1], chart.sizes[i], shared));
  }
  return CheckGirthsGrow(chart);
}

Status ValidateFabric(std::string_view fabric) {
  if (std::find(kFabrics.begin(), kFabrics.end(), fabric) != kFabrics.end()) return {};
  return InvalidArgument("FABRIC_UNKNOWN",
                         Quoted(std::string(fabric)) + " is not a fabric; name jersey, woven, denim or stretch");
}

Status ValidateMeasures(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  if (measures.size() > 100) return InvalidArgument("GARMENT_MEASURE", "more than 100 measures");
  std::set<std::string_view> seen;
  for (const GarmentMeasure& measure : measures) {
    if (!seen.insert(measure.name).second) {
      return InvalidArgument("GARMENT_MEASURE", "measure " + Quoted(measure.name) + " is given twice");
    }
    const bool is_unknown = measure.provenance == Provenance::kUnknown;
    if (measure.name.empty() || measure.name.size() > 63 || !IsIn(measure.value, 0.0, is_unknown ? 0.0 : 10.0)) {
      return InvalidArgument("GARMENT_MEASURE", "measure " + Quoted(measure.name) + " is out of range");
    }
    if (measure.provenance == Provenance::kStated) FR_RETURN_IF_ERROR(CheckStatedMeasure(kind, measure));
  }
  return {};
}

Status ValidateShopStatement(GarmentKind kind, const ShopStatement& statement) {
  FR_RETURN_IF_ERROR(ValidateFabric(statement.fabric));
  for (const GarmentMeasure& measure : statement.measures) {
    if (measure.provenance == Provenance::kStated) continue;
    return InvalidArgument("GARMENT_MEASURE", "measure " + Quoted(measure.name) + " is not one that a shop states");
  }
  FR_RETURN_IF_ERROR(ValidateMeasures(kind, statement.measures));
  return statement.chart == SizeChart{} ? Status() : ValidateSizeChart(kind, statement.chart);
}

Status CheckChartAgainstPhotographs(const Garment& garment) {
  const GarmentSize* size = FindSize(garment.chart, garment.chart.photographed_size);
  if (size == nullptr) return {};
  for (const GarmentMeasure& charted : size->measures) {
    const GarmentMeasure* measured = FindMeasure(garment.measures, charted.name);
    if (measured == nullptr || measured->provenance != Provenance::kMeasured || measured->value < kMinMeasure) continue;
    const double ratio = charted.value / measured->value;
    if (ratio < kMaxAgainstPhotograph && ratio > 1.0 / kMaxAgainstPhotograph) continue;
    return InvalidArgument("CHART_CONTRADICTS_PHOTOGRAPH",
                           "the chart gives size " + size->name + " a " + charted.name + " of " +
                               Centimetres(charted.value) + ", the photographs show " + Centimetres(measured->value) +
                               "; state flat widths, not girths, in centimetres, and the size that was photographed");
  }
  return {};
}

}  // namespace fitroom
