#pragma once

#include "common/base/status.h"
#include "common/scan_file/scan_file.h"
#include "common/scan_file/source_text.h"

namespace fitroom {

// Reads the polygons of a Wavefront OBJ, fanned, in the order of the file; vertices keep their order too, also unused
// ones. Objects and groups become named objects; lines, points, curves and materials are skipped. Errors as those of
// ReadScan(). An OBJ states no counts but in remarks at its head ("# Vertices: 8", "# Faces: 12"): without
// them a file that was cut at the very end of a line cannot be told from a whole one.
Result<RawScan> ReadObj(const SourceText& source, const ReadScanLimits& limits);

}  // namespace fitroom
