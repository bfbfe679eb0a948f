#include "shop_catalog/cli/garment_table.h"

#include <array>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

namespace fitroom::shop_catalog {
namespace {

using Json = nlohmann::ordered_json;

std::string TimeText(int64_t unix_s) {
  const std::time_t time = unix_s;
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

template <typename... Arguments>
std::string Format(const char* pattern, Arguments... arguments) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, arguments...);
  return text.data();
}

// Titles come from outside: control characters would move the cursor of a terminal.
std::string Plain(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

const char* SideName(GarmentSide side) { return side == GarmentSide::kFront ? "front" : "back"; }

void PrintView(const GarmentView& view, std::ostream& out) {
  out << Format("  %-8s %d x %d pixels, %.3f mm a pixel\n", SideName(view.side), view.image_width, view.image_height,
                view.metre_per_pixel * 1000);
  for (const OutlinePoint& point : view.points) {
    out << Format("    %-16s %8.1f %8.1f  confidence %.2f\n", Plain(point.name).c_str(), point.pixel.x(),
                  point.pixel.y(), point.confidence);
  }
}

Json ViewToJson(const GarmentView& view) {
  Json points = Json::object();
  for (const OutlinePoint& point : view.points) {
    points[point.name] = {{"pixel", {point.pixel.x(), point.pixel.y()}}, {"confidence", point.confidence}};
  }
  return {{"image_width_px", view.image_width},
          {"image_height_px", view.image_height},
          {"metre_per_pixel", view.metre_per_pixel},
          {"points", std::move(points)}};
}

Json ToJson(const GarmentRecord& record) {
  const Garment& garment = record.garment;
  Json json = {{"name", "garments/" + garment.id},
               {"title", garment.title},
               {"kind", GarmentKindName(garment.kind)},
               {"length_cm", garment.length * 100},
               {"publish_time_unix_s", record.publish_time_unix_s},
               {"measures_cm", Json::object()},
               {"images", Json::array()}};
  for (const GarmentMeasure& measure : garment.measures) json["measures_cm"][measure.name] = measure.value * 100;
  for (const GarmentImageRecord& image : record.images) {
    json["images"].push_back({{"image", ImageId(image.kind, image.side)},
                              {"file_name", image.file_name},
                              {"size_bytes", image.size},
                              {"blake2b_256", image.hash.ToHex()}});
  }
  json["front"] = ViewToJson(garment.front);
  if (garment.back) json["back"] = ViewToJson(*garment.back);
  return json;
}

std::string Dump(const Json& json) {
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void PrintGarmentTable(std::span<const GarmentRecord> records, std::ostream& out) {
  out << Format("%-32s %-12s %9s %-20s %s\n", "NAME", "KIND", "LENGTH cm", "PUBLISHED", "TITLE");
  for (const GarmentRecord& record : records) {
    const Garment& garment = record.garment;
    out << Format("%-32s %-12s %9.1f %-20s %s\n", ("garments/" + garment.id).c_str(),
                  std::string(GarmentKindName(garment.kind)).c_str(), garment.length * 100,
                  TimeText(record.publish_time_unix_s).c_str(), Plain(garment.title).c_str());
  }
}

void PrintGarment(const GarmentRecord& record, std::ostream& out) {
  const Garment& garment = record.garment;
  out << "garments/" << garment.id << "\n"
      << "  title    " << Plain(garment.title) << "\n"
      << "  kind     " << GarmentKindName(garment.kind) << "\n"
      << Format("  length   %.1f cm\n", garment.length * 100) << "  since    " << TimeText(record.publish_time_unix_s)
      << "\n";
  for (const GarmentMeasure& measure : garment.measures) {
    out << Format("  %-16s %6.1f cm\n", Plain(measure.name).c_str(), measure.value * 100);
  }
  PrintView(garment.front, out);
  if (garment.back) PrintView(*garment.back, out);
  out << "  images\n";
  for (const GarmentImageRecord& image : record.images) {
    out << Format("    %-16s %10lld bytes  %s\n", ImageId(image.kind, image.side).c_str(),
                  static_cast<long long>(image.size), Plain(image.file_name).c_str());
  }
}

std::string GarmentRecordToJson(const GarmentRecord& record) { return Dump(ToJson(record)); }

std::string GarmentRecordsToJson(std::span<const GarmentRecord> records) {
  Json json = Json::array();
  for (const GarmentRecord& record : records) json.push_back(ToJson(record));
  return Dump(json);
}

}  // namespace fitroom::shop_catalog
