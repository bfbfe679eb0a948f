#include "common/codec/packed_mesh.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "common/codec/crc32c.h"
#include "common/codec/zstd.h"

namespace fitroom {
namespace {

// A wavy sheet with noise, like a piece of a scan; float32 exactly.
TriangleMesh MakeSheet(int columns, int rows) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 3e-4);
  TriangleMesh mesh;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Eigen::Vector3d p(0.004 * c + noise(random), 0.004 * r + noise(random), 0.1 * std::sin(0.05 * c));
      mesh.vertices.emplace_back(p.cast<float>().cast<double>());
    }
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int a = r * columns + c;
      mesh.triangles.emplace_back(a, a + 1, a + columns + 1);
      mesh.triangles.emplace_back(a + columns, a, a + columns + 1);
    }
  }
  return mesh;
}

void ExpectRoundTrip(const TriangleMesh& mesh) {
  const Result<std::string> packed = PackMesh(mesh);
  ASSERT_TRUE(packed.ok()) << packed.status().ToString();
  const Result<TriangleMesh> unpacked = UnpackMesh(*packed);
  ASSERT_TRUE(unpacked.ok()) << unpacked.status().ToString();
  EXPECT_EQ(unpacked->vertices, mesh.vertices);
  EXPECT_EQ(unpacked->triangles, mesh.triangles);
  const Result<PackedMeshCounts> counts = ReadPackedMeshCounts(*packed);
  ASSERT_TRUE(counts.ok());
  EXPECT_EQ(counts->vertex_count, static_cast<int64_t>(mesh.vertices.size()));
  EXPECT_EQ(counts->triangle_count, static_cast<int64_t>(mesh.triangles.size()));
}

TEST(PackedMesh, KeepsVerticesTrianglesAndTheirOrder) {
  ExpectRoundTrip({});
  TriangleMesh points;
  points.vertices = {{1, 2, 3}, {-0.0, 4, 5}};
  ExpectRoundTrip(points);
  ExpectRoundTrip(MakeSheet(2, 2));
  ExpectRoundTrip(MakeSheet(100, 83));
  TriangleMesh shuffled = MakeSheet(40, 40);
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(11));
  ExpectRoundTrip(shuffled);
}

TEST(PackedMesh, SurvivesRandomMeshes) {
  std::mt19937 random(42);
  for (int round = 0; round < 50; ++round) {
    TriangleMesh mesh;
    const int vertex_count = 1 + static_cast<int>(random() % 1000);
    std::uniform_real_distribution<double> coordinate(-1e3, 1e3);
    for (int i = 0; i < vertex_count; ++i) {
      const Eigen::Vector3d p(coordinate(random), coordinate(random), coordinate(random));
      mesh.vertices.emplace_back(p.cast<float>().cast<double>());
    }
    const auto index = [&] { return static_cast<int>(random() % static_cast<unsigned>(vertex_count)); };
    for (int i = 0; i < vertex_count; ++i) mesh.triangles.emplace_back(index(), index(), index());
    SCOPED_TRACE(round);
    ExpectRoundTrip(mesh);
  }
}

// float32 vertices and int32 triangles take 12 bytes each; of those at least two thirds go.
TEST(PackedMesh, PacksToAThird) {
  const TriangleMesh mesh = MakeSheet(350, 343);
  const size_t raw_size = 12 * (mesh.vertices.size() + mesh.triangles.size());
  EXPECT_LT(PackMesh(mesh)->size(), raw_size / 3);
}

TEST(PackedMesh, RefusesWhatIsNoMesh) {
  TriangleMesh mesh = MakeSheet(3, 3);
  mesh.triangles[1][2] = 9;
  EXPECT_EQ(PackMesh(mesh).status().reason(), "INDEX_OUT_OF_RANGE");
  mesh.triangles[1][2] = -1;
  EXPECT_EQ(PackMesh(mesh).status().reason(), "INDEX_OUT_OF_RANGE");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e39}) {
    mesh = MakeSheet(3, 3);
    mesh.vertices[4].y() = bad;
    EXPECT_EQ(PackMesh(mesh).status().reason(), "MESH_NOT_FINITE") << bad;
  }
}

TEST(PackedMesh, FindsEveryTruncationAndFlippedBit) {
  const std::string packed = *PackMesh(MakeSheet(8, 8));
  for (size_t size = 0; size < packed.size(); ++size) {
    ASSERT_EQ(UnpackMesh(packed.substr(0, size)).status().code(), StatusCode::kDataLoss) << size;
  }
  EXPECT_EQ(UnpackMesh(packed + "x").status().code(), StatusCode::kDataLoss);
  for (size_t bit = 0; bit < 8 * packed.size(); ++bit) {
    std::string flipped = packed;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    ASSERT_EQ(UnpackMesh(flipped).status().code(), StatusCode::kDataLoss) << bit;
  }
}

// Sets a 32-bit field of the head and puts the checksum right, as one who means harm would.
std::string Forge(std::string packed, size_t offset, uint32_t value) {
  for (size_t i = 0; i < 4; ++i) packed[offset + i] = static_cast<char>(value >> (8 * i));
  const uint32_t checksum =
      ExtendCrc32c(Crc32c(std::string_view(packed).substr(0, 28)), std::string_view(packed).substr(32));
  for (size_t i = 0; i < 4; ++i) packed[28 + i] = static_cast<char>(checksum >> (8 * i));
  return packed;
}

TEST(PackedMesh, BelievesNoForgedCount) {
  const std::string packed = *PackMesh(MakeSheet(20, 20));
  ASSERT_TRUE(UnpackMesh(Forge(packed, 8, 400)).ok());  // The true count: forging itself works.
  for (const size_t offset : {8U, 12U, 16U, 20U, 24U}) {
    // Up to 448 vertices the code looks the same (the last group is filled with copies): such a lie makes no harm.
    for (const uint32_t lie : {0U, 1U, 7U, 399U, 449U, 65536U, 200000000U, 2147483648U, 4294967295U}) {
      const Result<TriangleMesh> mesh = UnpackMesh(Forge(packed, offset, lie));
      ASSERT_FALSE(mesh.ok()) << offset << " " << lie;
    }
  }
  PackedMeshLimits limits;
  limits.max_vertex_count = 399;
  EXPECT_EQ(UnpackMesh(packed, limits).status().code(), StatusCode::kResourceExhausted);
}

// A payload that unpacks to far more than the counts can need is refused by its head alone.
TEST(PackedMesh, RefusesCodeThatIsTooLongForItsCounts) {
  const std::string packed = *PackMesh(MakeSheet(20, 20));
  const std::string padding = ZstdCompress(std::string(size_t{16} << 20, '\0'));
  for (const size_t offset : {16U, 20U}) {  // Of the vertices' code, of the triangles'.
    std::string forged = packed.substr(0, 32) + padding;
    forged = Forge(forged, 24, static_cast<uint32_t>(padding.size()));
    forged = Forge(forged, offset, 16U << 20);
    const Status status = UnpackMesh(forged).status();
    EXPECT_EQ(status.code(), StatusCode::kDataLoss);
    EXPECT_NE(status.message().find("declares more than it can hold"), std::string::npos) << status.message();
  }
}

// Random bytes behind a true head with a right checksum: never a crash, never a mesh that breaks its own promises.
TEST(PackedMesh, SurvivesDamagedPayloadsWithARightChecksum) {
  const std::string packed = *PackMesh(MakeSheet(20, 20));
  std::mt19937 random(3);
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = packed;
    for (int k = 0; k < 3; ++k) damaged[32 + random() % (packed.size() - 32)] = static_cast<char>(random());
    const Result<TriangleMesh> mesh = UnpackMesh(Forge(damaged, 8, 400));
    if (!mesh.ok()) continue;
    for (const Eigen::Vector3i& triangle : mesh->triangles) {
      ASSERT_GE(triangle.minCoeff(), 0);
      ASSERT_LT(triangle.maxCoeff(), 400);
    }
  }
}

}  // namespace
}  // namespace fitroom
