#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/base/progress.h"
#include "common/base/resource_name.h"
#include "common/garment/garment_folder.h"
#include "common/garment/size_chart_file.h"
#include "common/garment/validate.h"
#include "common/remote/shop_client.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/cli/garment_table.h"

namespace fitroom::shop_catalog {
namespace {

namespace fs = std::filesystem;

struct PublishOptions {
  fs::path front, back, side_folded;
  std::string kind = "tshirt";
  double length_cm = 0;  // 0: not stated.
  std::string id, title;
  fs::path annotation;
  std::string fabric;  // Empty: not stated.
  fs::path chart;
  std::string photographed_size;
  std::vector<std::string> measures;  // NAME=CM.
  fs::path extracted;                 // A folder that `extract` wrote.
  std::string server = kDefaultServer;
  bool json = false;
};

// The points of an extracted garment as an annotation, so that what a person has looked at is what is published.
std::string AnnotationOf(const Garment& garment) {
  nlohmann::ordered_json json;
  const auto add = [&json](const GarmentView& view) {
    nlohmann::ordered_json& points = json[std::string(GarmentSideName(view.side))];
    for (const OutlinePoint& point : view.points) {
      points[point.name] = {{"pixel", {point.pixel.x(), point.pixel.y()}}, {"confidence", point.confidence}};
    }
  };
  add(garment.front);
  if (garment.back) add(*garment.back);
  if (garment.side_folded) add(*garment.side_folded);
  return json.dump();
}

// Takes what was not stated from the folder of an extraction.
Status FillFromExtracted(PublishOptions& options, GarmentUploadStatement& statement) {
  FR_ASSIGN_OR_RETURN(const Garment garment, ReadGarmentFolder(options.extracted));
  options.front = options.extracted / garment.front.photo_file;
  if (garment.back) options.back = options.extracted / garment.back->photo_file;
  if (garment.side_folded) options.side_folded = options.extracted / garment.side_folded->photo_file;
  if (options.id.empty()) options.id = garment.id;
  if (options.title.empty()) options.title = garment.title;
  if (options.length_cm == 0) options.length_cm = garment.length * 100;
  options.kind = GarmentKindName(garment.kind);
  statement.annotation_json = AnnotationOf(garment);
  statement.stated.fabric = garment.fabric;
  statement.stated.chart = garment.chart;
  for (const GarmentMeasure& measure : garment.measures) {
    if (measure.provenance == Provenance::kStated) statement.stated.measures.push_back(measure);
  }
  return Status();
}

// Adds what was stated on the command line; it stands in for what the folder of an extraction says.
Status AddStated(const PublishOptions& options, GarmentKind kind, ShopStatement& stated) {
  if (!options.fabric.empty()) stated.fabric = options.fabric;
  if (!options.chart.empty()) {
    FR_ASSIGN_OR_RETURN(stated.chart, ReadSizeChartFile(options.chart, kind, options.photographed_size));
  } else if (!options.photographed_size.empty()) {
    stated.chart.photographed_size = options.photographed_size;
  }
  for (const std::string& text : options.measures) {
    FR_ASSIGN_OR_RETURN(const GarmentMeasure measure, StatedMeasureFromText(text, kind));
    std::erase_if(stated.measures, [&](const GarmentMeasure& known) { return known.name == measure.name; });
    stated.measures.push_back(measure);
  }
  return ValidateShopStatement(kind, stated);
}

// Returns the length that the chart states for the photographed size, 0 where it does not (unit: metre).
double ChartLength(const SizeChart& chart) {
  const GarmentSize* size = FindSize(chart, chart.photographed_size);
  if (size == nullptr) return 0.0;
  for (const char* name : {"length", "front_length"}) {
    if (const GarmentMeasure* measure = FindMeasure(size->measures, name)) return measure->value;
  }
  return 0.0;
}

Status AddPhoto(GarmentSide side, const fs::path& path, GarmentUploadStatement& statement,
                std::vector<std::string>& photos) {
  FR_ASSIGN_OR_RETURN(std::string bytes, ReadFile(path, static_cast<size_t>(kMaxPhotoSize)));
  if (bytes.empty()) return InvalidArgument("FILE_EMPTY", path.string() + ": the file is empty");
  statement.photos.push_back({side, std::ssize(bytes), Blake2b(bytes)});
  photos.push_back(std::move(bytes));
  return Status();
}

Status MakeStatement(PublishOptions options, GarmentUploadStatement& statement, std::vector<std::string>& photos) {
  if (!options.extracted.empty()) FR_RETURN_IF_ERROR(FillFromExtracted(options, statement));
  if (!options.annotation.empty()) {
    FR_ASSIGN_OR_RETURN(statement.annotation_json, ReadFile(options.annotation, kMaxAnnotationSize));
  }
  const std::optional<GarmentKind> kind = GarmentKindFromName(options.kind);
  if (!kind) {
    return InvalidArgument("KIND_UNKNOWN", options.kind +
                                               ": expected tshirt, long_sleeve, one_piece, "
                                               "one_piece_sleeved, skirt, pants or shorts");
  }
  if (!IsResourceId(options.id)) {
    return InvalidArgument("ID_INVALID", "state the garment's id with --id: 1 to 63 of a-z, 0-9 and -");
  }
  if (options.front.empty()) return InvalidArgument("FRONT_MISSING", "state the front photograph with --front");
  statement.id = options.id;
  statement.title = options.title.empty() ? options.id : options.title;
  statement.kind = *kind;
  FR_RETURN_IF_ERROR(AddStated(options, *kind, statement.stated));
  statement.length = options.length_cm > 0 ? options.length_cm / 100 : ChartLength(statement.stated.chart);
  if (!(statement.length > 0)) {
    return InvalidArgument("LENGTH_MISSING",
                           "state the garment's length with --length-cm, or in the chart; the scale comes from it");
  }
  FR_RETURN_IF_ERROR(AddPhoto(GarmentSide::kFront, options.front, statement, photos));
  if (!options.back.empty()) FR_RETURN_IF_ERROR(AddPhoto(GarmentSide::kBack, options.back, statement, photos));
  if (!options.side_folded.empty()) {
    FR_RETURN_IF_ERROR(AddPhoto(GarmentSide::kSideFolded, options.side_folded, statement, photos));
  }
  return Status();
}

Status Publish(const PublishOptions& options) {
  GarmentUploadStatement statement;
  std::vector<std::string> photos;
  FR_RETURN_IF_ERROR(MakeStatement(options, statement, photos));
  remote::ShopClient client(options.server);
  const Result<GarmentRecord> record = [&] {
    ProgressBar bar;
    return client.Publish(statement, {photos.begin(), photos.end()}, bar.sink());
  }();
  FR_RETURN_IF_ERROR(record.status());
  if (options.json) {
    std::cout << GarmentRecordToJson(*record);
  } else {
    PrintGarment(*record, std::cout);
  }
  return Status();
}

}  // namespace

void AddPublishCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("publish", "Sends photographs to the server, which extracts and publishes the garment");
  auto options = std::make_shared<PublishOptions>();
  command->add_option("--front", options->front, "Front photograph: JPEG, PNG or WebP");
  command->add_option("--back", options->back, "Back photograph; without it the front serves for both");
  command->add_option("--side-folded", options->side_folded,
                      "Of pants and shorts: photograph with one leg laid over the other, which shows the crotch curve");
  command
      ->add_option("--kind", options->kind, "tshirt, long_sleeve, one_piece, one_piece_sleeved, skirt, pants or shorts")
      ->capture_default_str();
  command->add_option(
      "--length-cm", options->length_cm,
      "From the highest shoulder point, or the waist, to the hem, laid flat; may stand in the chart instead");
  command->add_option("--fabric", options->fabric, "jersey (if not given), woven, denim or stretch");
  command->add_option("--measure", options->measures,
                      "NAME=CM, a flat measure by tape, for example front_rise=24.5; may be repeated");
  command->add_option("--chart", options->chart, SizeChartFileHelp());
  command->add_option("--photographed-size", options->photographed_size, "Which size of the chart was photographed");
  command->add_option("--id", options->id, "The garment's id: a-z, 0-9 and -");
  command->add_option("--title", options->title, "For people; the id if not given");
  command->add_option("--annotation", options->annotation, "JSON of points set by hand, instead of detected ones");
  command->add_option("--extracted", options->extracted,
                      "Folder that `extract` wrote: photographs, kind, length, points and chart are taken from it");
  command->add_option(kServerOption, options->server, "Address of the shop")
      ->envname(kServerVariable)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the published garment as JSON");
  command->callback(
      [options, &exit_code] { exit_code = ReportAndExitCode("shop_catalog publish", Publish(*options)); });
}

}  // namespace fitroom::shop_catalog
