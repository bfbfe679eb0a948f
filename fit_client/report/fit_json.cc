#include "fit_client/report/fit_json.h"

#include <numbers>

#include "fit_client/fit/measure/contact_pressure.h"

namespace fitroom {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillimetres = 1e3;
constexpr double kCentimetres = 1e2;
constexpr double kPercent = 1e2;
constexpr double kKilopascal = 1e-3;
constexpr double kDegrees = 180.0 / std::numbers::pi;

Json StrainOf(const ZoneFit& zone) {
  return {{"mean_percent", zone.strain_mean * kPercent},
          {"p95_percent", zone.strain_p95 * kPercent},
          {"max_percent", zone.strain_max * kPercent},
          {"direction_deg", zone.strain_angle * kDegrees}};
}

Json PressureOf(const ZoneFit& zone) {
  return {{"band", PressureBandWords(PressureBandOf(zone.laplace_pressure))},
          {"laplace_kpa", zone.laplace_pressure * kKilopascal},
          {"contact_force_kpa", zone.contact_pressure * kKilopascal},
          {"contact_percent", zone.contact_share * kPercent}};
}

}  // namespace

Json ZonesJson(const std::vector<ZoneFit>& zones) {
  Json array = Json::array();
  for (const ZoneFit& zone : zones) {
    Json object = {
        {"zone", FitZoneName(zone.zone)}, {"measured", zone.measured}, {"provenance", ProvenanceName(zone.provenance)}};
    if (zone.measured) {
      object["height_cm"] = zone.height * kCentimetres;
      object["body_cm"] = zone.body_girth * kCentimetres;
      object["garment_cm"] = zone.garment_girth * kCentimetres;
      object["ease_cm"] = zone.ease() * kCentimetres;
      object["ease_percent"] = zone.relative_ease() * kPercent;
      if (zone.worn_girth > 0.0) {
        object["worn_cm"] = zone.worn_girth * kCentimetres;
        object["worn_ease_cm"] = zone.worn_ease() * kCentimetres;
        object["belted"] = zone.is_belted;
      }
    }
    if (zone.measured && zone.layered_girth > 0.0) {
      object["layered_cm"] = zone.layered_girth * kCentimetres;
      object["ease_over_layers_cm"] = (zone.garment_girth - zone.layered_girth) * kCentimetres;
    }
    if (zone.has_strain) {
      object["strain"] = StrainOf(zone);
      object["pressure"] = PressureOf(zone);
      object["gap_mean_mm"] = zone.gap_mean * kMillimetres;
    }
    if (!zone.note.empty()) object["note"] = zone.note;
    array.push_back(std::move(object));
  }
  return array;
}

Json VerdictJson(const SizeVerdict& verdict) {
  Json zones = Json::array();
  for (const ZoneVerdict& zone : verdict.zones) {
    zones.push_back({{"zone", FitZoneName(zone.zone)},
                     {"verdict", FitVerdictName(zone.verdict)},
                     {"amount_mm", zone.amount * kMillimetres},
                     {"close_call", zone.is_close},
                     {"reason", zone.reason}});
  }
  return {{"size", verdict.size},
          {"verdict", FitVerdictName(verdict.verdict)},
          {"deciding_zone", verdict.has_deciding_zone ? Json(FitZoneName(verdict.deciding_zone)) : Json()},
          {"reason", verdict.reason},
          {"close_call", verdict.is_close},
          {"uncertainty_mm", verdict.uncertainty * kMillimetres},
          {"unknown", verdict.unknown},
          {"primary_offset_cm", verdict.has_primary ? Json(verdict.primary_offset * kCentimetres) : Json()},
          {"zones", std::move(zones)}};
}

Json SizesJson(const std::vector<SizeVerdict>& sizes) {
  Json array = Json::array();
  for (const SizeVerdict& size : sizes) array.push_back(VerdictJson(size));
  return array;
}

Json RecommendationJson(const std::optional<SizeRecommendation>& recommendation) {
  if (!recommendation) return Json();
  return {{"found", recommendation->found},
          {"size", recommendation->size},
          {"between", recommendation->between.empty() ? Json() : Json(recommendation->between)},
          {"text", recommendation->text}};
}

Json MeasuresJson(const std::vector<GarmentMeasure>& measures) {
  Json array = Json::array();
  for (const GarmentMeasure& measure : measures) {
    array.push_back({{"name", measure.name},
                     {"flat_cm", measure.value * kCentimetres},
                     {"provenance", ProvenanceName(measure.provenance)}});
  }
  return array;
}

Json LayersJson(const std::vector<LayerReport>& layers) {
  Json array = Json::array();
  for (const LayerReport& layer : layers) {
    array.push_back({{"garment", layer.garment},
                     {"kind", layer.kind},
                     {"size", layer.size},
                     {"outcome", layer.outcome},
                     {"verdict", layer.verdict},
                     {"gap_mean_mm", layer.gap_mean * kMillimetres},
                     {"particle_count_inside", layer.particle_count_inside}});
  }
  return array;
}

}  // namespace fitroom
