#include <exception>

#include <CLI/CLI.hpp>

#include "common/base/exit_code.h"
#include "shop_catalog/cli/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Publishes garments from photographs and lets consumers browse them", "shop_catalog");
  app.set_version_flag("--version", "shop_catalog " FITROOM_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  fitroom::shop_catalog::AddServeCommand(app, exit_code);
  fitroom::shop_catalog::AddPublishCommand(app, exit_code);
  fitroom::shop_catalog::AddListCommand(app, exit_code);
  fitroom::shop_catalog::AddShowCommand(app, exit_code);
  fitroom::shop_catalog::AddExtractCommand(app, exit_code);
  fitroom::shop_catalog::AddSynthesizeCommand(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(fitroom::ExitCode::kUsage);
  } catch (const std::exception& error) {
    // What is left, such as no memory, ends in a message too.
    return fitroom::ReportAndExitCode("shop_catalog", fitroom::Internal("UNEXPECTED", error.what()));
  }
  return exit_code;
}
