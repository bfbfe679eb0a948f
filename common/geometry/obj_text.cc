#include "common/geometry/obj_text.h"

#include <array>
#include <charconv>

namespace fitroom {

std::string FormatObj(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles) {
  std::string text;
  text.reserve(vertices.size() * 36 + triangles.size() * 22);
  std::array<char, 64> number;
  for (const Eigen::Vector3d& vertex : vertices) {
    text += 'v';
    for (const double coordinate : vertex) {
      const auto end =
          std::to_chars(number.data(), number.data() + number.size(), coordinate, std::chars_format::fixed, 7);
      text += ' ';
      text.append(number.data(), end.ptr);
    }
    text += '\n';
  }
  for (const Eigen::Vector3i& triangle : triangles) {
    text += 'f';
    for (const int corner : triangle) {
      const auto end = std::to_chars(number.data(), number.data() + number.size(), corner + 1);
      text += ' ';
      text.append(number.data(), end.ptr);
    }
    text += '\n';
  }
  return text;
}

}  // namespace fitroom
