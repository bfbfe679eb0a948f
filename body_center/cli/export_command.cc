#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "body_center/cli/commands.h"
#include "body_center/cli/scan_table.h"
#include "common/base/exit_code.h"
#include "common/base/progress.h"
#include "common/codec/hash.h"
#include "common/remote/body_client.h"

namespace fitroom::body_center {
namespace {

struct ExportOptions {
  std::string scan;
  std::filesystem::path out;  // "-": standard output.
  bool packed_mesh = false;
  std::string server = kDefaultServer;
};

// Downloads into `out` and checks size and hash of what was written.
Status DownloadTo(remote::BodyClient& client, const ScanRecord& scan, ScanContent content, std::ostream& out) {
  const bool is_original = content == ScanContent::kOriginal;
  const int64_t size = is_original ? scan.original_size : scan.packed_mesh_size;
  ProgressBar bar;
  Blake2bHasher hasher;
  int64_t received = 0;
  FR_RETURN_IF_ERROR(client.Download(scan.name, content, /*offset=*/0, [&](std::string_view bytes) -> Status {
    hasher.Update(bytes);
    received += std::ssize(bytes);
    if (!out.write(bytes.data(), std::ssize(bytes))) {
      return ResourceExhausted("WRITE_FAILED", "cannot write the file; is the disk full?");
    }
    bar.Update("receiving", static_cast<double>(received) / static_cast<double>(size));
    return Status();
  }));
  if (!out.flush()) return ResourceExhausted("WRITE_FAILED", "cannot write the file; is the disk full?");
  if (received != size || hasher.Finish() != (is_original ? scan.original_hash : scan.packed_mesh_hash)) {
    return DataLoss("DOWNLOAD_HASH_MISMATCH", "what arrived is not what was registered; export it again");
  }
  return Status();
}

Status Export(const ExportOptions& options) {
  FR_ASSIGN_OR_RETURN(const ScanName name, ScanNameFromUser(options.scan));
  remote::BodyClient client(options.server);
  FR_ASSIGN_OR_RETURN(const ScanRecord scan, client.GetScan(name));
  const ScanContent content = options.packed_mesh ? ScanContent::kPackedMesh : ScanContent::kOriginal;
  if (options.out == "-") return DownloadTo(client, scan, content, std::cout);
  // The file appears under its name only when it is whole.
  std::filesystem::path partial = options.out;
  partial += ".part";
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  if (!file)
    return Status(StatusCode::kPermissionDenied, "FILE_NOT_WRITABLE", partial.string() + ": cannot be written");
  const Status status = DownloadTo(client, scan, content, file);
  file.close();
  std::error_code error;
  if (status.ok()) {
    std::filesystem::rename(partial, options.out, error);
    if (error) return Unavailable("FILE_IO", options.out.string() + ": " + error.message());
  } else {
    std::filesystem::remove(partial, error);
  }
  return status;
}

}  // namespace

void AddExportCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("export", "Gives a scan back, bit by bit as it was registered");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("scan", options->scan, "bodies/BODY/scans/SCAN, or BODY/SCAN")->required();
  command->add_option("--out", options->out, "The file to write; - for standard output")->required();
  command->add_flag("--packed-mesh", options->packed_mesh, "The canonical packed mesh instead of the original");
  command->add_option(kServerOption, options->server, "Address of the body center")
      ->envname(kServerVariable)
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = ReportAndExitCode("body_center export", Export(*options)); });
}

}  // namespace fitroom::body_center
