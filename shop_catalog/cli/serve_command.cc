#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "common/base/exit_code.h"
#include "common/rpc/server.h"
#include "shop_catalog/cli/commands.h"
#include "shop_catalog/service/shop_server.h"

namespace fitroom::shop_catalog {
namespace {

Status Serve(const ShopServerOptions& options) {
  rpc::BlockTerminationSignals();
  spdlog::set_default_logger(spdlog::stderr_color_mt("shop_catalog"));
  FR_ASSIGN_OR_RETURN(const std::unique_ptr<ShopServer> server, ShopServer::Start(options));
  std::cout << "shop_catalog listens on " << server->address() << std::endl;
  rpc::WaitForTerminationSignal();
  server->Shutdown();
  return Status();
}

}  // namespace

void AddServeCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("serve", "Keeps garments and serves them until SIGTERM or Ctrl-C");
  auto options = std::make_shared<ShopServerOptions>();
  options->listen = "127.0.0.1:50052";
  command->add_option("--data", options->data_folder, "Folder of the database; made if it is not there")
      ->envname("FITROOM_SHOP_DATA")
      ->required();
  command->add_option("--listen", options->listen, "Loopback address and port; port 0 takes any free one")
      ->envname("FITROOM_SHOP_LISTEN")
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("shop_catalog serve", Serve(*options)); });
}

}  // namespace fitroom::shop_catalog
