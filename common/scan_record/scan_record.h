#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/body/body_frame.h"
#include "common/codec/hash.h"

namespace fitroom {

// Names a scan: `bodies/{body}/scans/{scan}`. Both ids are [a-z0-9-]{1,63}.
struct ScanName {
  std::string body;
  std::string scan;

  friend auto operator<=>(const ScanName&, const ScanName&) = default;
};

// Returns `bodies/{body}/scans/{scan}`.
std::string ToString(const ScanName& name);
// Reads a full name. INVALID_ARGUMENT [SCAN_NAME_INVALID] for anything else.
Result<ScanName> ParseScanName(std::string_view text);

// The largest file that may be registered (unit: byte).
inline constexpr int64_t kMaxScanFileSize = int64_t{256} << 20;

// What an operator states before the bytes of a scan are sent. The same statement names the same upload.
struct ScanUploadStatement {
  ScanName name;
  std::string file_name;   // Without folders; for people.
  int64_t size = 0;        // Of the whole file (unit: byte).
  Hash256 hash;            // Of the whole file.
  std::string up, facing;  // Overrides as ParseAxis() takes them; empty: detected.
  std::string unit;        // Override as ParseUnit() takes it; empty: detected.

  friend bool operator==(const ScanUploadStatement&, const ScanUploadStatement&) = default;
};

// An upload that is under way.
struct ScanUpload {
  std::string id;  // [a-z0-9-]{1,63}
  ScanUploadStatement statement;
  int64_t committed_size = 0;  // Bytes held for good: where to go on.
};

// A registered scan without its bytes: what the body data center knows of it.
struct ScanRecord {
  ScanName name;
  std::string file_name;
  int64_t original_size = 0;  // (unit: byte)
  Hash256 original_hash;
  int64_t packed_mesh_size = 0;  // (unit: byte)
  Hash256 packed_mesh_hash;
  int64_t register_time_unix_s = 0;
  int64_t vertex_count = 0;
  int64_t triangle_count = 0;
  FrameReport frame;
  BodyLandmarks landmarks;
  LimbAxis arm_left, arm_right, leg_left, leg_right;
  BodyMeasurements measurements;
};

enum class ScanContent { kOriginal, kPackedMesh };

}  // namespace fitroom
