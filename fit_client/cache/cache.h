#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/scan_record/scan_record.h"

// What was pulled, on the consumer's own disk. Needs no server and knows of none.
//   bodies/<body>/<scan>/body.json         the scan's record (common/scan_record)
//   bodies/<body>/<scan>/packed_mesh.bin   the canonical mesh (common/codec)
//   garments/<garment>/                    a garment's folder (common/garment)
// A folder that is there is whole: pulling writes beside it and renames.
namespace fitroom::fit_client {

// The largest packed mesh that is pulled and loaded (unit: byte).
inline constexpr size_t kMaxPackedMeshSize = size_t{512} << 20;

// Returns `$XDG_CACHE_HOME/fitroom`, else `~/.cache/fitroom`. FAILED_PRECONDITION [NO_HOME] without either variable.
Result<std::filesystem::path> CacheFolder();

// The folder of one scan, of one garment below a cache folder.
std::filesystem::path ScanFolder(const std::filesystem::path& cache, const ScanName& name);
std::filesystem::path GarmentFolder(const std::filesystem::path& cache, std::string_view garment);

// Reads what a person types: `BODY`, `BODY/SCAN`, `bodies/BODY` or `bodies/BODY/scans/SCAN`. The scan is empty where
// none was named. INVALID_ARGUMENT [SCAN_NAME_INVALID].
Result<ScanName> ScanNameFromUser(std::string_view text);
// Reads `GARMENT` or `garments/GARMENT`. INVALID_ARGUMENT [GARMENT_NAME_INVALID].
Result<std::string> GarmentIdFromUser(std::string_view text);

// Returns all cached scans, in the order of their names. Damaged ones are left out.
Result<std::vector<ScanRecord>> ListCachedScans();

// Returns the record of a pulled scan; of the last registered one if only a body is named. NOT_FOUND [BODY_NOT_PULLED]
// says how to pull it.
Result<ScanRecord> FindCachedScan(std::string_view name);

// Loads a pulled body, ready to be dressed. Beside the errors of FindCachedScan(): DATA_LOSS [CACHE_DAMAGED] if the
// mesh is not the one that was pulled.
Result<Body> LoadCachedBody(std::string_view name);

// Returns the folder of a pulled garment. NOT_FOUND [GARMENT_NOT_PULLED] says how to pull it.
Result<std::filesystem::path> CachedGarmentFolder(std::string_view id);

}  // namespace fitroom::fit_client
