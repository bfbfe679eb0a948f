#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/image/encode.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/garment/drawn_sizes.h"
#include "shop_catalog/garment/garment_photograph.h"

namespace fitroom::shop_catalog {
namespace {

struct SynthesizeArguments {
  std::string out;
  std::string kind = "tshirt";
  std::string size = "12";
  std::string fork = "trouser";
  std::string design = "heather";
  std::string colour;
  // 0: that of the size.
  double length_cm = 0.0;
  double chest_cm = 0.0;
  double sleeve_cm = 0.0;
  bool side_folded = false;
  PhotographOptions options;
};

Status ParseColour(const std::string& text, PhotographOptions& options) {
  if (text.empty()) return {};
  const std::string digits = text.front() == '#' ? text.substr(1) : text;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 6 || error != std::errc() || end != digits.data() + digits.size()) {
    return InvalidArgument("COLOUR_INVALID",
                           "--colour '" + text + "' is no colour: give six hexadecimal digits, #5a7d8c");
  }
  options.colour = {static_cast<uint8_t>(value >> 16), static_cast<uint8_t>((value >> 8) & 0xFF),
                    static_cast<uint8_t>(value & 0xFF)};
  return {};
}

Status ParseDesign(const std::string& text, PhotographOptions& options) {
  if (text == "heather") {
    options.design = TopDesign::kHeather;
  } else if (text == "striped") {
    options.design = TopDesign::kStriped;
  } else {
    return InvalidArgument("DESIGN_UNKNOWN", "--design '" + text + "': give heather or striped");
  }
  return {};
}

// Makes the photographed size's measures those that are to be drawn, changed as the command line says.
void SetMeasures(const SynthesizeArguments& arguments, SizeChart& chart, PhotographOptions& options) {
  for (GarmentSize& size : chart.sizes) {
    if (size.name != chart.photographed_size) continue;
    const auto change = [&size](std::initializer_list<const char*> names, double cm) {
      if (cm == 0.0) return;
      for (GarmentMeasure& measure : size.measures) {
        for (const char* name : names) {
          if (measure.name == name) measure.value = cm / 100.0;
        }
      }
    };
    if (HasLegs(options.kind) && arguments.length_cm != 0.0) {
      const double depth = FindMeasure(size.measures, "length")->value - FindMeasure(size.measures, "inseam")->value;
      change({"inseam"}, arguments.length_cm - 100.0 * depth);
    }
    change({"front_length", "back_length", "length"}, arguments.length_cm);
    change({"chest_width", "waist_width", "hip_width", "hem_width"}, IsBottom(options.kind) ? 0.0 : arguments.chest_cm);
    change({"sleeve_length"}, arguments.sleeve_cm);
    options.measures = size.measures;
  }
}

Status WriteAll(const SynthesizeArguments& arguments, const SizeChart& chart) {
  const PhotographOptions& options = arguments.options;
  FR_ASSIGN_OR_RETURN(const GarmentPhotograph front, DrawGarmentPhotograph(GarmentSide::kFront, options));
  FR_ASSIGN_OR_RETURN(const GarmentPhotograph back, DrawGarmentPhotograph(GarmentSide::kBack, options));
  std::optional<GarmentPhotograph> side_folded;
  if (arguments.side_folded) {
    FR_ASSIGN_OR_RETURN(side_folded, DrawSideFoldedPhotograph(options));
  }
  const DrawnTruth truth = {&front, &back, side_folded ? &*side_folded : nullptr, options.measures};
  const std::filesystem::path folder = arguments.out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Unavailable("FOLDER_NOT_MADE", folder.string() + ": " + error.message());
  std::vector<std::pair<const char*, std::string>> files = {
      {"front.png", EncodePng(front.image)},
      {"back.png", EncodePng(back.image)},
      {"truth.json", TruthAsJson(truth)},
      {"chart.json", SizeChartAsJson(chart, DrawnFabric(options.kind))}};
  if (side_folded) files.emplace_back("side_folded.png", EncodePng(side_folded->image));
  for (const auto& [name, bytes] : files) {
    FR_RETURN_IF_ERROR(WriteFileAtomically(folder / name, bytes));
    std::cout << (folder / name).string() << "\n";
  }
  return {};
}

Status Synthesize(SynthesizeArguments& arguments) {
  const std::optional<GarmentKind> kind = GarmentKindFromName(arguments.kind);
  if (!kind) {
    return InvalidArgument("KIND_UNKNOWN", "\"" + arguments.kind +
                                               "\" is not a kind of garment; name tshirt, long_sleeve, one_piece, "
                                               "one_piece_sleeved, skirt, pants or shorts");
  }
  const std::optional<ForkRule> rule = ForkRuleFromName(arguments.fork);
  if (!rule) return InvalidArgument("FORK_UNKNOWN", "--fork '" + arguments.fork + "': give close, trouser or classic");
  arguments.options.kind = *kind;
  FR_RETURN_IF_ERROR(ParseDesign(arguments.design, arguments.options));
  FR_RETURN_IF_ERROR(ParseColour(arguments.colour, arguments.options));
  FR_ASSIGN_OR_RETURN(SizeChart chart, DrawnSizeChart(*kind, arguments.size, *rule));
  SetMeasures(arguments, chart, arguments.options);
  return WriteAll(arguments, chart);
}

}  // namespace

void AddSynthesizeCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("synthesize", "Draws photographs of a garment of any kind and size, to try the programs with");
  auto arguments = std::make_shared<SynthesizeArguments>();
  command->add_option("--out", arguments->out, "Folder for front.png, back.png, truth.json and chart.json")->required();
  command
      ->add_option("--kind", arguments->kind,
                   "tshirt, long_sleeve, one_piece, one_piece_sleeved, skirt, pants or shorts")
      ->capture_default_str();
  command->add_option("--size", arguments->size, "Women's 6, 8, ... 24, or XS, S, M, L, XL, XXL")
      ->capture_default_str();
  command->add_option("--design", arguments->design, "Of shirts: heather or striped")->capture_default_str();
  command->add_option("--colour", arguments->colour, "Of the cloth, for example #5a7d8c");
  command
      ->add_option("--fork", arguments->fork,
                   "Of legs, the drafting rule of what folding hides: close, trouser, classic")
      ->capture_default_str();
  command->add_flag("--side-folded", arguments->side_folded,
                    "Of legs: also draws side_folded.png, one leg over the other");
  command->add_option("--length-cm", arguments->length_cm, "Neck ends or waist to the hem, instead of the size's");
  command->add_option("--chest-cm", arguments->chest_cm,
                      "Width of a flat shirt or dress cut straight, instead of the size's");
  command->add_option("--sleeve-cm", arguments->sleeve_cm, "Shoulder tip to sleeve end, instead of the size's");
  command->add_option("--image-side", arguments->options.image_side, "400 to 4000 pixels")->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "Of folds and lie")->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = ReportAndExitCode("shop_catalog", Synthesize(*arguments)); });
}

}  // namespace fitroom::shop_catalog
