#include "common/garment/measure_json.h"

#include <cmath>
#include <string>
#include <utility>

#include "common/garment/validate.h"

namespace fitroom {
namespace {

constexpr size_t kMaxMeasureCount = 100;

// A chart's numbers: what a shop states.
Json NumbersToJson(const std::vector<GarmentMeasure>& measures) {
  Json json = Json::object();
  for (const GarmentMeasure& measure : measures) json[measure.name] = ToCentimetres(measure.value);
  return json;
}

Result<std::vector<GarmentMeasure>> NumbersFromJson(const ObjectReader& reader) {
  if (!reader.json().is_object() || reader.json().size() > kMaxMeasureCount) {
    return reader.Bad("is not an object of at most 100 numbers");
  }
  std::vector<GarmentMeasure> measures;
  for (const auto& [name, value] : reader.json().items()) {
    if (!value.is_number()) return reader.BadMember(name, "is not a number of centimetres");
    measures.push_back({name, FromCentimetres(value.get<double>()), Provenance::kStated});
  }
  return measures;
}

Result<GarmentSize> SizeFromJson(const ObjectReader& reader) {
  GarmentSize size;
  FR_ASSIGN_OR_RETURN(size.name, reader.String("name"));
  FR_ASSIGN_OR_RETURN(const Json* measures, reader.Member("measures_cm"));
  FR_ASSIGN_OR_RETURN(size.measures,
                      NumbersFromJson(ObjectReader(*measures, reader.place() + ".measures_cm", reader.reason())));
  if (reader.Has("body_cm")) {
    FR_ASSIGN_OR_RETURN(const Json* body, reader.Member("body_cm"));
    FR_ASSIGN_OR_RETURN(size.body, NumbersFromJson(ObjectReader(*body, reader.place() + ".body_cm", reader.reason())));
  }
  return size;
}

}  // namespace

double FromCentimetres(double centimetres) { return std::round(centimetres * 100.0) / 1e4; }
double ToCentimetres(double metres) { return std::round(metres * 1e4) / 100.0; }

Json MeasuresToJson(const std::vector<GarmentMeasure>& measures) {
  Json json = Json::object();
  for (const GarmentMeasure& measure : measures) {
    if (measure.provenance == Provenance::kMeasured) {
      json[measure.name] = ToCentimetres(measure.value);
      continue;
    }
    Json& entry = json[measure.name] = Json::object();
    if (measure.provenance != Provenance::kUnknown) entry["cm"] = ToCentimetres(measure.value);
    entry["provenance"] = ProvenanceName(measure.provenance);
  }
  return json;
}

Result<std::vector<GarmentMeasure>> MeasuresFromJson(const ObjectReader& reader) {
  if (!reader.json().is_object() || reader.json().size() > kMaxMeasureCount) {
    return reader.Bad("is not an object of at most 100 measures");
  }
  std::vector<GarmentMeasure> measures;
  for (const auto& [name, value] : reader.json().items()) {
    GarmentMeasure measure{name, 0.0, Provenance::kMeasured};
    if (value.is_number()) {
      measure.value = FromCentimetres(value.get<double>());
    } else if (value.is_object()) {
      const ObjectReader entry(value, reader.place() + "." + name.substr(0, 40), reader.reason());
      FR_ASSIGN_OR_RETURN(const std::string provenance_name, entry.String("provenance"));
      const std::optional<Provenance> provenance = ProvenanceFromName(provenance_name);
      if (!provenance) return entry.BadMember("provenance", "is not measured, stated, ruled or unknown");
      measure.provenance = *provenance;
      if (*provenance != Provenance::kUnknown) {
        FR_ASSIGN_OR_RETURN(const double centimetres, entry.Number("cm"));
        measure.value = FromCentimetres(centimetres);
      }
    } else {
      return reader.BadMember(name, "is neither a number of centimetres nor an object");
    }
    measures.push_back(std::move(measure));
  }
  return measures;
}

Json ChartToJson(const SizeChart& chart) {
  Json sizes = Json::array();
  for (const GarmentSize& size : chart.sizes) {
    Json row = {{"name", size.name}, {"measures_cm", NumbersToJson(size.measures)}};
    if (!size.body.empty()) row["body_cm"] = NumbersToJson(size.body);
    sizes.push_back(std::move(row));
  }
  return {{"photographed_size", chart.photographed_size}, {"sizes", std::move(sizes)}};
}

Result<SizeChart> ChartFromJson(const ObjectReader& reader) {
  SizeChart chart;
  if (reader.Has("photographed_size")) {
    FR_ASSIGN_OR_RETURN(chart.photographed_size, reader.String("photographed_size"));
  }
  FR_ASSIGN_OR_RETURN(const Json* sizes, reader.Member("sizes"));
  if (!sizes->is_array() || sizes->size() > static_cast<size_t>(kMaxChartSizes)) {
    return reader.BadMember("sizes", "is not an array of at most " + std::to_string(kMaxChartSizes) + " sizes");
  }
  for (size_t i = 0; i < sizes->size(); ++i) {
    const std::string place = reader.place() + ".sizes[" + std::to_string(i) + "]";
    FR_ASSIGN_OR_RETURN(GarmentSize size, SizeFromJson(ObjectReader((*sizes)[i], place, reader.reason())));
    chart.sizes.push_back(std::move(size));
  }
  return chart;
}

}  // namespace fitroom
