#pragma once

#include "common/base/status.h"
#include "common/scan_file/scan_file.h"
#include "common/scan_file/source_text.h"

namespace fitroom {

// Reads 3ds Max's ASCII export: the first mesh of every GEOMOBJECT, also inside GROUPs. Vertices are taken as they
// stand: the exporter has already applied NODE_TM to them. Animation, helpers, cameras, lights and normals are skipped
// as balanced blocks. Errors as those of ReadScan().
Result<RawScan> ReadAse(const SourceText& source, const ReadScanLimits& limits);

}  // namespace fitroom
