#include <nlohmann/json.hpp>

#include "fit_client/report/fit_json.h"
#include "fit_client/report/fit_report.h"

namespace fitroom {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMillimetres = 1e3;
constexpr double kCentimetres = 1e2;
constexpr double kPercent = 1e2;
constexpr double kMegabyte = 1e6;  // (unit: byte)

Json BodyJson(const FitReport& report) {
  return {{"name", report.body},
          {"stature_cm", report.body_stature * kCentimetres},
          {"triangle_count", report.body_triangle_count},
          {"notes", report.body_notes}};
}

Json GarmentJson(const FitReport& report) {
  return {{"id", report.garment},
          {"title", report.garment_title},
          {"kind", report.garment_kind},
          {"length_cm", report.garment_length * kCentimetres}};
}

Json StagesJson(const FitReport& report) {
  Json stages = Json::array();
  for (const StageOutcome& stage : report.stages) {
    stages.push_back({{"name", stage.name}, {"outcome", stage.outcome}, {"substep_count", stage.substep_count}});
  }
  return stages;
}

Json ResidualsJson(const FitReport& report) {
  Json residuals = Json::array();
  for (const Residual& residual : report.residuals) {
    residuals.push_back({{"symbol", residual.symbol},
                         {"name", residual.name},
                         {"value", residual.value},
                         {"limit", residual.limit},
                         {"unit", residual.unit},
                         {"met", residual.value <= residual.limit}});
  }
  return residuals;
}

Json SeamsJson(const SeamGapSummary& seams) {
  return {{"pair_count", seams.pair_count},
          {"open_pair_count", seams.open_pair_count},
          {"gap_mean_mm", seams.mean * kMillimetres},
          {"gap_p95_mm", seams.p95 * kMillimetres},
          {"gap_max_mm", seams.max * kMillimetres},
          {"lacking_girth_mm", seams.lacking_girth * kMillimetres},
          {"open_length_mm", seams.open_length * kMillimetres}};
}

Json PenetrationJson(const PenetrationSummary& penetration) {
  return {{"particle_count_inside", penetration.particle_count_inside},
          {"triangle_sample_count", penetration.triangle_sample_count},
          {"triangle_sample_count_inside", penetration.triangle_sample_count_inside},
          {"deepest_mm", penetration.deepest * kMillimetres}};
}

Json StrainJson(const StrainSummary& strain) {
  return {{"p50_percent", strain.p50 * kPercent},
          {"p95_percent", strain.p95 * kPercent},
          {"p99_percent", strain.p99 * kPercent},
          {"max_percent", strain.max * kPercent}};
}

Json EaseJson(const FitReport& report) {
  Json places = Json::object();
  for (const EaseAtPlace& ease : report.ease) {
    Json place = {{"measured", ease.measured}};
    if (ease.measured) {
      place["height_cm"] = ease.height * kCentimetres;
      place["garment_girth_cm"] = ease.garment_girth * kCentimetres;
      place["body_girth_cm"] = ease.body_girth * kCentimetres;
      place["ease_cm"] = ease.ease() * kCentimetres;
      place["ease_percent"] = ease.relative_ease() * kPercent;
    }
    if (!ease.note.empty()) place["note"] = ease.note;
    places[ease.place] = std::move(place);
  }
  return places;
}

Json MeshJson(const FitReport& report) {
  return {{"particle_count", report.particle_count},
          {"triangle_count", report.triangle_count},
          {"mean_edge_length_mm", report.mean_edge_length * kMillimetres},
          {"euler_characteristic", report.euler_characteristic},
          {"expected_euler_characteristic", report.expected_euler_characteristic},
          {"boundary_loop_count", report.boundary_loop_count}};
}

Json TimesJson(const FitReport& report) {
  Json times = Json::array();
  for (const StageTime& time : report.times) times.push_back({{"name", time.name}, {"seconds", time.seconds}});
  return times;
}

Json FilesJson(const FitReport& report) {
  Json files = Json::array();
  for (const OutputFile& file : report.files) {
    files.push_back({{"name", file.name}, {"description", file.description}, {"size_bytes", file.size}});
  }
  return files;
}

}  // namespace

std::string WriteJson(const FitReport& report) {
  const Json json = {{"program_version", report.program_version},
                     {"body", BodyJson(report)},
                     {"garment", GarmentJson(report)},
                     {"profile", report.profile},
                     {"thread_count", report.thread_count},
                     {"finished", report.finished},
                     {"finishing_reason", report.finishing_reason},
                     {"finishing_text", report.finishing_text},
                     {"stages", StagesJson(report)},
                     {"residuals", ResidualsJson(report)},
                     {"seams", SeamsJson(report.seams)},
                     {"penetration", PenetrationJson(report.penetration)},
                     {"strain", StrainJson(report.strain)},
                     {"self_crossing_count", report.self_crossing_count},
                     {"ease", EaseJson(report)},
                     {"fabric", report.fabric},
                     {"zones", ZonesJson(report.zones)},
                     {"verdict", report.verdict ? VerdictJson(*report.verdict) : Json()},
                     {"sizes", SizesJson(report.sizes)},
                     {"recommendation", RecommendationJson(report.recommendation)},
                     {"measures", MeasuresJson(report.measures)},
                     {"layers", LayersJson(report.layers)},
                     {"mesh", MeshJson(report)},
                     {"substep_count", report.substep_count},
                     {"times", TimesJson(report)},
                     {"total_seconds", report.total_seconds},
                     {"peak_rss_mb", static_cast<double>(report.peak_rss_bytes) / kMegabyte},
                     {"warnings", report.warnings},
                     {"notes", report.notes},
                     {"files", FilesJson(report)}};
  // Names come from outside: bytes that are no UTF-8 are replaced, never thrown at.
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fitroom
