#include "common/garment/size_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace fitroom {
namespace {

// Girths that no person has are a mistake of unit (unit: metre).
constexpr double kLeastGirth = 0.3;
constexpr double kLargestGirth = 3.0;
// How far beyond a chart of one size a body is outside it (unit: metre); half a step of EN 13402-3.
constexpr double kHalfStep = 0.02;
// Two sizes nearer than this are one (unit: metre).
constexpr double kSameGirth = 0.0005;

struct SizeGirth {
  int index = 0;
  double girth = 0.0;  // (unit: metre)
};

std::optional<double> GirthOf(const BodyGirths& body, PrimaryDimension dimension) {
  switch (dimension) {
    case PrimaryDimension::kBust:
      return body.bust;
    case PrimaryDimension::kWaist:
      return body.waist;
    case PrimaryDimension::kHip:
      return body.hip;
  }
  return std::nullopt;
}

const char* FlatWidthName(PrimaryDimension dimension) {
  switch (dimension) {
    case PrimaryDimension::kBust:
      return "chest_width";
    case PrimaryDimension::kWaist:
      return "waist_width";
    case PrimaryDimension::kHip:
      return "hip_width";
  }
  return "";
}

bool IsKnown(const GarmentMeasure* measure) {
  return measure != nullptr && measure->provenance != Provenance::kUnknown && measure->value > 0.0 &&
         std::isfinite(measure->value);
}

// The girth of the body that a garment of this flat width is for: girth - ease(girth), where the ease of knits is a
// share of the body's girth.
double BodyGirthForWidth(GarmentKind kind, std::string_view fabric, PrimaryDimension dimension, double width) {
  const double fixed = ClassEase(kind, fabric, dimension, 0.0);
  const double share = ClassEase(kind, fabric, dimension, 1.0) - fixed;
  return (2.0 * width - fixed) / (1.0 + share);
}

// The sizes that state the dimension, smallest first. Body girths where any size has them, else flat widths.
std::vector<SizeGirth> GirthsOf(GarmentKind kind, std::string_view fabric, const SizeChart& chart,
                                PrimaryDimension dimension, bool from_flat) {
  std::vector<SizeGirth> girths;
  for (size_t i = 0; i < chart.sizes.size(); ++i) {
    const GarmentSize& size = chart.sizes[i];
    const GarmentMeasure* measure = from_flat ? FindMeasure(size.measures, FlatWidthName(dimension))
                                              : FindMeasure(size.body, PrimaryDimensionName(dimension));
    if (!IsKnown(measure)) continue;
    girths.push_back(
        {static_cast<int>(i), from_flat ? BodyGirthForWidth(kind, fabric, dimension, measure->value) : measure->value});
  }
  std::stable_sort(girths.begin(), girths.end(),
                   [](const SizeGirth& a, const SizeGirth& b) { return a.girth < b.girth; });
  return girths;
}

SizeChoice Choose(const SizeChart& chart, const std::vector<SizeGirth>& girths, double body, double uncertainty) {
  const auto distance = [&](size_t i) { return std::abs(girths[i].girth - body); };
  const auto name = [&](size_t i) { return chart.sizes[static_cast<size_t>(girths[i].index)].name; };
  size_t best = 0;
  for (size_t i = 1; i < girths.size(); ++i) {
    if (distance(i) <= distance(best)) best = i;  // The larger of equals.
  }
  SizeChoice choice;
  choice.index = girths[best].index;
  choice.size = name(best);
  choice.size_girth = girths[best].girth;
  choice.difference = girths[best].girth - body;
  double half_step = kHalfStep;
  if (best > 0) {
    choice.smaller = name(best - 1);
    choice.smaller_margin = distance(best - 1) - distance(best);
    if (choice.smaller_margin < uncertainty) choice.between_with = choice.smaller;
    if (best + 1 == girths.size()) half_step = 0.5 * (girths[best].girth - girths[best - 1].girth);
  }
  if (best + 1 < girths.size()) {
    choice.larger = name(best + 1);
    choice.larger_margin = distance(best + 1) - distance(best);
    const bool nearer = choice.smaller.empty() || choice.larger_margin <= choice.smaller_margin;
    if (choice.larger_margin < uncertainty && nearer) choice.between_with = choice.larger;
    if (best == 0) half_step = 0.5 * (girths[1].girth - girths[0].girth);
  }
  const bool below = best == 0 && choice.difference > half_step;
  const bool above = best + 1 == girths.size() && -choice.difference > half_step;
  choice.outside_chart = below || above;
  return choice;
}

}  // namespace

PrimaryDimension PrimaryDimensionOf(GarmentKind kind) {
  return IsBottom(kind) ? PrimaryDimension::kHip : PrimaryDimension::kBust;
}

std::string_view PrimaryDimensionName(PrimaryDimension dimension) {
  constexpr std::array<std::string_view, 3> kNames = {"bust", "waist", "hip"};
  return kNames[static_cast<size_t>(dimension)];
}

double ClassEase(GarmentKind kind, std::string_view fabric, PrimaryDimension dimension, double body_girth) {
  const size_t d = static_cast<size_t>(dimension);
  // Shares of the body's girth at bust, waist, hip: the border fitted/loose, and the middle of "very fitted".
  constexpr std::array<double, 3> kJersey = {0.05, 0.10, 0.10};
  constexpr std::array<double, 3> kStretch = {-0.05, -0.05, 0.025};
  if (fabric == "jersey") return kJersey[d] * body_girth;
  if (fabric == "stretch") return kStretch[d] * body_girth;
  // Least wearing ease of woven garments, the middle of its band (unit: metre).
  constexpr std::array<double, 3> kWovenTop = {0.045, 0.022, 0.060};
  constexpr std::array<double, 3> kWovenBottom = {0.045, 0.016, 0.060};
  return IsBottom(kind) ? kWovenBottom[d] : kWovenTop[d];
}

Result<SizeChoice> ChooseSize(GarmentKind kind, std::string_view fabric, const SizeChart& chart, const BodyGirths& body,
                              double uncertainty) {
  if (chart.sizes.empty()) {
    return FailedPrecondition("CHART_EMPTY", "the garment has no size chart; publish one with at least one size");
  }
  using enum PrimaryDimension;
  const std::array<PrimaryDimension, 3> order =
      IsBottom(kind) ? std::array{kHip, kWaist, kBust} : std::array{kBust, kWaist, kHip};
  for (const PrimaryDimension dimension : order) {
    const std::optional<double> girth = GirthOf(body, dimension);
    if (!girth) continue;
    if (!(*girth >= kLeastGirth && *girth <= kLargestGirth)) {
      return InvalidArgument("BODY_GIRTH_OUT_OF_RANGE", "the body's " + std::string(PrimaryDimensionName(dimension)) +
                                                            " girth must lie between 30 and 300 cm; check the unit");
    }
    for (const bool from_flat : {false, true}) {
      const std::vector<SizeGirth> girths = GirthsOf(kind, fabric, chart, dimension, from_flat);
      if (girths.empty()) continue;
      for (size_t i = 1; i < girths.size(); ++i) {
        if (girths[i].girth - girths[i - 1].girth > kSameGirth) continue;
        return FailedPrecondition("CHART_NOT_A_GRADING",
                                  "sizes " + chart.sizes[static_cast<size_t>(girths[i - 1].index)].name + " and " +
                                      chart.sizes[static_cast<size_t>(girths[i].index)].name + " have the same " +
                                      std::string(PrimaryDimensionName(dimension)) + " girth; correct the size chart");
      }
      SizeChoice choice = Choose(chart, girths, *girth, uncertainty);
      choice.dimension = dimension;
      choice.from_flat_measures = from_flat;
      return choice;
    }
  }
  return FailedPrecondition("CHART_WITHOUT_DIMENSION",
                            "the size chart states neither the body's girth nor the garment's flat width at " +
                                std::string(PrimaryDimensionName(order[0])) + ", waist or " +
                                std::string(PrimaryDimensionName(order[2])) + "; add one of them to every size");
}

}  // namespace fitroom
