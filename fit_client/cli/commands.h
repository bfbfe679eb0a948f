#pragma once

#include <CLI/CLI.hpp>

namespace fitroom::fit_client {

// Each function adds one subcommand to `app`. A command's callback stores its exit code in `exit_code`
// (common/base/exit_code.h); `exit_code` outlives the parsing of the command line.

// bodies: lists the scans of a body center. garments: lists a shop's garments. pull: fetches both into the cache.
void AddBodiesCommand(CLI::App& app, int& exit_code);
void AddGarmentsCommand(CLI::App& app, int& exit_code);
void AddPullCommand(CLI::App& app, int& exit_code);
// drape: runs the cloth solver on given meshes.
void AddDrapeCommand(CLI::App& app, int& exit_code);
// fit: dresses a body in a garment.
void AddFitCommand(CLI::App& app, int& exit_code);

}  // namespace fitroom::fit_client
