#pragma once

#include <CLI/CLI.hpp>

namespace fitroom::body_center {

// Each function adds one subcommand to `app`. A command's callback stores its exit code in `exit_code`
// (common/base/exit_code.h); `exit_code` outlives the parsing of the command line.

// measure: prints a scan's frame, landmarks and girths.
void AddMeasureCommand(CLI::App& app, int& exit_code);

}  // namespace fitroom::body_center
