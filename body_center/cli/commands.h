#pragma once

#include <CLI/CLI.hpp>

namespace fitroom::body_center {

// Each function adds one subcommand to `app`. A command's callback stores its exit code in `exit_code`
// (common/base/exit_code.h); `exit_code` outlives the parsing of the command line.
void AddServeCommand(CLI::App& app, int& exit_code);
void AddRegisterCommand(CLI::App& app, int& exit_code);
void AddListCommand(CLI::App& app, int& exit_code);
void AddShowCommand(CLI::App& app, int& exit_code);
void AddExportCommand(CLI::App& app, int& exit_code);

// measure: prints a scan's frame, landmarks and girths.
void AddMeasureCommand(CLI::App& app, int& exit_code);

// synthesize: makes a body from measurements.
void AddSynthesizeCommand(CLI::App& app, int& exit_code);

}  // namespace fitroom::body_center
