#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "body_center/cli/commands.h"
#include "body_center/cli/scan_table.h"
#include "common/base/exit_code.h"
#include "common/remote/body_client.h"
#include "common/scan_record/scan_record_json.h"

namespace fitroom::body_center {
namespace {

struct LookOptions {
  std::string server = kDefaultServer;
  std::string what;  // A body's id for `list`, a scan's name for `show`.
  bool json = false;
};

Status List(const LookOptions& options) {
  remote::BodyClient client(options.server);
  FR_ASSIGN_OR_RETURN(const std::vector<ScanRecord> scans, client.ListAllScans(options.what));
  if (options.json) {
    std::cout << ScansToJson(scans);
  } else {
    PrintScanTable(scans, std::cout);
  }
  return Status();
}

Status Show(const LookOptions& options) {
  FR_ASSIGN_OR_RETURN(const ScanName name, ScanNameFromUser(options.what));
  remote::BodyClient client(options.server);
  FR_ASSIGN_OR_RETURN(const ScanRecord scan, client.GetScan(name));
  if (options.json) {
    std::cout << ScanRecordToJson(scan);
  } else {
    PrintScan(scan, std::cout);
  }
  return Status();
}

void AddCommonOptions(CLI::App& command, LookOptions& options) {
  command.add_option(kServerOption, options.server, "Address of the body center")
      ->envname(kServerVariable)
      ->capture_default_str();
  command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace

void AddListCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("list", "Lists the scans of one body or of all");
  auto options = std::make_shared<LookOptions>();
  command->add_option("body", options->what, "A body's id; all bodies if not given");
  AddCommonOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("body_center list", List(*options)); });
}

void AddShowCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("show", "Shows one scan: frame, landmarks, measurements");
  auto options = std::make_shared<LookOptions>();
  command->add_option("scan", options->what, "bodies/BODY/scans/SCAN, or BODY/SCAN")->required();
  AddCommonOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("body_center show", Show(*options)); });
}

}  // namespace fitroom::body_center
