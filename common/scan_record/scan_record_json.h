#pragma once

#include <string>
#include <string_view>

#include "common/scan_record/scan_record.h"

namespace fitroom {

// Writes a record as JSON (format "fitroom.scan", version 1): lengths in metres, girths also in cm for people, hashes
// as hexadecimal digits. The same record gives the same text.
std::string ScanRecordToJson(const ScanRecord& scan);

// Reads what ScanRecordToJson() wrote. INVALID_ARGUMENT [SCAN_JSON] with the place where the text is anything else.
Result<ScanRecord> ScanRecordFromJson(std::string_view text);

}  // namespace fitroom
