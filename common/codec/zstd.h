#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/base/status.h"

namespace fitroom {

// What an unpacker believes at most. A frame's own header is checked against these before anything is allocated.
struct ZstdLimits {
  size_t max_size = size_t{512} << 20;  // Unpacked (unit: byte).
  double max_ratio = 200.0;             // Unpacked by packed size, above 1 MiB; an ASE scan stays below 30.
  int max_window_log = 27;              // Base-2 logarithm of the window (unit: byte); 27 is what `zstd --long` writes.
};

// Says whether the bytes begin like a zstd frame.
bool IsZstd(std::string_view bytes);

// Packs into one frame that states its content size and carries a checksum. Level 1 to 19; 3 is meant for scans.
std::string ZstdCompress(std::string_view bytes, int level = 3);

// Unpacks exactly one frame. INVALID_ARGUMENT for damaged, truncated or trailing bytes, RESOURCE_EXHAUSTED where a
// limit is exceeded.
Result<std::string> ZstdDecompress(std::string_view bytes, const ZstdLimits& limits = {});

}  // namespace fitroom
