#include "fit_client/remote/pull_body.h"

#include <algorithm>
#include <string>
#include <vector>

#include "common/base/file.h"
#include "common/scan_record/scan_record_json.h"
#include "fit_client/cache/cache.h"
#include "fit_client/remote/pull_lock.h"
#include "fit_client/remote/resumed_file.h"

namespace fitroom::fit_client {
namespace {

namespace fs = std::filesystem;

Result<ScanRecord> FindScan(remote::BodyClient& client, const ScanName& name) {
  if (!name.scan.empty()) return client.GetScan(name);
  FR_ASSIGN_OR_RETURN(const std::vector<ScanRecord> scans, client.ListAllScans(name.body));
  if (scans.empty()) {
    return NotFound("BODY_NOT_FOUND", "bodies/" + name.body + " has no scans; look with: fit_client bodies");
  }
  return *std::max_element(scans.begin(), scans.end(), [](const ScanRecord& a, const ScanRecord& b) {
    return a.register_time_unix_s < b.register_time_unix_s;
  });
}

// Checks what a body center says before anything of it touches the disk: the scan that was asked for, of a size that
// LoadCachedBody() would read.
Status CheckRecord(const ScanName& asked, const ScanRecord& scan) {
  if (scan.name.body != asked.body || (!asked.scan.empty() && scan.name.scan != asked.scan)) {
    return DataLoss("SCAN_NAME_MISMATCH", "the body center answered with " + ToString(scan.name) + "; pull it again");
  }
  if (scan.packed_mesh_size < 1 || scan.packed_mesh_size > static_cast<int64_t>(kMaxPackedMeshSize)) {
    return DataLoss("PACKED_MESH_SIZE", ToString(scan.name) + ": the body center announces " +
                                            std::to_string(scan.packed_mesh_size) + " bytes; at most " +
                                            std::to_string(kMaxPackedMeshSize) + " are pulled");
  }
  return Status();
}

bool IsCached(const fs::path& folder, const ScanRecord& scan) {
  const Result<std::string> json = ReadFile(folder / "body.json", size_t{1} << 20);
  if (!json.ok() || *json != ScanRecordToJson(scan)) return false;
  const Result<MappedFile> mesh = MappedFile::Open(folder / "packed_mesh.bin");
  return mesh.ok() && Blake2b(mesh->text()) == scan.packed_mesh_hash;
}

}  // namespace

Result<ScanRecord> PullBody(remote::BodyClient& client, const fs::path& cache, std::string_view text,
                            const ProgressSink& progress) {
  FR_ASSIGN_OR_RETURN(const ScanName name, ScanNameFromUser(text));
  FR_ASSIGN_OR_RETURN(ScanRecord scan, FindScan(client, name));
  FR_RETURN_IF_ERROR(CheckRecord(name, scan));
  const fs::path folder = ScanFolder(cache, scan.name);
  FR_RETURN_IF_ERROR(MakePrivateFolder(cache));
  FR_RETURN_IF_ERROR(MakePrivateFolder(folder.parent_path()));
  // Whoever waits here finds the scan cached afterwards.
  FR_ASSIGN_OR_RETURN(const PullLock lock,
                      PullLock::Take(folder.parent_path() / (".lock-" + scan.name.scan), kPullPatience));
  if (IsCached(folder, scan)) return scan;
  // The hash in its name keeps a later scan from going on with an earlier one's bytes.
  const fs::path partial =
      folder.parent_path() / (".partial-" + scan.name.scan + "-" + scan.packed_mesh_hash.ToHex().substr(0, 16));
  FR_RETURN_IF_ERROR(MakePrivateFolder(partial));
  FR_RETURN_IF_ERROR(DownloadResumed(
      partial / "packed_mesh.bin", scan.packed_mesh_size, scan.packed_mesh_hash,
      [&](int64_t offset, const std::function<Status(std::string_view)>& sink) {
        return client.Download(scan.name, ScanContent::kPackedMesh, offset, sink);
      },
      progress));
  FR_RETURN_IF_ERROR(WriteFileAtomically(partial / "body.json", ScanRecordToJson(scan)));
  FR_RETURN_IF_ERROR(ReplaceFolder(partial, folder));
  return scan;
}

}  // namespace fitroom::fit_client
