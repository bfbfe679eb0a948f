#include "common/scan_file/obj_writer.h"

#include <charconv>

namespace fitroom {
namespace {

template <typename T>
void AppendNumber(T number, std::string& text) {
  char digits[32];
  const char* const end = std::to_chars(digits, digits + sizeof(digits), number).ptr;
  text += ' ';
  text += std::string_view(digits, end);
}

}  // namespace

std::string FormatObj(const TriangleMesh& mesh, std::string_view comment) {
  std::string text;
  text.reserve(mesh.vertices.size() * 64 + mesh.triangles.size() * 24 + comment.size() + 80);
  if (!comment.empty()) text.append("# ").append(comment) += '\n';
  text += "# Vertices: " + std::to_string(mesh.vertices.size()) + "\n";
  text += "# Faces: " + std::to_string(mesh.triangles.size()) + "\n";
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) AppendNumber(vertex[axis], text);
    text += '\n';
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    text += 'f';
    for (int corner = 0; corner < 3; ++corner) AppendNumber(triangle[corner] + 1, text);
    text += '\n';
  }
  return text;
}

}  // namespace fitroom
