#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "body_center/scan/synthetic_scan.h"
#include "common/base/status.h"

namespace fitroom::body_center {

enum class SyntheticScanFormat { kAse, kPly, kObj };

// Writes the scan to `path` and, where the format names a texture, the picture beside it as <stem>_skin.jpg (and for
// OBJ the material as <stem>.mtl). ASE: as 3ds Max exports, centimetres, z up, facing -y, CRLF, with normals. PLY:
// binary little endian with normals, OBJ: with texture coordinates, both in metres, y up, facing +z. Each file is
// replaced as a whole or not at all; also the errors of WriteFileAtomically().
Status WriteSyntheticScan(const SyntheticScan& scan, SyntheticScanFormat format, const std::filesystem::path& path);

}  // namespace fitroom::body_center
