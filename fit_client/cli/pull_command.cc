#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/base/exit_code.h"
#include "common/base/progress.h"
#include "fit_client/cache/cache.h"
#include "fit_client/cli/commands.h"
#include "fit_client/cli/servers.h"
#include "fit_client/remote/pull_body.h"
#include "fit_client/remote/pull_garment.h"

namespace fitroom::fit_client {
namespace {

struct PullOptions {
  std::vector<std::string> names;  // Full names: bodies/… or garments/….
  std::vector<std::string> bodies;
  std::vector<std::string> garments;
  std::string body_server = kDefaultBodyServer;
  std::string shop_server = kDefaultShopServer;
};

// Full names say themselves which server they belong to.
Status SortNames(PullOptions& options) {
  for (const std::string& name : options.names) {
    if (name.starts_with("bodies/")) {
      options.bodies.push_back(name);
    } else if (name.starts_with("garments/")) {
      options.garments.push_back(name);
    } else {
      return InvalidArgument("NAME_INVALID",
                             name + ": expected bodies/BODY, bodies/BODY/scans/SCAN or garments/GARMENT");
    }
  }
  if (!options.bodies.empty() || !options.garments.empty()) return Status();
  return InvalidArgument("NAME_MISSING", "name what to pull, for example: fit_client pull bodies/me garments/tee");
}

Status Pull(PullOptions options) {
  FR_RETURN_IF_ERROR(SortNames(options));
  FR_ASSIGN_OR_RETURN(const std::filesystem::path cache, CacheFolder());
  if (!options.bodies.empty()) {
    remote::BodyClient client(options.body_server);
    for (const std::string& name : options.bodies) {
      const Result<ScanRecord> scan = [&] {
        ProgressBar bar;
        return PullBody(client, cache, name, bar.sink());
      }();
      FR_RETURN_IF_ERROR(scan.status());
      std::cout << ToString(scan->name) << "  " << ScanFolder(cache, scan->name).string() << "\n";
    }
  }
  if (options.garments.empty()) return Status();
  remote::ShopClient client(options.shop_server);
  for (const std::string& name : options.garments) {
    const Result<GarmentRecord> record = [&] {
      ProgressBar bar;
      return PullGarment(client, cache, name, bar.sink());
    }();
    FR_RETURN_IF_ERROR(record.status());
    std::cout << "garments/" << record->garment.id << "  " << GarmentFolder(cache, record->garment.id).string() << "\n";
  }
  return Status();
}

}  // namespace

void AddPullCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("pull", "Fetches bodies and garments, so that fitting needs no server");
  auto options = std::make_shared<PullOptions>();
  command->add_option("names", options->names, "bodies/BODY, bodies/BODY/scans/SCAN, garments/GARMENT");
  command->add_option("--body", options->bodies, "BODY or BODY/SCAN; the last registered scan if only BODY is named");
  command->add_option("--garment", options->garments, "GARMENT");
  command->add_option(kBodyServerOption, options->body_server, "Address of the body center")
      ->envname(kBodyServerVariable)
      ->capture_default_str();
  command->add_option(kShopServerOption, options->shop_server, "Address of the shop")
      ->envname(kShopServerVariable)
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("fit_client pull", Pull(*options)); });
}

}  // namespace fitroom::fit_client
