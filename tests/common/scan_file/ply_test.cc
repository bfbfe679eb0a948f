#include <algorithm>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom {
namespace {

using testing::MakeSphere;
using testing::Replace;

RawScan ReadOrFail(const std::string& bytes) {
  Result<RawScan> scan = ReadScan(bytes, "sample.ply");
  if (!scan.ok()) {
    ADD_FAILURE() << scan.status().ToString();
    return {};
  }
  return std::move(scan).value();
}

template <typename T>
void Put(T value, bool big_endian, std::string& bytes) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

// A binary PLY by a writer that shares nothing with the reader; list lengths and indices of the given types.
template <typename Length, typename Index>
std::string FormatBinaryPly(const TriangleMesh& mesh, bool big_endian, const std::string& length_type,
                            const std::string& index_type) {
  std::string bytes = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
                      "_endian 1.0\ncomment unit mm\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty uchar quality\nproperty double y\nproperty float64 z\n"
                      "property list uchar short neighbours\nelement edge 1\nproperty int vertex1\n"
                      "element face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty uchar flag\nproperty list " + length_type +
                      " " + index_type + " vertex_index\nend_header\n";
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    Put(vertex.x(), big_endian, bytes);
    bytes += 'q';
    Put(vertex.y(), big_endian, bytes);
    Put(vertex.z(), big_endian, bytes);
    bytes += '\2';
    Put(int16_t{-5}, big_endian, bytes);
    Put(int16_t{5}, big_endian, bytes);
  }
  Put(int32_t{77}, big_endian, bytes);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    bytes += '\0';
    Put(static_cast<Length>(3), big_endian, bytes);
    for (int corner = 0; corner < 3; ++corner) Put(static_cast<Index>(triangle[corner]), big_endian, bytes);
  }
  return bytes;
}

TEST(Ply, ReadsBothEndiansAndEveryTypeOfList) {
  const TriangleMesh mesh = MakeSphere(9, 11);
  for (const bool big_endian : {false, true}) {
    for (const std::string& bytes : {
             FormatBinaryPly<uint8_t, int8_t>(mesh, big_endian, "uchar", "char"),
             FormatBinaryPly<int8_t, uint8_t>(mesh, big_endian, "int8", "uint8"),
             FormatBinaryPly<int16_t, uint16_t>(mesh, big_endian, "short", "ushort"),
             FormatBinaryPly<uint16_t, int16_t>(mesh, big_endian, "uint16", "int16"),
             FormatBinaryPly<int32_t, uint32_t>(mesh, big_endian, "int", "uint"),
             FormatBinaryPly<uint32_t, int32_t>(mesh, big_endian, "uint32", "int32"),
         }) {
      const RawScan scan = ReadOrFail(bytes);
      EXPECT_EQ(scan.mesh.vertices, mesh.vertices);
      EXPECT_EQ(scan.mesh.triangles, mesh.triangles);
      EXPECT_EQ(scan.encoding, big_endian ? ScanEncoding::kBinaryBigEndian : ScanEncoding::kBinaryLittleEndian);
      EXPECT_EQ(scan.comments, std::vector<std::string>{"unit mm"});
    }
  }
}

constexpr std::string_view kSquareHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr std::string_view kSquareVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Ply, FansPolygonsOfAnyLineEnd) {
  const std::string text = std::string(kSquareHead) +
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                           std::string(kSquareVertices) + "4 0 1 2 3\n";
  const std::vector<Eigen::Vector3i> expected = {{0, 1, 2}, {0, 2, 3}};
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    EXPECT_EQ(ReadOrFail(Replace(text, "\n", line_end)).mesh.triangles, expected);
  }
  EXPECT_EQ(ReadOrFail(text.substr(0, text.size() - 1)).mesh.triangles, expected);  // The last line may lack its end.
}

TEST(Ply, LineEndsOfTheHeadMayBeMixed) {
  const TriangleMesh mesh = MakeSphere(5, 6);
  const std::string bytes = FormatBinaryPly<uint8_t, int32_t>(mesh, false, "uchar", "int");
  const std::string mixed = testing::ReplaceFirst(bytes, " 1.0\n", " 1.0\r\n");
  EXPECT_EQ(ReadOrFail(mixed).mesh.triangles, mesh.triangles);
  EXPECT_EQ(ReadOrFail(bytes + "\r\n").mesh.triangles, mesh.triangles);
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n3 0 2 1\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(ReadOrFail(text).mesh.triangles, std::vector<Eigen::Vector3i>({{0, 2, 1}}));
  EXPECT_EQ(ReadScan(Replace(text, "3 0 2 1", "3 0 3 1"), "x").status().reason(), "INDEX_OUT_OF_RANGE");
}

TEST(Ply, UnrollsTriangleStrips) {
  const std::string text = std::string(kSquareHead) +
                           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                           std::string(kSquareVertices) + "10 0 1 3 2 -1 0 1 2 2 3\n";
  // 0 1 3, then 1 3 2 turned round; restarted: 0 1 2, then two that only steer, then 2 2 3 likewise.
  const std::vector<Eigen::Vector3i> expected = {{0, 1, 3}, {3, 1, 2}, {0, 1, 2}};
  EXPECT_EQ(ReadOrFail(text).mesh.triangles, expected);
}

TEST(Ply, TakesTextureCoordinatesOfVerticesAndCorners) {
  const std::string by_vertex =
      "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 0.5 0\n0 1 0 0 0.25\n3 0 1 2\n";
  const RawScan first = ReadOrFail(by_vertex);
  EXPECT_EQ(first.texture_path, "skin.png");
  EXPECT_EQ(first.texture_triangles, first.mesh.triangles);
  EXPECT_EQ(first.texture_coordinates[2], Eigen::Vector2f(0.0F, 0.25F));
  const std::string by_corner = std::string(kSquareHead) +
                                "element face 2\nproperty list uchar int vertex_indices\n"
                                "property list uchar float texcoord\nend_header\n" +
                                std::string(kSquareVertices) + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n";
  const RawScan second = ReadOrFail(by_corner);
  ASSERT_EQ(second.texture_triangles.size(), 2U);
  EXPECT_EQ(second.texture_triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(second.texture_triangles[1], Eigen::Vector3i(-1, -1, -1));
  EXPECT_EQ(second.texture_coordinates[1], Eigen::Vector2f(1.0F, 0.0F));
}

// Three by three samples, one missing, and one far behind the others.
//   6 7 8
//   3 4 5     4 is missing, 8 lies deep.
//   0 1 2
TEST(Ply, TriangulatesRangeGridsWithoutBridgingJumps) {
  const std::string head =
      "ply\nformat ascii 1.0\nobj_info num_cols 3\nobj_info num_rows 3\nelement vertex 9\nproperty float x\n"
      "property float y\nproperty float z\nelement range_grid 9\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string vertices = "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 2 0\n1 2 0\n2 2 -50\n";
  const RawScan whole =
      ReadOrFail(head + Replace(vertices, "-50", "0") + "1 0\n1 1\n1 2\n1 3\n1 4\n1 5\n1 6\n1 7\n1 8\n");
  EXPECT_EQ(whole.mesh.triangles.size(), 8U);
  const RawScan holed = ReadOrFail(head + vertices + "1 0\n1 1\n1 2\n1 3\n0\n1 5\n1 6\n1 7\n1 8\n");
  const std::vector<Eigen::Vector3i> expected = {{0, 1, 3}, {1, 2, 5}, {3, 7, 6}};
  EXPECT_EQ(holed.mesh.triangles, expected);
  // Mirrored columns: the same surface, still facing +z.
  const RawScan mirrored = ReadOrFail(head + vertices + "1 2\n1 1\n1 0\n1 5\n0\n1 3\n1 8\n1 7\n1 6\n");
  for (const Eigen::Vector3i& t : mirrored.mesh.triangles) {
    const Eigen::Vector3d ab =
        mirrored.mesh.vertices[static_cast<size_t>(t[1])] - mirrored.mesh.vertices[static_cast<size_t>(t[0])];
    const Eigen::Vector3d ac =
        mirrored.mesh.vertices[static_cast<size_t>(t[2])] - mirrored.mesh.vertices[static_cast<size_t>(t[0])];
    EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);
  }
  EXPECT_EQ(mirrored.mesh.triangles.size(), expected.size());
}

}  // namespace
}  // namespace fitroom
