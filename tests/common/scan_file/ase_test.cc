#include <string>

#include <gtest/gtest.h>

#include "common/codec/zstd.h"
#include "common/scan_file/ase_writer.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom {
namespace {

using testing::MakeSphere;
using testing::MakeTexturedContent;
using testing::Replace;
using testing::ToUtf16;

RawScan ReadOrFail(const std::string& bytes) {
  Result<RawScan> scan = ReadScan(bytes, "sample");
  if (!scan.ok()) {
    ADD_FAILURE() << scan.status().ToString();
    return {};
  }
  return std::move(scan).value();
}

void ExpectSameMesh(const RawScan& scan, const TriangleMesh& mesh) {
  EXPECT_EQ(scan.mesh.vertices, mesh.vertices);
  EXPECT_EQ(scan.mesh.triangles, mesh.triangles);
}

// The writer rounds to four decimals and the sample has no more: what is read must be what was written, bit for bit.
TEST(Ase, ComesBackAsItWasWritten) {
  const TriangleMesh mesh = MakeSphere(12, 17);
  const AseContent content = MakeTexturedContent(mesh);
  const std::string text = FormatAse(mesh, content);
  const RawScan scan = ReadOrFail(text);
  ExpectSameMesh(scan, mesh);
  EXPECT_EQ(scan.format, ScanFormat::kAse);
  EXPECT_EQ(scan.encoding, ScanEncoding::kText);
  EXPECT_TRUE(scan.has_normals);
  EXPECT_EQ(scan.texture_coordinates, content.texture_coordinates);
  EXPECT_EQ(scan.texture_triangles, content.texture_triangles);
  EXPECT_EQ(scan.texture_path, "C:\\scans\\skin.jpg");
  EXPECT_EQ(scan.comments, std::vector<std::string>{"unit cm, z up"});
  ASSERT_EQ(scan.objects.size(), 1U);
  EXPECT_EQ(scan.objects[0].name, "body");
  EXPECT_EQ(scan.objects[0].vertex_count, static_cast<int32_t>(mesh.vertices.size()));
  EXPECT_EQ(scan.objects[0].triangle_count, static_cast<int32_t>(mesh.triangles.size()));
}

TEST(Ase, WriterEndsEveryLineWithCarriageReturnAndLineFeed) {
  const std::string text = FormatAse(MakeSphere(4, 5), MakeTexturedContent(MakeSphere(4, 5)));
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    ASSERT_EQ(text[at - 1], '\r');
}

TEST(Ase, NormalsAndTextureMayBeAbsent) {
  const TriangleMesh mesh = MakeSphere(6, 7);
  AseContent content;
  content.has_normals = false;
  const RawScan scan = ReadOrFail(FormatAse(mesh, content));
  ExpectSameMesh(scan, mesh);
  EXPECT_FALSE(scan.has_normals);
  EXPECT_FALSE(scan.has_texture_coordinates());
  EXPECT_EQ(scan.texture_path, "");
}

TEST(Ase, AnyLineEndAndEncodingGivesTheSameMesh) {
  const TriangleMesh mesh = MakeSphere(6, 7);
  const std::string text = FormatAse(mesh, MakeTexturedContent(mesh));
  const std::string with_cr = Replace(text, "\r\n", "\r");
  ExpectSameMesh(ReadOrFail(Replace(text, "\r\n", "\n")), mesh);
  ExpectSameMesh(ReadOrFail(with_cr), mesh);
  ExpectSameMesh(ReadOrFail(with_cr + "\n"), mesh);
  ExpectSameMesh(ReadOrFail("\xEF\xBB\xBF" + text), mesh);
  ExpectSameMesh(ReadOrFail(Replace(text, "\t", " ")), mesh);
  ExpectSameMesh(ReadOrFail(ToUtf16(text, /*big_endian=*/false)), mesh);
  ExpectSameMesh(ReadOrFail(ToUtf16(text, /*big_endian=*/true)), mesh);
  ExpectSameMesh(ReadOrFail(ToUtf16(text, /*big_endian=*/false).substr(2)), mesh);
  EXPECT_EQ(ReadOrFail(ToUtf16(text, true)).encoding, ScanEncoding::kUtf16BigEndian);
  const RawScan unpacked = ReadOrFail(ZstdCompress(text));
  ExpectSameMesh(unpacked, mesh);
  EXPECT_TRUE(unpacked.is_compressed);
}

constexpr std::string_view kTriangle =
    "\t*MESH {\n\t\t*TIMEVALUE 0\n\t\t*MESH_NUMVERTEX 3\n\t\t*MESH_NUMFACES 1\n\t\t*MESH_VERTEX_LIST {\n"
    "\t\t\t*MESH_VERTEX    0\t0.0\t0.0\t0.0\n\t\t\t*MESH_VERTEX    1\t1.5e+01\t0\t-0.0\n"
    "\t\t\t*MESH_VERTEX    2\t0.0\t.5\t1.\n\t\t}\n"
    "\t\t*MESH_FACE_LIST {\n\t\t\t*MESH_FACE    0:    A:    0 B:    1 C:    2 AB:    1 BC:    1 CA:    1\n\t\t}\n\t}\n";

// Groups, helpers, animation, a second mesh within an animation, quotes with braces: what 3ds Max writes around meshes.
TEST(Ase, ReadsEveryObjectAndSkipsWhatIsNone) {
  const std::string mesh(kTriangle);
  const std::string text =
      "*3DSMAX_ASCIIEXPORT\t200\n*COMMENT \"AsciiExport { Version  2,00\"\n*HELPEROBJECT {\n\t*NODE_NAME \"Dummy "
      "}\"\n}\n"
      "*GROUP \"group {1\" {\n\t*HELPEROBJECT {\n\t\t*HELPER_CLASS \"Dummy\"\n\t}\n"
      "*GEOMOBJECT {\n\t*NODE_NAME \"left\"\n" +
      mesh + "\t*MESH_ANIMATION {\n" + mesh + mesh +
      "\t}\n\t*TM_ANIMATION {\n\t\t*NODE_NAME \"left\"\n\t}\n}\n}\n"
      "*CAMERAOBJECT {\n\t*NODE_NAME \"c\"\n}\n*GEOMOBJECT {\n\t*NODE_NAME \"r\xE9\"\n" +
      mesh + "}\n";
  const RawScan scan = ReadOrFail(text);
  ASSERT_EQ(scan.objects.size(), 2U);
  EXPECT_EQ(scan.objects[0].name, "left");
  EXPECT_EQ(scan.objects[1].name, "r\xC3\xA9");  // Latin-1 becomes UTF-8.
  EXPECT_EQ(scan.objects[1].first_vertex, 3);
  EXPECT_EQ(scan.objects[1].first_triangle, 1);
  ASSERT_EQ(scan.mesh.triangles.size(), 2U);
  EXPECT_EQ(scan.mesh.triangles[1], Eigen::Vector3i(3, 4, 5));
  EXPECT_EQ(scan.mesh.vertices[4], Eigen::Vector3d(15.0, 0.0, 0.0));
  EXPECT_EQ(scan.mesh.vertices[5], Eigen::Vector3d(0.0, 0.5, 1.0));
}

// What other exporters, editors and users leave in a file.
TEST(Ase, TakesQuotesInNamesAndMarksAtTheEnd) {
  const TriangleMesh mesh = MakeSphere(6, 7);
  const std::string text = FormatAse(mesh, MakeTexturedContent(mesh));
  const RawScan quoted = ReadOrFail(Replace(text, "*NODE_NAME \"body\"", "*NODE_NAME \"Bob\"s \"scan\""));
  ExpectSameMesh(quoted, mesh);
  EXPECT_EQ(quoted.objects[0].name, "Bob");
  ExpectSameMesh(ReadOrFail(Replace(text, "*NODE_NAME \"body\"", "*NODE_NAME body")), mesh);
  ExpectSameMesh(ReadOrFail(text + '\x1A'), mesh);
  ExpectSameMesh(ReadOrFail(text + std::string(3, '\0')), mesh);
  ExpectSameMesh(ReadOrFail(Replace(text, "*GEOMOBJECT", "*GROUP \"Bob\"s\" {\r\n*GEOMOBJECT") + "}"), mesh);
}

TEST(Ase, EntriesMayComeInAnyOrder) {
  const std::string first = "\t\t\t*MESH_VERTEX    0\t0.0\t0.0\t0.0\n";
  const std::string last = "\t\t\t*MESH_VERTEX    2\t0.0\t.5\t1.\n";
  std::string text = "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n" + std::string(kTriangle) + "}\n";
  text = Replace(Replace(Replace(text, first, "@"), last, first), "@", last);
  const RawScan scan = ReadOrFail(text);
  ASSERT_EQ(scan.mesh.vertices.size(), 3U);
  EXPECT_EQ(scan.mesh.vertices[2], Eigen::Vector3d(0.0, 0.5, 1.0));
}

TEST(Ase, KeepsDegenerateTrianglesAndCountsThem) {
  const TriangleMesh sphere = MakeSphere(4, 5);
  TriangleMesh mesh = sphere;
  mesh.triangles.emplace_back(3, 3, 4);
  const RawScan scan = ReadOrFail(FormatAse(mesh, {}));
  EXPECT_EQ(scan.degenerate_triangle_count, 1);
  ExpectSameMesh(scan, mesh);
}

}  // namespace
}  // namespace fitroom
