#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/base/exit_code.h"
#include "common/remote/body_client.h"
#include "common/remote/shop_client.h"
#include "fit_client/cli/commands.h"
#include "fit_client/cli/servers.h"

namespace fitroom::fit_client {
namespace {

using Json = nlohmann::ordered_json;

struct ListOptions {
  std::string server;
  bool json = false;
};

void Print(const Json& json) {
  std::cout << json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) << "\n";
}

// Titles come from outside: control characters would move the cursor of a terminal.
std::string Plain(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

Status ListBodies(const ListOptions& options) {
  remote::BodyClient client(options.server);
  FR_ASSIGN_OR_RETURN(const std::vector<ScanRecord> scans, client.ListAllScans(""));
  Json json = Json::array();
  if (!options.json) std::printf("%-44s %10s %8s %8s %8s\n", "NAME", "STATURE cm", "BUST", "WAIST", "HIP");
  for (const ScanRecord& scan : scans) {
    const BodyMeasurements& measured = scan.measurements;
    if (options.json) {
      json.push_back({{"name", ToString(scan.name)},
                      {"register_time_unix_s", scan.register_time_unix_s},
                      {"stature_cm", measured.stature * 100},
                      {"bust_cm", measured.bust.girth * 100},
                      {"waist_cm", measured.waist.girth * 100},
                      {"hip_cm", measured.hip.girth * 100}});
    } else {
      std::printf("%-44s %10.1f %8.1f %8.1f %8.1f\n", ToString(scan.name).c_str(), measured.stature * 100,
                  measured.bust.girth * 100, measured.waist.girth * 100, measured.hip.girth * 100);
    }
  }
  if (options.json) Print(json);
  return Status();
}

// The names of a garment's sizes, the smallest first; none where only the photographed one exists.
std::string SizeNames(const SizeChart& chart) {
  std::string names;
  for (const GarmentSize& size : chart.sizes) names += (names.empty() ? "" : " ") + Plain(size.name);
  return names.empty() ? "-" : names;
}

Status ListGarments(const ListOptions& options) {
  remote::ShopClient client(options.server);
  FR_ASSIGN_OR_RETURN(const std::vector<GarmentRecord> records, client.ListAllGarments());
  Json json = Json::array();
  if (!options.json) std::printf("%-36s %-17s %10s  %-24s  %s\n", "NAME", "KIND", "LENGTH cm", "SIZES", "TITLE");
  for (const GarmentRecord& record : records) {
    const Garment& garment = record.garment;
    if (options.json) {
      json.push_back({{"name", "garments/" + garment.id},
                      {"title", garment.title},
                      {"kind", GarmentKindName(garment.kind)},
                      {"length_cm", garment.length * 100},
                      {"fabric", garment.fabric},
                      {"sizes", Json::array()}});
      for (const GarmentSize& size : garment.chart.sizes) json.back()["sizes"].push_back(size.name);
    } else {
      std::printf("%-36s %-17s %10.1f  %-24s  %s\n", ("garments/" + garment.id).c_str(),
                  std::string(GarmentKindName(garment.kind)).c_str(), garment.length * 100,
                  SizeNames(garment.chart).c_str(), Plain(garment.title).c_str());
    }
  }
  if (options.json) Print(json);
  return Status();
}

}  // namespace

void AddBodiesCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bodies", "Lists the scans of a body center");
  auto options = std::make_shared<ListOptions>();
  options->server = kDefaultBodyServer;
  command->add_option(std::string(kBodyServerOption) + ",--server", options->server, "Address of the body center")
      ->envname(kBodyServerVariable)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &exit_code] { exit_code = ReportAndExitCode("fit_client bodies", ListBodies(*options)); });
}

void AddGarmentsCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("garments", "Lists a shop's garments");
  auto options = std::make_shared<ListOptions>();
  options->server = kDefaultShopServer;
  command->add_option(std::string(kShopServerOption) + ",--server", options->server, "Address of the shop")
      ->envname(kShopServerVariable)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &exit_code] { exit_code = ReportAndExitCode("fit_client garments", ListGarments(*options)); });
}

}  // namespace fitroom::fit_client
