#include "fit_client/fit/grading/grade_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace fitroom::grading {
namespace {

using Names = std::vector<std::string>;

// Chart and photograph measure the same up to here (share of the chart's measure).
constexpr double kSameMeasure = 0.10;
// Beyond these the chart is of another garment or another unit.
constexpr double kMostDisagreement = 2.5;
constexpr double kMostGrading = 3.0;
constexpr double kLongestMeasure = 3.0;  // (unit: metre)
constexpr double kLeastOpening = 0.04;   // Flat width (unit: metre).

std::string Centimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f cm", metres * 100.0);
  return text;
}

// What a measure follows that the chart does not give, the nearest first.
const Names& Neighbours(GarmentKind kind, const std::string& name) {
  static const std::map<std::string, Names> kTop = {
      {"neck_width", {"shoulder_width", "chest_width", "waist_width", "hip_width", "hem_width"}},
      {"shoulder_width", {"chest_width", "neck_width", "waist_width", "hip_width", "hem_width"}},
      {"chest_width", {"waist_width", "shoulder_width", "hip_width", "hem_width"}},
      {"waist_width", {"chest_width", "hip_width", "hem_width", "shoulder_width"}},
      {"hip_width", {"hem_width", "waist_width", "chest_width", "shoulder_width"}},
      {"hem_width", {"hip_width", "waist_width", "chest_width", "shoulder_width"}},
      {"sleeve_opening", {"chest_width", "shoulder_width", "waist_width", "hip_width", "hem_width"}},
      {"sleeve_length", {"back_length", "front_length"}},
      {"front_length", {"back_length", "sleeve_length"}},
      {"back_length", {"front_length", "sleeve_length"}}};
  static const std::map<std::string, Names> kBottom = {
      {"waist_width", {"hip_width", "thigh_width", "knee_width", "hem_width"}},
      {"hip_width", {"waist_width", "thigh_width", "knee_width", "hem_width"}},
      {"thigh_width", {"hip_width", "waist_width", "knee_width", "hem_width"}},
      {"knee_width", {"thigh_width", "hem_width", "hip_width", "waist_width"}},
      {"hem_width", {"knee_width", "thigh_width", "hip_width", "waist_width"}},
      {"length", {"inseam"}},
      {"inseam", {"length"}}};
  static const Names kNone;
  const auto& table = IsBottom(kind) ? kBottom : kTop;
  const auto found = table.find(name);
  return found == table.end() ? kNone : found->second;
}

bool IsWidth(const std::string& name) { return name.ends_with("_width") || name == "sleeve_opening"; }

using Ratios = std::map<std::string, double>;

// The chart's measure if it is stated, checked; 0 if it is not.
Result<double> ChartValue(const GarmentSize& size, const std::string& name) {
  const GarmentMeasure* measure = FindMeasure(size.measures, name);
  if (measure == nullptr || measure->provenance == Provenance::kUnknown) return 0.0;
  if (std::isfinite(measure->value) && measure->value > 0.0 && measure->value <= kLongestMeasure) return measure->value;
  return InvalidArgument("CHART_MEASURE_ABSURD",
                         "size " + size.name + ": " + name + " must lie between 0 and 300 cm; correct the size chart");
}

// How fast lengths grow that nothing states: half as fast as the girths.
double LengthRatio(GarmentKind kind, const Ratios& ratios) {
  const Names order = IsBottom(kind) ? Names{"hip_width", "waist_width", "thigh_width", "knee_width", "hem_width"}
                                     : Names{"chest_width", "waist_width", "hip_width", "shoulder_width", "hem_width"};
  for (const std::string& name : order) {
    const auto found = ratios.find(name);
    if (found != ratios.end()) return std::sqrt(found->second);
  }
  return 1.0;
}

double FollowedRatio(GarmentKind kind, const std::string& name, const Ratios& given) {
  for (const std::string& neighbour : Neighbours(kind, name)) {
    const auto found = given.find(neighbour);
    if (found != given.end()) return found->second;
  }
  // The crotch's depth: half as the girths, half as the length.
  const double girths = LengthRatio(kind, given);
  if (name == "front_rise" || name == "back_rise") {
    const auto other = given.find(name == "front_rise" ? "back_rise" : "front_rise");
    if (other != given.end()) return other->second;
    for (const char* length : {"length", "inseam"}) {
      const auto found = given.find(length);
      if (found != given.end()) return girths * std::sqrt(found->second);
    }
  }
  return girths;
}

// An outline of trousers has two freedoms upright, crotch and hem, and three measures along them. Length and inseam are
// believed first: a rise is measured along a curve that folding hides.
void AddDrivers(GarmentKind kind, const MeasureMap& photographed, const Ratios& given,
                std::vector<GradeDriver>& drivers) {
  const bool has_legs = HasLegs(kind);
  for (const auto& [name, value] : photographed) {
    const bool upright = name == "length" || name == "inseam" || name == "front_rise" || name == "back_rise";
    if (!has_legs || !upright) drivers.push_back({name, name, 1.0});
  }
  if (!has_legs) return;
  if (given.contains("inseam") && given.contains("length")) {
    drivers.push_back({"inseam", "crotch_depth", -1.0});
    drivers.push_back({"length", "length", 1.0});
    return;
  }
  const bool back_only = given.contains("back_rise") && !given.contains("front_rise");
  drivers.push_back({back_only ? "back_rise" : "front_rise", "crotch_depth", 1.0});
  drivers.push_back({given.contains("inseam") ? "inseam" : "length", "length", 1.0});
}

Status CheckTarget(const GarmentSize& from, const GarmentSize& to, const std::string& name, double photographed,
                   double target) {
  if (!(target < kMostGrading * photographed && target > photographed / kMostGrading)) {
    return InvalidArgument("CHART_MEASURE_ABSURD", "size " + to.name + ": " + name + " would have to become " +
                                                       Centimetres(target) + ", but the photographed size " +
                                                       from.name + " has " + Centimetres(photographed) +
                                                       "; correct the size chart, or photograph a nearer size");
  }
  if (IsWidth(name) && target < kLeastOpening) {
    return InvalidArgument("CHART_OPENING_TOO_NARROW", "size " + to.name + ": " + name + " would be only " +
                                                           Centimetres(target) +
                                                           " wide, less than 4 cm; correct the size chart");
  }
  return {};
}

}  // namespace

bool IsHiddenByFolding(GarmentKind kind, const std::string& measure) {
  return HasLegs(kind) && (measure == "front_rise" || measure == "back_rise" || measure == "thigh_width");
}

Result<GradeTargets> FindGradeTargets(GarmentKind kind, const MeasureMap& photographed, const GarmentSize& from,
                                      const GarmentSize& to) {
  GradeTargets result;
  Ratios given;
  for (const auto& [name, measured] : photographed) {
    FR_ASSIGN_OR_RETURN(const double from_value, ChartValue(from, name));
    FR_ASSIGN_OR_RETURN(const double to_value, ChartValue(to, name));
    if (from_value <= 0.0 || to_value <= 0.0) continue;
    const double disagreement = from_value / measured;
    if (!(disagreement < kMostDisagreement && disagreement > 1.0 / kMostDisagreement)) {
      return InvalidArgument(
          "CHART_CONTRADICTS_PHOTOGRAPHS",
          "size " + from.name + " is said to have a " + name + " of " + Centimetres(from_value) +
              ", but its photographs show " + Centimetres(measured) +
              "; give flat measures of the garment in the size chart, and name the photographed size");
    }
    const bool same = std::abs(measured - from_value) <= kSameMeasure * from_value;
    const double target = same ? measured + (to_value - from_value) : measured * (to_value / from_value);
    FR_RETURN_IF_ERROR(CheckTarget(from, to, name, measured, target));
    result.targets[name] = target;
    result.given.push_back(name);
    given[name] = target / measured;
  }
  if (given.empty()) {
    return InvalidArgument("CHART_WITHOUT_COMMON_MEASURES",
                           "sizes " + from.name + " and " + to.name + " state no measure of a " +
                               std::string(GarmentKindName(kind)) +
                               " that both have; add flat measures to both in the size chart");
  }
  for (const auto& [name, measured] : photographed) {
    if (result.targets.contains(name)) continue;
    const double target = measured * FollowedRatio(kind, name, given);
    FR_RETURN_IF_ERROR(CheckTarget(from, to, name, measured, target));
    result.targets[name] = target;
  }
  AddDrivers(kind, photographed, given, result.drivers);
  return result;
}

}  // namespace fitroom::grading
