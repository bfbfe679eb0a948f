#pragma once

#include <ostream>
#include <span>
#include <string>

#include "common/scan_record/scan_record.h"

namespace fitroom::body_center {

// The option that names the server, the same in all commands that speak to it.
inline constexpr char kServerOption[] = "--server";
inline constexpr char kServerVariable[] = "FITROOM_BODY_SERVER";
inline constexpr char kDefaultServer[] = "127.0.0.1:50051";

// Prints one line a scan under a head line.
void PrintScanTable(std::span<const ScanRecord> scans, std::ostream& out);

// Prints one scan for people: frame with reasons, landmarks found, girths in cm.
void PrintScan(const ScanRecord& scan, std::ostream& out);

// Returns a JSON array of the scans.
std::string ScansToJson(std::span<const ScanRecord> scans);

// Takes a scan's full name, or BODY/SCAN, for the sake of typing.
Result<ScanName> ScanNameFromUser(const std::string& text);

}  // namespace fitroom::body_center
