#include <exception>

#include <CLI/CLI.hpp>

#include "common/base/exit_code.h"
#include "fit_client/cli/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Dresses your own body scan in a shop's garment, on your own computer", "fit_client");
  app.set_version_flag("--version", "fit_client " FITROOM_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  fitroom::fit_client::AddBodiesCommand(app, exit_code);
  fitroom::fit_client::AddGarmentsCommand(app, exit_code);
  fitroom::fit_client::AddPullCommand(app, exit_code);
  fitroom::fit_client::AddDrapeCommand(app, exit_code);
  fitroom::fit_client::AddFitCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(fitroom::ExitCode::kUsage);
  } catch (const std::exception& error) {
    // What is left, such as no memory, ends in a message too.
    return fitroom::ReportAndExitCode("fit_client", fitroom::Internal("UNEXPECTED", error.what()));
  }
  return exit_code;
}
