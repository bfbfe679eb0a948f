#include "common/garment/garment_json.h"

#include <algorithm>
#include <cmath>

#include "common/garment/measure_json.h"
#include "common/garment/validate.h"

namespace fitroom {
namespace {

constexpr size_t kMaxJsonSize = 4u << 20;  // (unit: byte)
constexpr std::string_view kFormat = "fitroom.garment";
// Version 2 added fabric, size chart, provenance of measures and the side-folded view; version 1 is still read.
constexpr int kVersion = 2;

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

// Returns the points in the view's order; a missing one is left to ValidatePoints(), an unknown one ends it here.
Result<std::vector<OutlinePoint>> PointsFromJson(const Json& json, GarmentKind kind, GarmentSide side,
                                                 const std::string& place) {
  if (!json.is_object()) return Bad(place, "is not an object of points");
  const std::vector<std::string>& names = ViewPointNames(kind, side);
  for (const auto& [name, value] : json.items()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      return InvalidArgument("POINT_UNKNOWN",
                             place + ": \"" + name.substr(0, 40) + "\" is not a point of " + DescribeView(kind, side));
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
  const std::string place(GarmentSideName(side));
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
  FR_ASSIGN_OR_RETURN(view.points, PointsFromJson(*points, kind, side, place + ".points"));
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

}  // namespace

std::string GarmentToJson(const Garment& garment) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"id", garment.id},
               {"title", garment.title},
               {"kind", GarmentKindName(garment.kind)},
               {"length_cm", garment.length * 100.0},
               {"fabric", garment.fabric},
               {"measures_cm", MeasuresToJson(garment.measures)}};
  if (!garment.chart.sizes.empty()) json["chart"] = ChartToJson(garment.chart);
  json["front"] = ViewToJson(garment.front);
  if (garment.back) json["back"] = ViewToJson(*garment.back);
  if (garment.side_folded) json["side_folded"] = ViewToJson(*garment.side_folded);
  return json.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

namespace {

// What version 2 added; all of it may be absent.
Status ReadStated(const ObjectReader& reader, Garment& garment) {
  if (reader.Has("fabric")) {
    FR_ASSIGN_OR_RETURN(garment.fabric, reader.String("fabric"));
  }
  if (reader.Has("measures_cm")) {
    const ObjectReader measures(reader.json()["measures_cm"], "garment.measures_cm");
    FR_ASSIGN_OR_RETURN(garment.measures, MeasuresFromJson(measures));
  }
  if (reader.Has("chart")) {
    FR_ASSIGN_OR_RETURN(garment.chart, ChartFromJson(ObjectReader(reader.json()["chart"], "garment.chart")));
  }
  return {};
}

Status CheckFormat(const ObjectReader& reader) {
  FR_ASSIGN_OR_RETURN(const std::string format, reader.String("format"));
  if (format != kFormat) return Bad("garment.format", "is not fitroom.garment; give the garment.json of a garment");
  FR_ASSIGN_OR_RETURN(const int version, reader.Int("version"));
  if (version >= 1 && version <= kVersion) return {};
  return Bad("garment.version", "is " + std::to_string(version) + ", versions 1 to " + std::to_string(kVersion) +
                                    " can be read; a later fitroom has written it: update this one");
}

}  // namespace

Result<Garment> GarmentFromJson(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const Json json, ParseJsonObject(text, kMaxJsonSize, "GARMENT_JSON"));
  const ObjectReader reader(json, "garment");
  FR_RETURN_IF_ERROR(CheckFormat(reader));
  Garment garment;
  FR_ASSIGN_OR_RETURN(garment.id, reader.String("id"));
  FR_ASSIGN_OR_RETURN(garment.title, reader.String("title"));
  FR_ASSIGN_OR_RETURN(const std::string kind_name, reader.String("kind"));
  const std::optional<GarmentKind> kind = GarmentKindFromName(kind_name);
  if (!kind) return Bad("garment.kind", "is not a kind of garment");
  garment.kind = *kind;
  FR_ASSIGN_OR_RETURN(const double length_cm, reader.Number("length_cm"));
  garment.length = length_cm / 100.0;
  FR_RETURN_IF_ERROR(ReadStated(reader, garment));
  FR_ASSIGN_OR_RETURN(const Json* front, reader.Member("front"));
  FR_ASSIGN_OR_RETURN(garment.front, ViewFromJson(*front, garment.kind, GarmentSide::kFront));
  if (reader.Has("back")) {
    FR_ASSIGN_OR_RETURN(garment.back, ViewFromJson(json["back"], garment.kind, GarmentSide::kBack));
  }
  if (reader.Has("side_folded")) {
    FR_ASSIGN_OR_RETURN(garment.side_folded, ViewFromJson(json["side_folded"], garment.kind, GarmentSide::kSideFolded));
  }
  FR_RETURN_IF_ERROR(ValidateGarment(garment));
  return garment;
}

std::string ShopStatementToJson(const ShopStatement& statement) {
  Json json = {{"fabric", statement.fabric}, {"measures_cm", MeasuresToJson(statement.measures)}};
  if (!statement.chart.sizes.empty()) json["chart"] = ChartToJson(statement.chart);
  return json.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
}

Result<ShopStatement> ShopStatementFromJson(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const Json json, ParseJsonObject(text, kMaxJsonSize, "GARMENT_JSON"));
  const ObjectReader reader(json, "statement");
  Garment garment;
  FR_RETURN_IF_ERROR(ReadStated(reader, garment));
  return ShopStatement{std::move(garment.fabric), std::move(garment.chart), std::move(garment.measures)};
}

Result<PointAnnotation> PointAnnotationFromJson(std::string_view text, GarmentKind kind) {
  FR_ASSIGN_OR_RETURN(const Json json, ParseJsonObject(text, kMaxJsonSize, "GARMENT_JSON"));
  PointAnnotation annotation;
  const ObjectReader reader(json, "annotation");
  bool has_any = false;
  const auto read = [&](const char* place, GarmentSide side, std::vector<OutlinePoint>& points) -> Status {
    if (!reader.Has(place)) return {};
    has_any = true;
    FR_ASSIGN_OR_RETURN(points, PointsFromJson(json[place], kind, side, place));
    return {};
  };
  FR_RETURN_IF_ERROR(read("front", GarmentSide::kFront, annotation.front));
  FR_RETURN_IF_ERROR(read("back", GarmentSide::kBack, annotation.back));
  FR_RETURN_IF_ERROR(read("side_folded", GarmentSide::kSideFolded, annotation.side_folded));
  if (!has_any) return Bad("annotation", "has none of \"front\", \"back\" and \"side_folded\"");
  return annotation;
}

}  // namespace fitroom
