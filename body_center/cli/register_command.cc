#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "body_center/cli/commands.h"
#include "body_center/cli/scan_table.h"
#include "common/base/exit_code.h"
#include "common/base/file.h"
#include "common/base/progress.h"
#include "common/base/resource_name.h"
#include "common/codec/hash.h"
#include "common/remote/body_client.h"
#include "common/scan_record/scan_record_json.h"

namespace fitroom::body_center {
namespace {

struct RegisterOptions {
  std::filesystem::path file;
  std::string body;
  std::string scan;  // Empty: made from the file's hash, so that the same file gets the same name.
  std::string up, facing, unit;
  std::string server = kDefaultServer;
  bool json = false;
};

Result<ScanUploadStatement> MakeStatement(const RegisterOptions& options, std::string_view file) {
  ScanUploadStatement statement;
  if (file.empty()) return InvalidArgument("FILE_EMPTY", options.file.string() + ": the file is empty");
  if (std::ssize(file) > kMaxScanFileSize) {
    return InvalidArgument("FILE_TOO_LARGE", options.file.string() + ": larger than 256 MiB; compress it with zstd");
  }
  statement.file_name = options.file.filename();
  statement.size = std::ssize(file);
  statement.hash = Blake2b(file);
  statement.name = {options.body, options.scan.empty() ? "h" + statement.hash.ToHex().substr(0, 16) : options.scan};
  if (!IsResourceId(statement.name.body) || !IsResourceId(statement.name.scan)) {
    return InvalidArgument("ID_INVALID", "the ids of body and scan are 1 to 63 of a-z, 0-9 and -");
  }
  if (!options.up.empty()) {
    FR_ASSIGN_OR_RETURN(const SignedAxis axis, ParseAxis(options.up));
    statement.up = AxisName(axis);
  }
  if (!options.facing.empty()) {
    FR_ASSIGN_OR_RETURN(const SignedAxis axis, ParseAxis(options.facing));
    statement.facing = AxisName(axis);
  }
  if (!options.unit.empty()) {
    FR_ASSIGN_OR_RETURN(const LengthUnit unit, ParseUnit(options.unit));
    statement.unit = unit.name;
  }
  return statement;
}

Status Register(const RegisterOptions& options) {
  FR_ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(options.file));
  FR_ASSIGN_OR_RETURN(const ScanUploadStatement statement, MakeStatement(options, file.text()));
  remote::BodyClient client(options.server);
  Result<ScanRecord> scan = [&] {
    ProgressBar bar;
    return client.Register(statement, file.text(), bar.sink());
  }();
  FR_RETURN_IF_ERROR(scan.status());
  if (options.json) {
    std::cout << ScanRecordToJson(*scan);
  } else {
    PrintScan(*scan, std::cout);
  }
  return Status();
}

}  // namespace

void AddRegisterCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("register", "Sends a scan file to the server, which checks and measures it");
  auto options = std::make_shared<RegisterOptions>();
  command->add_option("file", options->file, "ASE, PLY or OBJ, plain or packed with zstd")->required();
  command->add_option("--body", options->body, "Whose scan: an id of a-z, 0-9 and -")->required();
  command->add_option("--scan", options->scan, "The scan's id; made from the file's content if not given");
  command->add_option("--up", options->up, "The file's axis that points up, for example +z; detected if not given");
  command->add_option("--facing", options->facing, "The file's axis that the body faces; detected if not given");
  command->add_option("--unit", options->unit, "m, dm, cm, mm, in or ft; detected if not given");
  command->add_option(kServerOption, options->server, "Address of the body center")
      ->envname(kServerVariable)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the registered scan as JSON");
  command->callback(
      [options, &exit_code] { exit_code = ReportAndExitCode("body_center register", Register(*options)); });
}

}  // namespace fitroom::body_center
