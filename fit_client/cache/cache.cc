#include "fit_client/cache/cache.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "common/base/file.h"
#include "common/base/resource_name.h"
#include "common/codec/packed_mesh.h"
#include "common/scan_record/scan_record_json.h"

namespace fitroom::fit_client {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxRecordSize = size_t{1} << 20;  // (unit: byte)

Result<ScanRecord> ReadRecord(const fs::path& folder) {
  FR_ASSIGN_OR_RETURN(const std::string text, ReadFile(folder / "body.json", kMaxRecordSize));
  return ScanRecordFromJson(text);
}

// Returns the names of the folders in `folder` that may be ids, sorted; none if it is not there.
std::vector<std::string> IdsIn(const fs::path& folder) {
  std::vector<std::string> ids;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (IsResourceId(name)) ids.push_back(name);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<ScanRecord> RecordsOf(const fs::path& cache, const std::string& body) {
  std::vector<ScanRecord> records;
  for (const std::string& scan : IdsIn(cache / "bodies" / body)) {
    Result<ScanRecord> record = ReadRecord(ScanFolder(cache, {body, scan}));
    if (record.ok() && record->name == ScanName{body, scan}) records.push_back(std::move(record).value());
  }
  return records;
}

}  // namespace

Result<fs::path> CacheFolder() {
  // A relative path is to be ignored, says the XDG specification.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return fs::path(cache) / "fitroom";
  const char* home = std::getenv("HOME");
  if (home != nullptr && home[0] == '/') return fs::path(home) / ".cache" / "fitroom";
  return FailedPrecondition("NO_HOME", "neither XDG_CACHE_HOME nor HOME names a folder; set one of them");
}

fs::path ScanFolder(const fs::path& cache, const ScanName& name) { return cache / "bodies" / name.body / name.scan; }

fs::path GarmentFolder(const fs::path& cache, std::string_view garment) { return cache / "garments" / garment; }

Result<ScanName> ScanNameFromUser(std::string_view text) {
  constexpr std::string_view kBodies = "bodies/";
  constexpr std::string_view kScans = "scans/";
  if (text.starts_with(kBodies)) text.remove_prefix(kBodies.size());
  const size_t slash = std::min(text.find('/'), text.size());
  ScanName name{std::string(text.substr(0, slash)), ""};
  text.remove_prefix(slash);
  if (!text.empty()) {
    text.remove_prefix(1);
    if (text.starts_with(kScans)) text.remove_prefix(kScans.size());
    name.scan = text;
    if (!IsResourceId(name.scan)) name.body.clear();
  }
  if (IsResourceId(name.body)) return name;
  return InvalidArgument("SCAN_NAME_INVALID",
                         "expected BODY, BODY/SCAN or bodies/BODY/scans/SCAN, ids of a-z, 0-9 and -");
}

Result<std::string> GarmentIdFromUser(std::string_view text) {
  constexpr std::string_view kGarments = "garments/";
  if (text.starts_with(kGarments)) text.remove_prefix(kGarments.size());
  if (IsResourceId(text)) return std::string(text);
  return InvalidArgument("GARMENT_NAME_INVALID", "expected GARMENT or garments/GARMENT, an id of a-z, 0-9 and -");
}

Result<std::vector<ScanRecord>> ListCachedScans() {
  FR_ASSIGN_OR_RETURN(const fs::path cache, CacheFolder());
  std::vector<ScanRecord> records;
  for (const std::string& body : IdsIn(cache / "bodies")) {
    std::vector<ScanRecord> of_body = RecordsOf(cache, body);
    std::move(of_body.begin(), of_body.end(), std::back_inserter(records));
  }
  return records;
}

Result<ScanRecord> FindCachedScan(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const ScanName name, ScanNameFromUser(text));
  FR_ASSIGN_OR_RETURN(const fs::path cache, CacheFolder());
  const ScanRecord* newest = nullptr;
  const std::vector<ScanRecord> records = RecordsOf(cache, name.body);
  for (const ScanRecord& record : records) {
    if (!name.scan.empty() && record.name.scan != name.scan) continue;
    if (newest == nullptr || record.register_time_unix_s > newest->register_time_unix_s) newest = &record;
  }
  if (newest != nullptr) return *newest;
  const std::string full = "bodies/" + name.body + (name.scan.empty() ? "" : "/scans/" + name.scan);
  return NotFound("BODY_NOT_PULLED", full + " is not in the cache; run: fit_client pull " + full);
}

Result<Body> LoadCachedBody(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const ScanRecord record, FindCachedScan(text));
  FR_ASSIGN_OR_RETURN(const fs::path cache, CacheFolder());
  const fs::path path = ScanFolder(cache, record.name) / "packed_mesh.bin";
  FR_ASSIGN_OR_RETURN(const std::string packed, ReadFile(path, kMaxPackedMeshSize));
  if (Blake2b(packed) != record.packed_mesh_hash) {
    return DataLoss("CACHE_DAMAGED", path.string() + " is not what was pulled; remove it and run: fit_client pull " +
                                         ToString(record.name));
  }
  Body body;
  FR_ASSIGN_OR_RETURN(body.mesh, UnpackMesh(packed));
  body.landmarks = record.landmarks;
  body.arm_left = record.arm_left;
  body.arm_right = record.arm_right;
  body.leg_left = record.leg_left;
  body.leg_right = record.leg_right;
  body.measurements = record.measurements;
  return body;
}

Result<fs::path> CachedGarmentFolder(std::string_view text) {
  FR_ASSIGN_OR_RETURN(const std::string id, GarmentIdFromUser(text));
  FR_ASSIGN_OR_RETURN(const fs::path cache, CacheFolder());
  fs::path folder = GarmentFolder(cache, id);
  std::error_code error;
  if (fs::is_regular_file(folder / "garment.json", error)) return folder;
  return NotFound("GARMENT_NOT_PULLED", "garments/" + id + " is not in the cache; run: fit_client pull garments/" + id);
}

}  // namespace fitroom::fit_client
