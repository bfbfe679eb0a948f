#pragma once

#include <cstdint>
#include <string>

#include "body_center/scan/accept_scan.h"
#include "common/scan_record/scan_record.h"

namespace fitroom::testing {

// Bytes that FakeAcceptor() takes for a scan: a mark, then noise from `seed`, of which every second KiB repeats itself
// so that it can be compressed.
std::string FakeScanFile(uint32_t seed, size_t size);

// The statement of such a file under a name.
ScanUploadStatement StatementOf(const std::string& body, const std::string& scan, const std::string& file);

// Accepts what FakeScanFile() makes and refuses everything else with INVALID_ARGUMENT [NOT_A_SCAN]. The body's numbers
// come from the file's bytes, so that two files give two bodies.
Result<body_center::AcceptedScan> FakeAcceptor(std::string_view bytes, std::string_view file_name,
                                               const FrameOverrides& overrides,
                                               const std::function<bool()>& is_cancelled);

}  // namespace fitroom::testing
