#include <exception>

#include <CLI/CLI.hpp>

#include "body_center/cli/commands.h"
#include "common/base/exit_code.h"

int main(int argc, char** argv) {
  CLI::App app("Registers whole-body laser scans and serves them on this machine", "body_center");
  app.set_version_flag("--version", "body_center " FITROOM_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  fitroom::body_center::AddServeCommand(app, exit_code);
  fitroom::body_center::AddRegisterCommand(app, exit_code);
  fitroom::body_center::AddListCommand(app, exit_code);
  fitroom::body_center::AddShowCommand(app, exit_code);
  fitroom::body_center::AddExportCommand(app, exit_code);
  fitroom::body_center::AddMeasureCommand(app, exit_code);
  fitroom::body_center::AddSynthesizeCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(fitroom::ExitCode::kUsage);
  } catch (const std::exception& error) {
    // What is left, such as no memory, ends in a message too.
    return fitroom::ReportAndExitCode("body_center", fitroom::Internal("UNEXPECTED", error.what()));
  }
  return exit_code;
}
