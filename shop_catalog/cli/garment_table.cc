#include "shop_catalog/cli/garment_table.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <vector>

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

void PrintView(const GarmentView& view, std::ostream& out) {
  out << Format("  %-11s %d x %d pixels, %.3f mm a pixel\n", std::string(GarmentSideName(view.side)).c_str(),
                view.image_width, view.image_height, view.metre_per_pixel * 1000);
  for (const OutlinePoint& point : view.points) {
    out << Format("    %-16s %8.1f %8.1f  confidence %.2f\n", Plain(point.name).c_str(), point.pixel.x(),
                  point.pixel.y(), point.confidence);
  }
}

// One line a measure that any size states, one column a size.
void PrintChart(const Garment& garment, std::ostream& out) {
  const auto width_of = [](const GarmentSize& size) { return std::max(static_cast<int>(size.name.size()), 5) + 2; };
  const auto print = [&](const std::string& name, bool is_body, const std::string& title) {
    std::string line = Format("    %-18s", title.c_str());
    bool is_stated = false;
    for (const GarmentSize& size : garment.chart.sizes) {
      const GarmentMeasure* measure = FindMeasure(is_body ? size.body : size.measures, name);
      is_stated = is_stated || measure != nullptr;
      line += measure == nullptr ? Format("%*s", width_of(size), "-")
                                 : Format("%*.1f", width_of(size), measure->value * 100);
    }
    if (is_stated) out << line << "\n";
  };
  out << Format("  %-20s", "sizes, flat, cm");
  for (const GarmentSize& size : garment.chart.sizes) out << Format("%*s", width_of(size), Plain(size.name).c_str());
  out << "\n";
  for (const std::string& name : MeasureNames(garment.kind)) print(name, /*is_body=*/false, name);
  for (const std::string name : {"bust", "waist", "hip"}) print(name, /*is_body=*/true, "for a " + name + " of");
  out << Format("    %-18s%s\n", "photographed", Plain(garment.chart.photographed_size).c_str());
}

void PrintMeasure(const GarmentMeasure& measure, std::ostream& out) {
  const std::string name = Plain(measure.name);
  if (measure.provenance == Provenance::kUnknown) {
    out << Format("  %-16s      -     unknown\n", name.c_str());
    return;
  }
  const bool is_measured = measure.provenance == Provenance::kMeasured;
  out << Format("  %-16s %6.1f cm%s%s\n", name.c_str(), measure.value * 100, is_measured ? "" : "  ",
                is_measured ? "" : std::string(ProvenanceName(measure.provenance)).c_str());
}

Json MeasuresToJson(const std::vector<GarmentMeasure>& measures) {
  Json json = Json::object();
  for (const GarmentMeasure& measure : measures) json[measure.name] = measure.value * 100;
  return json;
}

Json ChartToJson(const SizeChart& chart) {
  Json json = {{"photographed_size", chart.photographed_size}, {"sizes", Json::array()}};
  for (const GarmentSize& size : chart.sizes) {
    json["sizes"].push_back(
        {{"name", size.name}, {"measures_cm", MeasuresToJson(size.measures)}, {"body_cm", MeasuresToJson(size.body)}});
  }
  return json;
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
               {"fabric", garment.fabric},
               {"measures_cm", MeasuresToJson(garment.measures)},
               {"provenance", Json::object()},
               {"images", Json::array()}};
  for (const GarmentMeasure& measure : garment.measures) {
    json["provenance"][measure.name] = ProvenanceName(measure.provenance);
  }
  if (!garment.chart.sizes.empty()) json["chart"] = ChartToJson(garment.chart);
  for (const GarmentImageRecord& image : record.images) {
    json["images"].push_back({{"image", ImageId(image.kind, image.side)},
                              {"file_name", image.file_name},
                              {"size_bytes", image.size},
                              {"blake2b_256", image.hash.ToHex()}});
  }
  json["front"] = ViewToJson(garment.front);
  if (garment.back) json["back"] = ViewToJson(*garment.back);
  if (garment.side_folded) json["side_folded"] = ViewToJson(*garment.side_folded);
  return json;
}

std::string Dump(const Json& json) {
  return json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void PrintGarmentTable(std::span<const GarmentRecord> records, std::ostream& out) {
  out << Format("%-32s %-17s %9s %5s %-20s %s\n", "NAME", "KIND", "LENGTH cm", "SIZES", "PUBLISHED", "TITLE");
  for (const GarmentRecord& record : records) {
    const Garment& garment = record.garment;
    out << Format("%-32s %-17s %9.1f %5zu %-20s %s\n", ("garments/" + garment.id).c_str(),
                  std::string(GarmentKindName(garment.kind)).c_str(), garment.length * 100,
                  std::max<size_t>(garment.chart.sizes.size(), 1), TimeText(record.publish_time_unix_s).c_str(),
                  Plain(garment.title).c_str());
  }
}

void PrintGarment(const GarmentRecord& record, std::ostream& out) {
  const Garment& garment = record.garment;
  out << "garments/" << garment.id << "\n"
      << "  title    " << Plain(garment.title) << "\n"
      << "  kind     " << GarmentKindName(garment.kind) << "\n"
      << Format("  length   %.1f cm\n", garment.length * 100) << "  since    " << TimeText(record.publish_time_unix_s)
      << "\n";
  out << "  fabric   " << Plain(garment.fabric) << "\n";
  for (const GarmentMeasure& measure : garment.measures) PrintMeasure(measure, out);
  if (!garment.chart.sizes.empty()) PrintChart(garment, out);
  PrintView(garment.front, out);
  if (garment.back) PrintView(*garment.back, out);
  if (garment.side_folded) PrintView(*garment.side_folded, out);
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
