#include "tests/common/scan_file/sample_mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace fitroom::testing {

TriangleMesh MakeSphere(int rings, int sectors) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, 50.0);
  for (int r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (int s = 0; s < sectors; ++s) {
      const double around = 2.0 * std::numbers::pi * s / sectors;
      mesh.vertices.emplace_back(rounded(50.0 * std::sin(polar) * std::cos(around)),
                                 rounded(50.0 * std::sin(polar) * std::sin(around)), rounded(50.0 * std::cos(polar)));
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, -50.0);
  const auto at = [&](int r, int s) { return 1 + (r - 1) * sectors + s % sectors; };
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  for (int s = 0; s < sectors; ++s) {
    mesh.triangles.emplace_back(0, at(1, s), at(1, s + 1));
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.emplace_back(at(r, s), at(r + 1, s), at(r + 1, s + 1));
      mesh.triangles.emplace_back(at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
    mesh.triangles.emplace_back(at(rings - 1, s), south, at(rings - 1, s + 1));
  }
  return mesh;
}

AseContent MakeTexturedContent(const TriangleMesh& mesh) {
  AseContent content;
  content.comment = "unit cm, z up";
  content.texture_path = "C:\\scans\\skin.jpg";
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    content.texture_coordinates.emplace_back(static_cast<float>(std::round(vertex.x()) / 100.0 + 0.5),
                                             static_cast<float>(std::round(vertex.z()) / 100.0 + 0.5));
  }
  content.texture_triangles = mesh.triangles;
  return content;
}

std::string ReplaceFirst(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

std::string Replace(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  std::string result;
  size_t start = 0;
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, start)) {
    result.append(text, start, at - start).append(to);
    start = at + from.size();
  }
  return result.append(text, start);
}

std::string ToUtf16(const std::string& ascii, bool big_endian) {
  std::string utf16 = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (big_endian) utf16 += '\0';
    utf16 += c;
    if (!big_endian) utf16 += '\0';
  }
  return utf16;
}

}  // namespace fitroom::testing
