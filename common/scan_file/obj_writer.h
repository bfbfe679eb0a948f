#pragma once

#include <string>
#include <string_view>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// Writes vertices and triangles as OBJ in their order, with the shortest decimals that give back the same doubles.
// `comment` becomes the first line where not empty; it must hold no line end. Remarks tell the counts, as MeshLab's do,
// so that a reader can tell a file that was cut short.
std::string FormatObj(const TriangleMesh& mesh, std::string_view comment = {});

}  // namespace fitroom
