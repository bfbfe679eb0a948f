#pragma once

#include <CLI/CLI.hpp>

namespace fitroom::shop_catalog {

// Each function adds one subcommand to `app`. A command's callback stores its exit code in `exit_code`
// (common/base/exit_code.h); `exit_code` outlives the parsing of the command line.

void AddServeCommand(CLI::App& app, int& exit_code);
void AddPublishCommand(CLI::App& app, int& exit_code);
void AddListCommand(CLI::App& app, int& exit_code);
void AddShowCommand(CLI::App& app, int& exit_code);

// extract: finds a garment's outline, points and measures in photographs and writes its folder.
void AddExtractCommand(CLI::App& app, int& exit_code);

// synthesize: draws photographs of a T-shirt.
void AddSynthesizeCommand(CLI::App& app, int& exit_code);

}  // namespace fitroom::shop_catalog
