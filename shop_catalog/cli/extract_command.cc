#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/garment/shop_statement.h"
#include "common/garment/size_chart_file.h"
#include "common/garment_record/garment_record.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/garment/extract_garment.h"

namespace fitroom::shop_catalog {
namespace {

using Json = nlohmann::ordered_json;

struct ExtractOptions {
  std::string front;
  std::string back;
  std::string kind = "tshirt";
  double length_cm = 0.0;
  std::string out;
  std::string id;
  std::string title;
  std::string annotation;
  std::string side_folded;
  std::string chart;
  std::string photographed_size;
  std::string fabric;
  std::vector<std::string> stated;  // "NAME=CM"
  bool as_json = false;
};

// Makes an id of a file's name: what is not a letter or digit becomes '-'.
std::string IdOfFileName(const std::string& file) {
  std::string id;
  for (const char c : std::filesystem::path(file).stem().string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte) != 0) {
      id += static_cast<char>(std::tolower(byte));
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id.empty() ? "garment" : id.substr(0, 63);
}

Json ViewToJson(const GarmentView& view, const ViewConfidence& confidence) {
  Json points = Json::object();
  for (const OutlinePoint& point : view.points) {
    points[point.name] = {{"pixel", {point.pixel.x(), point.pixel.y()}}, {"confidence", point.confidence}};
  }
  return {{"image_width", view.image_width},
          {"image_height", view.image_height},
          {"mm_per_pixel", view.metre_per_pixel * 1000.0},
          {"mask", {{"source", confidence.mask_source}, {"confidence", confidence.mask}}},
          {"points_confidence", confidence.points},
          {"weakest_point", confidence.weakest_point},
          {"points", std::move(points)}};
}

// The document that scripts read.
Json ToJson(const GarmentExtraction& extraction, const std::string& folder) {
  const Garment& garment = extraction.garment;
  Json document = {{"id", garment.id},
                   {"kind", GarmentKindName(garment.kind)},
                   {"length_cm", garment.length * 100.0},
                   {"folder", folder}};
  Json& measures = document["measures_cm"] = Json::object();
  for (const GarmentMeasure& measure : garment.measures) {
    if (measure.provenance == Provenance::kUnknown) {
      measures[measure.name] = nullptr;
      continue;
    }
    measures[measure.name] = static_cast<double>(static_cast<long>(measure.value * 1000.0 + 0.5)) / 10.0;
  }
  document["front"] = ViewToJson(garment.front, extraction.front);
  if (garment.back) document["back"] = ViewToJson(*garment.back, *extraction.back);
  if (garment.side_folded) document["side_folded"] = ViewToJson(*garment.side_folded, *extraction.side_folded);
  return document;
}

void PrintView(const char* name, const ViewConfidence& confidence) {
  std::printf("%-6s mask %.2f (%s), points %.2f, weakest %s %.2f\n", name, confidence.mask,
              confidence.mask_source.c_str(), confidence.points, confidence.weakest_point.c_str(), confidence.weakest);
}

void PrintTable(const GarmentExtraction& extraction, const std::string& folder) {
  std::printf("confidence, 0 to 1:\n");
  PrintView("front", extraction.front);
  if (extraction.back) PrintView("back", *extraction.back);
  if (extraction.side_folded) PrintView("side", *extraction.side_folded);
  std::printf("\n%-16s %8s\n", "measure, flat", "cm");
  for (const GarmentMeasure& measure : extraction.garment.measures) {
    const std::string provenance(ProvenanceName(measure.provenance));
    if (measure.provenance == Provenance::kUnknown) {
      std::printf("%-16s %8s\n", measure.name.c_str(), "unknown");
    } else if (measure.provenance == Provenance::kMeasured) {
      std::printf("%-16s %8.1f\n", measure.name.c_str(), measure.value * 100.0);
    } else {
      std::printf("%-16s %8.1f  %s\n", measure.name.c_str(), measure.value * 100.0, provenance.c_str());
    }
  }
  std::printf("\n%s\n", (std::filesystem::path(folder) / "extraction.png").c_str());
}

// Reads fabric, chart and measures by tape from the command line.
Result<ShopStatement> ReadStatement(const ExtractOptions& options, GarmentKind kind) {
  ShopStatement statement;
  if (!options.fabric.empty()) statement.fabric = options.fabric;
  if (!options.chart.empty()) {
    FR_ASSIGN_OR_RETURN(statement.chart, ReadSizeChartFile(options.chart, kind, options.photographed_size));
  } else if (!options.photographed_size.empty()) {
    return InvalidArgument("CHART_MISSING", "--photographed-size names a size of a chart: give one with --chart");
  }
  for (const std::string& text : options.stated) {
    FR_ASSIGN_OR_RETURN(GarmentMeasure measure, StatedMeasureFromText(text, kind));
    statement.measures.push_back(std::move(measure));
  }
  return statement;
}

Status Extract(const ExtractOptions& options) {
  const std::optional<GarmentKind> kind = GarmentKindFromName(options.kind);
  if (!kind) {
    return InvalidArgument("KIND_UNKNOWN", "\"" + options.kind +
                                               "\" is not a kind of garment; name tshirt, long_sleeve, one_piece, "
                                               "one_piece_sleeved, skirt, pants or shorts");
  }
  // What a catalog would refuse is refused here too.
  constexpr auto kMaxPhoto = static_cast<size_t>(kMaxPhotoSize);
  FR_ASSIGN_OR_RETURN(const std::string front, ReadFile(options.front, kMaxPhoto));
  std::string back;
  if (!options.back.empty()) {
    FR_ASSIGN_OR_RETURN(back, ReadFile(options.back, kMaxPhoto));
  }
  std::string side_folded;
  if (!options.side_folded.empty()) {
    FR_ASSIGN_OR_RETURN(side_folded, ReadFile(options.side_folded, kMaxPhoto));
  }
  FR_ASSIGN_OR_RETURN(const ShopStatement statement, ReadStatement(options, *kind));
  PointAnnotation annotation;
  if (!options.annotation.empty()) {
    FR_ASSIGN_OR_RETURN(const std::string text, ReadFile(options.annotation, kMaxAnnotationSize));
    Result<PointAnnotation> read = PointAnnotationFromJson(text, *kind);
    if (!read.ok()) return read.status().At(options.annotation);
    annotation = std::move(read).value();
  }

  ExtractionRequest request;
  request.id = options.id.empty() ? IdOfFileName(options.front) : options.id;
  request.title = options.title;
  request.kind = *kind;
  request.length = options.length_cm / 100.0;
  request.front_photo = front;
  request.back_photo = back;
  request.side_folded_photo = side_folded;
  request.statement = &statement;
  if (!options.annotation.empty()) request.annotation = &annotation;
  FR_ASSIGN_OR_RETURN(const GarmentExtraction extraction, ExtractGarment(request));
  FR_RETURN_IF_ERROR(WriteGarmentFolder(options.out, extraction.garment, extraction.files));
  if (options.as_json) {
    // The folder's name comes from outside: bytes that are no UTF-8 are replaced, never thrown at.
    const std::string json =
        ToJson(extraction, options.out).dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
    std::printf("%s\n", json.c_str());
  } else {
    PrintTable(extraction, options.out);
  }
  return {};
}

}  // namespace

void AddExtractCommand(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExtractOptions>();
  CLI::App* command =
      app.add_subcommand("extract", "Finds a garment's outline, points and measures in photographs, without a server");
  command->add_option("FRONT", options->front, "Front photograph (JPEG, PNG or WebP)")->required();
  command->add_option("BACK", options->back, "Back photograph; without it the front serves for both");
  command
      ->add_option("--kind", options->kind, "tshirt, long_sleeve, one_piece, one_piece_sleeved, skirt, pants or shorts")
      ->capture_default_str();
  command->add_option("--length-cm", options->length_cm,
                      "Length from the highest shoulder point or the waist to the hem, flat");
  command->add_option("--out", options->out, "Folder to write: garment.json, images, extraction.png")->required();
  command->add_option("--annotation", options->annotation,
                      "JSON with points given by hand: {\"front\": {\"P1\": [x, y], ...}, \"back\": {...}}");
  command->add_option("--side-folded", options->side_folded,
                      "Third photograph of pants or shorts: one leg laid over the other, the crotch to the left");
  command->add_option("--chart", options->chart, SizeChartFileHelp());
  command->add_option("--photographed-size", options->photographed_size,
                      "The chart's size that the photographs show, where the chart does not say");
  command->add_option("--fabric", options->fabric, "jersey, woven, denim or stretch (default: jersey)");
  command->add_option("--stated", options->stated, "Measures by tape, flat, in cm: front_rise=27.5 thigh_width=31 ...");
  command->add_option("--id", options->id, "The garment's id (default: made from FRONT's name)");
  command->add_option("--title", options->title, "The garment's name, for people");
  command->add_flag("--json", options->as_json, "Prints JSON instead of a table");
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("shop_catalog", Extract(*options)); });
}

}  // namespace fitroom::shop_catalog
