#pragma once

#include <span>
#include <string>
#include <vector>

#include "body_center/store/body_store.h"
#include "common/sqlite/database.h"

// The rows of a scan: one in `scans`, some in `scan_landmarks` and `scan_limb_axes`. Used by the store alone.
namespace fitroom::body_center {

// The tables beside those of the blobs; part of the first migration.
extern const char kScanSchema[];
// The second migration: the indexes that the first databases were made without.
extern const char kScanIndexSchema[];

// Inserts all rows of a scan. ALREADY_EXISTS [DATABASE_CONFLICT] if the name is taken.
Status InsertScan(sqlite::Database& database, const ScanRecord& scan, int64_t original_blob, int64_t packed_mesh_blob);

// Returns the scan, or NOT_FOUND [SCAN_NOT_FOUND].
Result<ScanRecord> SelectScan(sqlite::Database& database, const ScanName& name);

// Returns up to `limit` scans behind `after`; of one body unless `body` is empty.
Result<std::vector<ScanRecord>> SelectScans(sqlite::Database& database, std::string_view body, const ScanName& after,
                                            int limit);

// Returns the blob and the size of one of the scan's contents, or NOT_FOUND [SCAN_NOT_FOUND].
struct ContentRow {
  int64_t blob = 0;
  int64_t size = 0;  // (unit: byte)
};
Result<ContentRow> SelectContent(sqlite::Database& database, const ScanName& name, ScanContent content);

}  // namespace fitroom::body_center
