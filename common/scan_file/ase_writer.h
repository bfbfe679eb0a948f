#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// What goes into an ASE beside the mesh.
struct AseContent {
  std::string scene_name = "scene.max";  // No quotes and no line ends in any of these texts.
  std::string object_name = "body";
  std::string comment;       // Written as *COMMENT where not empty; the place to state unit and axes.
  std::string texture_path;  // Written as the diffuse *BITMAP where not empty.
  // Texture coordinates, v upwards, and for every triangle three indices into them; both empty for none.
  std::vector<Eigen::Vector2f> texture_coordinates;
  std::vector<Eigen::Vector3i> texture_triangles;
  bool has_normals = true;  // Face and vertex normals, computed from the mesh.
};

// Writes the mesh as 3ds Max's ASCII export does: tabs, CRLF, four decimals, one GEOMOBJECT, vertices in the frame and
// unit they are given in. About 400 bytes a triangle with normals and texture, 250 MB/s. Indices must be in range and
// coordinates finite and below 1e9 in size.
std::string FormatAse(const TriangleMesh& mesh, const AseContent& content);

}  // namespace fitroom
