#include <string>

#include <gtest/gtest.h>

#include "common/scan_file/obj_writer.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/scan_file/sample_mesh.h"

namespace fitroom {
namespace {

using testing::MakeSphere;
using testing::Replace;

RawScan ReadOrFail(const std::string& bytes) {
  Result<RawScan> scan = ReadScan(bytes, "sample.obj");
  if (!scan.ok()) {
    ADD_FAILURE() << scan.status().ToString();
    return {};
  }
  return std::move(scan).value();
}

TEST(Obj, ComesBackAsItWasWritten) {
  TriangleMesh mesh = MakeSphere(9, 11);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= 1.0 / 3.0;  // Needs all 17 digits.
  mesh.vertices.emplace_back(1e-7, -3.25e8, 0.0);                     // Used by no triangle, kept all the same.
  const std::string text = FormatObj(mesh, "a sphere");
  for (const std::string& bytes : {text, Replace(text, "\n", "\r\n"), Replace(text, "\n", "\r")}) {
    const RawScan scan = ReadOrFail(bytes);
    EXPECT_EQ(scan.format, ScanFormat::kObj);
    EXPECT_EQ(scan.mesh.vertices, mesh.vertices);
    EXPECT_EQ(scan.mesh.triangles, mesh.triangles);
    EXPECT_EQ(scan.comments.front(), "a sphere");
  }
}

TEST(Obj, FansPolygonsAndCountsBackwards) {
  const RawScan scan = ReadOrFail(
      "mtllib some.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1 0\n"
      "vn 0 0 1\nusemtl skin\ns off\nf 1/1/1 2/2/1 \\\n3/3/1 4/4/1\nf -4//-1 -3//-1 -2//-1 # a remark\nl 1 2\n");
  const std::vector<Eigen::Vector3i> expected = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}};
  EXPECT_EQ(scan.mesh.triangles, expected);
  EXPECT_TRUE(scan.has_normals);
  ASSERT_EQ(scan.texture_triangles.size(), 3U);
  EXPECT_EQ(scan.texture_triangles[1], Eigen::Vector3i(0, 2, 3));
  EXPECT_EQ(scan.texture_triangles[2], Eigen::Vector3i(-1, -1, -1));
}

// The remarks at the head tell a file that was cut anywhere, also at the end of a line.
TEST(Obj, FindsEveryTruncationByTheCountsAtItsHead) {
  const std::string text = FormatObj(MakeSphere(4, 5));
  EXPECT_TRUE(ReadScan(text, "whole.obj").ok());
  for (size_t size = text.find('v'); size < text.size(); ++size) {
    EXPECT_FALSE(ReadScan(text.substr(0, size), "cut.obj").ok()) << size;
  }
}

TEST(Obj, NamesObjectsAndGroups) {
  const RawScan scan = ReadOrFail(
      "o first\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no second\nv 0 0 1\nv 1 0 1\nv 0 1 1\ng part\nf 4 5 6\nf 4 5 1\n");
  ASSERT_EQ(scan.objects.size(), 2U);
  EXPECT_EQ(scan.objects[0].name, "first");
  EXPECT_EQ(scan.objects[0].triangle_count, 1);
  EXPECT_EQ(scan.objects[1].name, "part");
  EXPECT_EQ(scan.objects[1].first_vertex, 3);
  EXPECT_EQ(scan.objects[1].triangle_count, 2);
}

TEST(Obj, RefusesIndicesThatAreNotThere) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face : {"f 1 2 4\n", "f 0 1 2\n", "f 1 2 -4\n", "f 1 2 99999999999999999999\n", "f a b c\n",
                           "f 1 2 3.5\n", "f 1/9 2/9 3/9\n", "f 1 2 2147483648\n"}) {
    const Result<RawScan> scan = ReadScan(vertices + face, "bad.obj");
    ASSERT_FALSE(scan.ok()) << face;
    EXPECT_EQ(scan.status().reason(), "INDEX_OUT_OF_RANGE") << face;
    EXPECT_NE(scan.status().message().find("bad.obj:4: "), std::string::npos) << scan.status().message();
  }
  EXPECT_EQ(ReadScan(vertices + "f 1 2\n", "bad.obj").status().reason(), "MALFORMED_FACE");
  EXPECT_EQ(ReadScan(vertices + "f 1 2 3", "bad.obj").status().reason(), "TRUNCATED_FILE");
}

}  // namespace
}  // namespace fitroom
