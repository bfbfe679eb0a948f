#include "fit_client/fit/measure/zone_fit.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/body/tape_girths.h"

namespace fitroom {
namespace {

// The flat measure that says a zone's girth; empty where none does.
std::string_view MeasureOf(FitZone zone) {
  switch (zone) {
    case FitZone::kBust:
      return "chest_width";
    case FitZone::kWaist:
      return "waist_width";
    case FitZone::kHip:
      return "hip_width";
    case FitZone::kShoulder:
      return "shoulder_width";
    case FitZone::kThigh:
      return "thigh_width";
    case FitZone::kKnee:
      return "knee_width";
    default:
      return "";
  }
}

// The tape's girth of a body where a zone usually lies.
GirthMeasurement BodyGirth(const Body& body, const TapeGirths& tape, FitZone zone) {
  switch (zone) {
    case FitZone::kBust:
      return body.measurements.bust;
    case FitZone::kWaist:
      return body.measurements.waist;
    case FitZone::kHip:
      return body.measurements.hip;
    case FitZone::kThigh:
      return tape.Thigh().value_or(GirthMeasurement());
    case FitZone::kKnee:
      return tape.Knee().value_or(GirthMeasurement());
    case FitZone::kShoulder:
      return {tape.ShoulderBreadth().value_or(0.0), body.landmarks[BodyLandmark::kAcromionLeft].position.y()};
    default:
      return {};
  }
}

}  // namespace

double ZoneFit::needed_strain() const {
  return garment_girth > 0.0 ? std::max(0.0, body_girth / garment_girth - 1.0) : 0.0;
}

std::vector<ZoneFit> ZonesFromMeasures(GarmentKind kind, const std::vector<GarmentMeasure>& measures,
                                       const Body& body) {
  const TapeGirths tape(body);
  std::vector<ZoneFit> zones;
  for (const FitZone zone : ZonesOf(kind)) {
    const std::string_view name = MeasureOf(zone);
    if (name.empty()) continue;
    ZoneFit fit;
    fit.zone = zone;
    const GirthMeasurement girth = BodyGirth(body, tape, zone);
    fit.body_girth = girth.girth;
    fit.height = girth.height;
    const GarmentMeasure* measure = FindMeasure(measures, name);
    fit.provenance = measure == nullptr ? Provenance::kUnknown : measure->provenance;
    if (measure != nullptr) fit.garment_girth = (zone == FitZone::kShoulder ? 1.0 : 2.0) * measure->value;
    fit.measured = fit.provenance != Provenance::kUnknown && fit.garment_girth > 0.0 && fit.body_girth > 0.0;
    if (!(fit.body_girth > 0.0)) {
      fit.note = "the scan gave no " + std::string(FitZoneWords(zone)) + " girth";
    } else if (!fit.measured) {
      fit.note = "the garment's " + std::string(FitZoneWords(zone)) + " is not known";
    }
    zones.push_back(std::move(fit));
  }
  return zones;
}

Provenance ZoneProvenance(GarmentKind kind, FitZone zone, const std::vector<GarmentMeasure>& measures) {
  const GarmentMeasure* measure = FindMeasure(measures, MeasureOf(zone));
  if (measure != nullptr) return measure->provenance;
  return HasLegs(kind) && zone == FitZone::kThigh ? Provenance::kUnknown : Provenance::kMeasured;
}

std::vector<std::string> UnknownDimensions(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  std::vector<std::string> unknown;
  if (!HasLegs(kind)) return unknown;
  for (const auto& [name, words] : {std::pair("front_rise", "front rise"), std::pair("back_rise", "back rise")}) {
    const GarmentMeasure* measure = FindMeasure(measures, name);
    if (measure == nullptr || measure->provenance == Provenance::kUnknown) unknown.emplace_back(words);
  }
  return unknown;
}

}  // namespace fitroom
