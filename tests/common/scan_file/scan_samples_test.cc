// Reads the files that real exporters wrote, and compares with counts that do not come from the reader.
#include <filesystem>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "common/base/file.h"
#include "common/codec/zstd.h"
#include "common/scan_file/scan_file.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

using testing::TestDataFolder;

int64_t CountOccurrences(std::string_view text, std::string_view word) {
  int64_t count = 0;
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + word.size())) ++count;
  return count;
}

void ExpectAseAgreesWithItsLines(std::string_view text, const RawScan& scan) {
  EXPECT_EQ(scan.format, ScanFormat::kAse);
  EXPECT_EQ(static_cast<int64_t>(scan.mesh.vertices.size()), CountOccurrences(text, "*MESH_VERTEX "));
  EXPECT_EQ(static_cast<int64_t>(scan.mesh.triangles.size()), CountOccurrences(text, "*MESH_FACE "));
  EXPECT_EQ(static_cast<int64_t>(scan.texture_coordinates.size()), CountOccurrences(text, "*MESH_TVERT "));
  EXPECT_EQ(static_cast<int64_t>(scan.texture_triangles.size()), CountOccurrences(text, "*MESH_TFACE "));
  EXPECT_EQ(static_cast<int64_t>(scan.objects.size()), CountOccurrences(text, "*MESH {"));
  EXPECT_EQ(scan.has_normals, CountOccurrences(text, "*MESH_NORMALS") > 0);
}

TEST(ScanSamples, CompressedAseScansHoldEveryLineOfTheirFiles) {
  FR_REQUIRE_TEST_DATA();
  for (const char* name : {"p001_scan_60MB.ase.zst", "p002_scan.ase.zst"}) {
    SCOPED_TRACE(name);
    const Result<std::string> packed = ReadFile(TestDataFolder() / "bodies/scans" / name, size_t{64} << 20);
    ASSERT_TRUE(packed.ok()) << packed.status().ToString();
    const Result<std::string> text = ZstdDecompress(*packed);
    ASSERT_TRUE(text.ok()) << text.status().ToString();
    const Result<RawScan> scan = ReadScan(*packed, name);
    ASSERT_TRUE(scan.ok()) << scan.status().ToString();
    EXPECT_TRUE(scan->is_compressed);
    ExpectAseAgreesWithItsLines(*text, *scan);
    const std::string id(std::string_view(name).substr(0, 4));
    EXPECT_EQ(scan->texture_path, "C:\\scans\\" + id + "_skin.jpg");
    ASSERT_EQ(scan->comments.size(), 1U);
    EXPECT_NE(scan->comments[0].find("units cm, z up"), std::string::npos);
  }
}

// The same body as ASE and as PLY: z up facing -y against y up facing +z, so (x, y, z) is (x, -z, y).
TEST(ScanSamples, AseAndPlyOfOneScanAreTheSameSurface) {
  FR_REQUIRE_TEST_DATA();
  const auto folder = TestDataFolder() / "bodies/scans";
  const Result<RawScan> ase = ReadScanFile(folder / "p002_scan.ase.zst");
  const Result<RawScan> ply = ReadScanFile(folder / "p002_scan.ply");
  ASSERT_TRUE(ase.ok()) << ase.status().ToString();
  ASSERT_TRUE(ply.ok()) << ply.status().ToString();
  ASSERT_EQ(ase->mesh.vertices.size(), ply->mesh.vertices.size());
  ASSERT_EQ(ase->mesh.triangles, ply->mesh.triangles);
  for (size_t i = 0; i < ase->mesh.vertices.size(); ++i) {
    const Eigen::Vector3d& p = ase->mesh.vertices[i];
    const Eigen::Vector3d turned(p.x(), p.z(), -p.y());
    ASSERT_LT((turned - ply->mesh.vertices[i]).norm(), 1e-3) << i;
  }
}

TEST(ScanSamples, ForeignAseFilesAreRead) {
  FR_REQUIRE_TEST_DATA();
  const auto folder = TestDataFolder() / "bodies/foreign";
  for (const char* name : {"assimp__models__ASE__MotionCaptureROM.ase", "assimp__models__ASE__RotatingCube.ASE",
                           "assimp__models__ASE__ThreeCubesGreen.ASE"}) {
    SCOPED_TRACE(name);
    const Result<std::string> text = ReadFile(folder / name, 1 << 24);
    ASSERT_TRUE(text.ok());
    const Result<RawScan> scan = ReadScan(*text, name);
    ASSERT_TRUE(scan.ok()) << scan.status().ToString();
    ExpectAseAgreesWithItsLines(*text, *scan);
  }
  const Result<RawScan> plain = ReadScanFile(folder / "assimp__models__ASE__ThreeCubesGreen.ASE");
  const Result<RawScan> utf16 = ReadScanFile(folder / "assimp__models__ASE__ThreeCubesGreen_UTF16LE.ASE");
  ASSERT_TRUE(utf16.ok()) << utf16.status().ToString();
  EXPECT_EQ(utf16->encoding, ScanEncoding::kUtf16LittleEndian);
  EXPECT_EQ(utf16->mesh.vertices, plain->mesh.vertices);
  EXPECT_EQ(utf16->mesh.triangles, plain->mesh.triangles);
}

TEST(ScanSamples, PopulationHasTheDocumentedCounts) {
  FR_REQUIRE_TEST_DATA();
  int body_count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TestDataFolder() / "bodies/population")) {
    if (entry.path().extension() != ".ply") continue;
    ++body_count;
    const Result<RawScan> scan = ReadScanFile(entry.path());
    ASSERT_TRUE(scan.ok()) << scan.status().ToString();
    EXPECT_EQ(scan->mesh.vertices.size(), 13380U);
    EXPECT_EQ(scan->mesh.triangles.size(), 26756U);  // Closed of genus 0: 2 (13380 - 2).
    EXPECT_EQ(scan->encoding, ScanEncoding::kBinaryLittleEndian);
  }
  EXPECT_GE(body_count, 100);
}

TEST(ScanSamples, RangeGridsBecomeSurfacesThatFaceTheScanner) {
  FR_REQUIRE_TEST_DATA();
  for (const char* name : {"p001_head135_rangegrid_be.ply", "p001_head45_rangegrid_ascii.ply"}) {
    SCOPED_TRACE(name);
    const Result<RawScan> scan = ReadScanFile(TestDataFolder() / "bodies/foreign" / name);
    ASSERT_TRUE(scan.ok()) << scan.status().ToString();
    const TriangleMesh& mesh = scan->mesh;
    // A triangulated height field of n samples has nearly 2 n triangles; holes and jumps in depth take some.
    EXPECT_GT(mesh.triangles.size(), mesh.vertices.size() * 18 / 10);
    EXPECT_LT(mesh.triangles.size(), mesh.vertices.size() * 2);
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const Eigen::Vector3d& a = mesh.vertices[static_cast<size_t>(t[0])];
      const Eigen::Vector3d ab = mesh.vertices[static_cast<size_t>(t[1])] - a;
      const Eigen::Vector3d ac = mesh.vertices[static_cast<size_t>(t[2])] - a;
      ASSERT_GE(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);  // A height field over x and y never turns its back on +z.
    }
  }
}

TEST(ScanSamples, ForeignPlyFilesAreReadOrRefusedForAReason) {
  FR_REQUIRE_TEST_DATA();
  const auto folder = TestDataFolder() / "bodies/foreign";
  const Result<RawScan> wuson = ReadScanFile(folder / "assimp__Wuson.ply");
  ASSERT_TRUE(wuson.ok()) << wuson.status().ToString();
  EXPECT_EQ(wuson->mesh.vertices.size(), 11184U);  // As its head declares.
  EXPECT_EQ(wuson->mesh.triangles.size(), 3732U);
  EXPECT_TRUE(wuson->has_normals);
  EXPECT_TRUE(wuson->has_texture_coordinates());
  const Result<RawScan> points = ReadScanFile(folder / "assimp__points.ply");
  ASSERT_FALSE(points.ok());
  EXPECT_EQ(points.status().reason(), "NO_TRIANGLES");
}

}  // namespace
}  // namespace fitroom
