#pragma once

#include "common/base/status.h"
#include "common/scan_file/scan_file.h"
#include "common/scan_file/source_text.h"

namespace fitroom {

// Reads a PLY of version 1.0: ascii or binary of either endian; polygons (fanned), triangle strips or a Cyberware range
// grid; texture coordinates a vertex (s t, u v, texture_u texture_v) or a corner (texcoord list). Other elements and
// properties are skipped. Errors as those of ReadScan(); in a binary body they name the byte.
Result<RawScan> ReadPly(const SourceText& source, const ReadScanLimits& limits);

}  // namespace fitroom
