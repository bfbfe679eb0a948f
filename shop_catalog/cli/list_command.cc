#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/base/exit_code.h"
#include "common/base/resource_name.h"
#include "common/remote/shop_client.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/cli/garment_table.h"

namespace fitroom::shop_catalog {
namespace {

struct LookOptions {
  std::string server = kDefaultServer;
  std::string garment;
  bool json = false;
};

Status List(const LookOptions& options) {
  remote::ShopClient client(options.server);
  FR_ASSIGN_OR_RETURN(const std::vector<GarmentRecord> records, client.ListAllGarments());
  if (options.json) {
    std::cout << GarmentRecordsToJson(records);
  } else {
    PrintGarmentTable(records, std::cout);
  }
  return Status();
}

Status Show(const LookOptions& options) {
  constexpr std::string_view kPrefix = "garments/";
  const std::string id =
      options.garment.starts_with(kPrefix) ? options.garment.substr(kPrefix.size()) : options.garment;
  if (!IsResourceId(id)) return InvalidArgument("ID_INVALID", "a garment's id is 1 to 63 of a-z, 0-9 and -");
  remote::ShopClient client(options.server);
  FR_ASSIGN_OR_RETURN(const GarmentRecord record, client.GetGarment(id));
  if (options.json) {
    std::cout << GarmentRecordToJson(record);
  } else {
    PrintGarment(record, std::cout);
  }
  return Status();
}

void AddCommonOptions(CLI::App& command, LookOptions& options) {
  command.add_option(kServerOption, options.server, "Address of the shop")
      ->envname(kServerVariable)
      ->capture_default_str();
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace

void AddListCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("list", "Lists the published garments");
  auto options = std::make_shared<LookOptions>();
  AddCommonOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("shop_catalog list", List(*options)); });
}

void AddShowCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("show", "Shows one garment: scale, points, images");
  auto options = std::make_shared<LookOptions>();
  command->add_option("garment", options->garment, "garments/GARMENT, or the id alone")->required();
  AddCommonOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("shop_catalog show", Show(*options)); });
}

}  // namespace fitroom::shop_catalog
