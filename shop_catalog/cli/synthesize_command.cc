#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/image/encode.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/garment/tshirt_photograph.h"

namespace fitroom::shop_catalog {
namespace {

struct SynthesizeArguments {
  std::string out;
  std::string kind = "tshirt";
  std::string design = "heather";
  std::string colour;
  double length_cm = 68.0;
  double chest_cm = 48.0;
  double sleeve_cm = 21.0;
  TShirtPhotographOptions options;
};

Status ParseColour(const std::string& text, TShirtPhotographOptions& options) {
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

Status Synthesize(SynthesizeArguments& arguments) {
  if (arguments.kind != "tshirt") {
    return Status(StatusCode::kUnimplemented, "KIND_NOT_SUPPORTED",
                  "a " + arguments.kind + " cannot be drawn: give --kind tshirt");
  }
  TShirtPhotographOptions& options = arguments.options;
  if (arguments.design == "heather") {
    options.design = TShirtDesign::kHeather;
  } else if (arguments.design == "striped") {
    options.design = TShirtDesign::kStriped;
  } else {
    return InvalidArgument("DESIGN_UNKNOWN", "--design '" + arguments.design + "': give heather or striped");
  }
  FR_RETURN_IF_ERROR(ParseColour(arguments.colour, options));
  options.measures.length = arguments.length_cm / 100.0;
  options.measures.chest = arguments.chest_cm / 100.0;
  options.measures.sleeve = arguments.sleeve_cm / 100.0;
  FR_ASSIGN_OR_RETURN(const TShirtPhotograph front, DrawTShirtPhotograph(GarmentSide::kFront, options));
  FR_ASSIGN_OR_RETURN(const TShirtPhotograph back, DrawTShirtPhotograph(GarmentSide::kBack, options));
  const std::filesystem::path folder = arguments.out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Unavailable("FOLDER_NOT_MADE", folder.string() + ": " + error.message());
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "front.png", EncodePng(front.image)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "back.png", EncodePng(back.image)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "truth.json", AnnotationAsJson(front, back)));
  std::cout << (folder / "front.png").string() << "\n"
            << (folder / "back.png").string() << "\n"
            << (folder / "truth.json").string() << "\n";
  return {};
}

}  // namespace

void AddSynthesizeCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("synthesize", "Draws front and back photographs of a T-shirt, to try the programs with");
  auto arguments = std::make_shared<SynthesizeArguments>();
  command->add_option("--out", arguments->out, "Folder for front.png, back.png and truth.json")->required();
  command->add_option("--kind", arguments->kind, "tshirt")->capture_default_str();
  command->add_option("--design", arguments->design, "heather or striped")->capture_default_str();
  command->add_option("--colour", arguments->colour, "Of the cloth, for example #5a7d8c");
  command->add_option("--length-cm", arguments->length_cm, "Neck end to hem, 45 to 95")->capture_default_str();
  command->add_option("--chest-cm", arguments->chest_cm, "Width of the flat garment, 34 to 80")->capture_default_str();
  command->add_option("--sleeve-cm", arguments->sleeve_cm, "Shoulder tip to sleeve end, 10 to 32")
      ->capture_default_str();
  command->add_option("--image-side", arguments->options.image_side, "400 to 4000 pixels")->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "Of folds and lie")->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = ReportAndExitCode("shop_catalog", Synthesize(*arguments)); });
}

}  // namespace fitroom::shop_catalog
