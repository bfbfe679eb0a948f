#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "body_center/cli/commands.h"
#include "body_center/cli/scan_table.h"
#include "common/base/atomic_file.h"
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

Status OutputRefused() {
  return ResourceExhausted("WRITE_FAILED", "cannot write to standard output; is the disk full?");
}

Status WriteToStandardOutput(std::string_view bytes) {
  return std::cout.write(bytes.data(), std::ssize(bytes)) ? Status() : OutputRefused();
}

// Downloads into `write` and checks size and hash of what was written.
Status DownloadTo(remote::BodyClient& client, const ScanRecord& scan, ScanContent content,
                  const std::function<Status(std::string_view)>& write) {
  const bool is_original = content == ScanContent::kOriginal;
  const int64_t size = is_original ? scan.original_size : scan.packed_mesh_size;
  ProgressBar bar;
  Blake2bHasher hasher;
  int64_t received = 0;
  FR_RETURN_IF_ERROR(client.Download(scan.name, content, /*offset=*/0, [&](std::string_view bytes) -> Status {
    // No more is written than was announced, whatever the server sends.
    if (std::ssize(bytes) > size - received) {
      return DataLoss("DOWNLOAD_TOO_LONG", "more bytes arrive than were registered; export it again");
    }
    hasher.Update(bytes);
    received += std::ssize(bytes);
    bar.Update("receiving", static_cast<double>(received) / static_cast<double>(size));
    return write(bytes);
  }));
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
  if (options.out == "-") {
    FR_RETURN_IF_ERROR(DownloadTo(client, scan, content, WriteToStandardOutput));
    if (!std::cout.flush()) return OutputRefused();
    return Status();
  }
  // The file appears under its name only when it is whole.
  FR_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::Create(options.out));
  FR_RETURN_IF_ERROR(DownloadTo(client, scan, content, [&file](std::string_view bytes) { return file.Write(bytes); }));
  return file.Commit();
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
