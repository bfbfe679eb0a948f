#pragma once

#include <string>

#include "common/geometry/triangle_mesh.h"
#include "common/scan_file/ase_writer.h"

namespace fitroom::testing {

// A closed sphere of the given rings and sectors, radius 50, with (rings - 1) * sectors + 2 vertices and
// 2 * (rings - 1) * sectors triangles, facing outwards. Coordinates have at most four decimals.
TriangleMesh MakeSphere(int rings, int sectors);

// One texture coordinate a vertex and the mesh's own triangles.
AseContent MakeTexturedContent(const TriangleMesh& mesh);

// Returns `text` with every `from` replaced by `to`; fails the test where there is none.
std::string Replace(std::string text, const std::string& from, const std::string& to);
// The same for the first `from` only.
std::string ReplaceFirst(std::string text, const std::string& from, const std::string& to);

// Encodes ASCII as UTF-16 with a byte order mark.
std::string ToUtf16(const std::string& ascii, bool big_endian);

}  // namespace fitroom::testing
