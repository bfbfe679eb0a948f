#include "common/garment/garment_json.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/garment/validate.h"

namespace fitroom {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxJsonSize = 4u << 20;  // (unit: byte)
constexpr std::string_view kFormat = "fitroom.garment";
constexpr int kVersion = 1;

Status Bad(const std::string& place, const std::string& what) {
  return InvalidArgument("GARMENT_JSON", place + " " + what);
}

Json PixelToJson(const Eigen::Vector2d& pixel) { return Json::array({pixel.x(), pixel.y()}); }

Json ViewToJson(const GarmentView& view) {
  Json outline = Json::array();
  for (const Eigen::Vector2d& point : view.outline) outline.push_back(PixelToJson(point));
  Json points = Json::object();
  for (const OutlinePoint& point : view.points) {
    points[point.name] = {{"pixel", PixelToJson(point.pixel)}, {"confidence", point.confidence}};
  }
  return {{"photo_file", view.photo_file},     {"mask_file", view.mask_file},
          {"texture_file", view.texture_file}, {"image_width", view.image_width},
          {"image_height", view.image_height}, {"mm_per_pixel", view.metre_per_pixel * 1000.0},
          {"points", std::move(points)},       {"outline", std::move(outline)}};
}

// Reads members of one JSON object and remembers its place for messages. Each getter fails where the member is absent
// or of another type; no exception of the library can arise.
class ObjectReader {
 public:
  ObjectReader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  Result<const Json*> Member(const char* name) const {
    if (!json_.is_object()) return Bad(place_, "is not an object");
    const auto found = json_.find(name);
    if (found == json_.end()) return Bad(place_ + "." + name, "is missing");
    return &*found;
  }
  Result<std::string> String(const char* name) const {
    FR_ASSIGN_OR_RETURN(const Json* member, Member(name));
    if (!member->is_string()) return Bad(place_ + "." + name, "is not a string");
    return member->get<std::string>();
  }
  Result<double> Number(const char* name) const {
    FR_ASSIGN_OR_RETURN(const Json* member, Member(name));
    if (!member->is_number()) return Bad(place_ + "." + name, "is not a number");
    return member->get<double>();
  }
  Result<int> Int(const char* name) const {
    FR_ASSIGN_OR_RETURN(const double number, Number(name));
    if (number != std::floor(number) || std::abs(number) > 1e9) return Bad(place_ + "." + name, "is not an integer");
    return static_cast<int>(number);
  }
  bool Has(const char* name) const { return json_.is_object() && json_.contains(name); }

 private:
  const Json& json_;
  std::string place_;
};

Result<Eigen::Vector2d> PixelFromJson(const Json& json, const std::string& place) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) {
    return Bad(place, "is not a pair of numbers");
  }
  return Eigen::Vector2d(json[0].get<double>(), json[1].get<double>());
}

Result<OutlinePoint> PointFromJson(const std::string& name, const Json& json, const std::string& place) {
  OutlinePoint point;
  point.name = name;
  point.confidence = 1.0;
  if (json.is_array()) {
    FR_ASSIGN_OR_RETURN(point.pixel, PixelFromJson(json, place));
    return point;
  }
  const ObjectReader reader(json, place);
  FR_ASSIGN_OR_RETURN(const Json* pixel, reader.Member("pixel"));
  FR_ASSIGN_OR_RETURN(point.pixel, PixelFromJson(*pixel, place + ".pixel"));
  if (reader.Has("confidence")) {
    FR_ASSIGN_OR_RETURN(point.confidence, reader.Number("confidence"));
  }
  return point;
}

// Returns the points in the kind's order; a missing one is left to ValidatePoints(), an unknown one ends it here.
Result<std::vector<OutlinePoint>> PointsFromJson(const Json& json, GarmentKind kind, const std::string& place) {
  if (!json.is_object()) return Bad(place, "is not an object of points");
  const std::vector<std::string>& names = OutlinePointNames(kind);
  for (const auto& [name, value] : json.items()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      return InvalidArgument("POINT_UNKNOWN", place + ": \"" + name.substr(0, 40) + "\" is not a point of a " +
                                                  std::string(GarmentKindName(kind)));
    }
  }
  std::vector<OutlinePoint> points;
  for (const std::string& name : names) {
    const auto found = json.find(name);
    if (found == json.end()) continue;
    FR_ASSIGN_OR_RETURN(OutlinePoint point, PointFromJson(name, *found, place + "." + name));
    points.push_back(std::move(point));
  }
  return points;
}

Result<GarmentView> ViewFromJson(const Json& json, GarmentKind kind, GarmentSide side) {
  const std::string place = side == GarmentSide::kFront ? "front" : "back";
  const ObjectReader reader(json, place);
  GarmentView view;
  view.side = side;
  FR_ASSIGN_OR_RETURN(view.photo_file, reader.String("photo_file"));
  FR_ASSIGN_OR_RETURN(view.mask_file, reader.String("mask_file"));
  FR_ASSIGN_OR_RETURN(view.texture_file, reader.String("texture_file"));
  FR_ASSIGN_OR_RETURN(view.image_width, reader.Int("image_width"));
  FR_ASSIGN_OR_RETURN(view.image_height, reader.Int("image_height"));
  FR_ASSIGN_OR_RETURN(const double mm_per_pixel, reader.Number("mm_per_pixel"));
  view.metre_per_pixel = mm_per_pixel / 1000.0;
  FR_ASSIGN_OR_RETURN(const Json* points, reader.Member("points"));
  FR_ASSIGN_OR_RETURN(view.points, PointsFromJson(*points, kind, place + ".points"));
  FR_ASSIGN_OR_RETURN(const Json* outline, reader.Member("outline"));
  if (!outline->is_array()) return Bad(place + ".outline", "is not an array");
  if (outline->size() > static_cast<size_t>(kMaxOutlinePoints)) {
    return InvalidArgument("OUTLINE_SIZE", place + ": the outline has " + std::to_string(outline->size()) + " points");
  }
  for (size_t i = 0; i < outline->size(); ++i) {
    FR_ASSIGN_OR_RETURN(const Eigen::Vector2d pixel,
                        PixelFromJson((*outline)[i], place + ".outline[" + std::to_string(i) + "]"));
    view.outline.push_back(pixel);
  }
  return view;
}

Result<Json> Parse(std::string_view text) {
  if (text.size() > kMaxJsonSize) {
    return ResourceExhausted("GARMENT_JSON_TOO_LARGE", "the JSON text has more than 4 MB");
  }
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return Bad("the text", "is not valid JSON");
  if (!json.is_object()) return Bad("the document", "is not an object");
  return json;
}

Result<std::vector<GarmentMeasure>> MeasuresFromJson(const Json& json) {
  if (!json.is_object() || json.size() > 100) return Bad("measures_cm", "is not an object of at most 100 numbers");
  std::vector<GarmentMeasure> measures;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_number()) return Bad("measures_cm." + name.substr(0, 40), "is not a number");
    measures.push_back({name, value.get<double>() / 100.0});
  }
  return measures;
}

}  // namespace

std::string GarmentToJson(const Garment& garment) {
  Json measures = Json::object();
  for (const GarmentMeasure& measure : garment.measures) {
    measures[measure.name] = std::round(measure.value * 1e4) / 100.0;
  }
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"id", garment.id},
               {"title", garment.title},
               {"kind", GarmentKindName(garment.kind)},
               {"length_cm", garment.length * 100.0},
               {"measures_cm", std::move(measures)},
               {"front", ViewToJson(garment.front)}};
  if (garment.back) json["back"] = ViewToJson(*garment.back);
  return json.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

Result<Garment> GarmentFromJson(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const Json json, Parse(text));
  const ObjectReader reader(json, "garment");
  FR_ASSIGN_OR_RETURN(const std::string format, reader.String("format"));
  FR_ASSIGN_OR_RETURN(const int version, reader.Int("version"));
  if (format != kFormat || version != kVersion) return Bad("garment.format", "is not fitroom.garment, version 1");
  Garment garment;
  FR_ASSIGN_OR_RETURN(garment.id, reader.String("id"));
  FR_ASSIGN_OR_RETURN(garment.title, reader.String("title"));
  FR_ASSIGN_OR_RETURN(const std::string kind_name, reader.String("kind"));
  const std::optional<GarmentKind> kind = GarmentKindFromName(kind_name);
  if (!kind) return Bad("garment.kind", "is not a kind of garment");
  garment.kind = *kind;
  FR_ASSIGN_OR_RETURN(const double length_cm, reader.Number("length_cm"));
  garment.length = length_cm / 100.0;
  if (reader.Has("measures_cm")) {
    FR_ASSIGN_OR_RETURN(garment.measures, MeasuresFromJson(json["measures_cm"]));
  }
  FR_ASSIGN_OR_RETURN(const Json* front, reader.Member("front"));
  FR_ASSIGN_OR_RETURN(garment.front, ViewFromJson(*front, garment.kind, GarmentSide::kFront));
  if (reader.Has("back")) {
    FR_ASSIGN_OR_RETURN(garment.back, ViewFromJson(json["back"], garment.kind, GarmentSide::kBack));
  }
  FR_RETURN_IF_ERROR(ValidateGarment(garment));
  return garment;
}

Result<PointAnnotation> PointAnnotationFromJson(std::string_view text, GarmentKind kind) {
  FR_ASSIGN_OR_RETURN(const Json json, Parse(text));
  PointAnnotation annotation;
  const ObjectReader reader(json, "annotation");
  if (!reader.Has("front") && !reader.Has("back")) return Bad("annotation", "has neither \"front\" nor \"back\"");
  if (reader.Has("front")) {
    FR_ASSIGN_OR_RETURN(annotation.front, PointsFromJson(json["front"], kind, "front"));
  }
  if (reader.Has("back")) {
    FR_ASSIGN_OR_RETURN(annotation.back, PointsFromJson(json["back"], kind, "back"));
  }
  return annotation;
}

}  // namespace fitroom
