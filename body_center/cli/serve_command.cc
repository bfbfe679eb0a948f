#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "body_center/cli/commands.h"
#include "body_center/service/body_server.h"
#include "common/base/exit_code.h"
#include "common/rpc/server.h"

namespace fitroom::body_center {
namespace {

Status Serve(const BodyServerOptions& options) {
  rpc::BlockTerminationSignals();
  spdlog::set_default_logger(spdlog::stderr_color_mt("body_center"));
  FR_ASSIGN_OR_RETURN(const std::unique_ptr<BodyServer> server, BodyServer::Start(options));
  std::cout << "body_center listens on " << server->address() << std::endl;
  rpc::WaitForTerminationSignal();
  server->Shutdown();
  return Status();
}

}  // namespace

void AddServeCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("serve", "Keeps scans and serves them until SIGTERM or Ctrl-C");
  auto options = std::make_shared<BodyServerOptions>();
  options->listen = "127.0.0.1:50051";
  command->add_option("--data", options->data_folder, "Folder of the database; made if it is not there")
      ->envname("FITROOM_BODY_DATA")
      ->required();
  command->add_option("--listen", options->listen, "Loopback address and port; port 0 takes any free one")
      ->envname("FITROOM_BODY_LISTEN")
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("body_center serve", Serve(*options)); });
}

}  // namespace fitroom::body_center
