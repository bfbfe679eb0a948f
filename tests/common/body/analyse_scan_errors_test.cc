#include <limits>
#include <numeric>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "common/body/analyse_scan.h"
#include "common/scan_file/scan_file.h"
#include "tests/common/body/population.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

void AddBox(TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                               (i & 4) != 0 ? high.z() : low.z());
  }
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    mesh.triangles.emplace_back(base + quad[0], base + quad[1], base + quad[2]);
    mesh.triangles.emplace_back(base + quad[0], base + quad[2], base + quad[3]);
  }
}

void Append(TriangleMesh& mesh, const TriangleMesh& other, const Eigen::Vector3d& shift) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3d& p : other.vertices) mesh.vertices.push_back(p + shift);
  for (const Eigen::Vector3i& t : other.triangles) mesh.triangles.push_back(t + Eigen::Vector3i::Constant(base));
}

std::string ReasonOf(const TriangleMesh& mesh) { return AnalyseScan(mesh, {}).status().reason(); }

TEST(AnalyseScan, RefusesWhatHasNoSurface) {
  TriangleMesh mesh;
  EXPECT_EQ(ReasonOf(mesh), "NO_SURFACE");
  mesh.vertices.assign(3, Eigen::Vector3d(1, 1, 1));
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(ReasonOf(mesh), "NO_SURFACE");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  mesh.vertices = {{nan, 0, 0}, {0, infinity, 0}, {0, 0, 1e300}};
  EXPECT_EQ(ReasonOf(mesh), "NO_SURFACE");
}

TEST(AnalyseScan, RefusesIndicesOutOfRange) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 3}};
  EXPECT_EQ(ReasonOf(mesh), "INDEX_OUT_OF_RANGE");
  mesh.triangles = {{0, -1, 2}};
  EXPECT_EQ(ReasonOf(mesh), "INDEX_OUT_OF_RANGE");
}

TEST(AnalyseScan, RefusesThingsThatAreNotBodies) {
  TriangleMesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  EXPECT_EQ(ReasonOf(triangle), "NOT_A_BODY");
  TriangleMesh cube;
  AddBox(cube, {0, 0, 0}, {1.7, 1.7, 1.7});
  EXPECT_EQ(ReasonOf(cube), "NOT_A_BODY");
  TriangleMesh chair;
  AddBox(chair, {0.00, 0.0, 0.00}, {0.05, 0.5, 0.05});
  AddBox(chair, {0.45, 0.0, 0.00}, {0.50, 0.5, 0.05});
  AddBox(chair, {0.00, 0.0, 0.45}, {0.05, 0.5, 0.50});
  AddBox(chair, {0.45, 0.0, 0.45}, {0.50, 0.5, 0.50});
  AddBox(chair, {0.00, 0.5, 0.00}, {0.50, 0.6, 0.50});
  AddBox(chair, {0.00, 0.6, 0.00}, {0.50, 1.2, 0.05});
  EXPECT_EQ(ReasonOf(chair), "NOT_A_BODY");
}

TEST(AnalyseScan, SurvivesAnySoupOfTriangles) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    std::uniform_int_distribution<int> index(0, 299);
    TriangleMesh soup;
    for (int i = 0; i < 300; ++i)
      soup.vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (int i = 0; i < 500; ++i) soup.triangles.emplace_back(index(random), index(random), index(random));
    EXPECT_FALSE(AnalyseScan(soup, {}).ok()) << "seed " << seed;
  }
}

TEST(AnalyseScan, RefusesTwoBodies) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh one = testing::ReadBody("population/p001.ply");
  const TriangleMesh other = testing::ReadBody("population/p003.ply");
  for (const Eigen::Vector3d& shift : {Eigen::Vector3d(90, 0, 0), Eigen::Vector3d(0, 0, -120)}) {
    TriangleMesh both = one;
    Append(both, other, shift);
    const Status status = AnalyseScan(both, {}).status();
    EXPECT_EQ(status.reason(), "SEVERAL_BODIES") << status.ToString();
  }
}

TEST(AnalyseScan, RefusesHalfABody) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh whole = testing::ReadBody("population/p001.ply");
  const auto part = [&whole](double low, double high) {
    TriangleMesh mesh = whole;
    std::erase_if(mesh.triangles, [&](const Eigen::Vector3i& t) {
      for (int i = 0; i < 3; ++i) {
        const double y = mesh.vertices[static_cast<size_t>(t[i])].y();
        if (y < low || y > high) return true;
      }
      return false;
    });
    return mesh;
  };
  EXPECT_EQ(ReasonOf(part(80.0, 200.0)), "NOT_A_BODY");   // From the hip up.
  EXPECT_EQ(ReasonOf(part(-10.0, 100.0)), "NOT_A_BODY");  // Up to the waist.
  EXPECT_EQ(ReasonOf(part(-10.0, 132.0)), "NOT_A_BODY");  // Without a head.
}

TEST(AnalyseScan, RefusesBodiesOfImpossibleSize) {
  FR_REQUIRE_TEST_DATA();
  TriangleMesh body = testing::ReadBody("population/p001.ply");
  for (Eigen::Vector3d& p : body.vertices) p *= 0.4;  // 64 cm, or 64 of any unit.
  const Status as_cm = AnalyseScan(body, {}).status();
  EXPECT_TRUE(as_cm.ok() || as_cm.reason() == "STATURE_OUT_OF_RANGE") << as_cm.ToString();
  FrameOverrides cm;
  cm.unit = *ParseUnit("cm");
  EXPECT_EQ(AnalyseScan(body, cm).status().reason(), "STATURE_OUT_OF_RANGE");
  for (Eigen::Vector3d& p : body.vertices) p *= 1e-3;  // 6 cm in metres.
  EXPECT_EQ(ReasonOf(body), "STATURE_OUT_OF_RANGE");
}

TEST(AnalyseScan, RefusesForeignFiles) {
  FR_REQUIRE_TEST_DATA();
  for (const char* name :
       {"foreign/assimp__Wuson.ply", "foreign/assimp__models__ASE__MotionCaptureROM.ase",
        "foreign/assimp__models__ASE__RotatingCube.ASE", "foreign/assimp__models__ASE__ThreeCubesGreen.ASE",
        "foreign/p001_head135_rangegrid_be.ply", "foreign/p001_head45_rangegrid_ascii.ply"}) {
    const TriangleMesh mesh = testing::ReadBody(name);
    const Status status = AnalyseScan(mesh, {}).status();
    EXPECT_EQ(status.reason(), "NOT_A_BODY") << name << ": " << status.ToString();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  }
}

TEST(AnalyseScan, TurnsAnInsideOutMeshAndDropsWhatIsNotTheBody) {
  FR_REQUIRE_TEST_DATA();
  const TriangleMesh clean = testing::ReadBody("population/p001.ply");
  const Result<BodyAnalysis> expected = AnalyseScan(clean, {});
  ASSERT_TRUE(expected.ok());
  TriangleMesh dirty = clean;
  for (Eigen::Vector3i& t : dirty.triangles) std::swap(t[0], t[1]);
  const size_t count = dirty.triangles.size();
  for (size_t i = 0; i < count; i += 7) dirty.triangles.push_back(dirty.triangles[i]);
  dirty.triangles.emplace_back(5, 5, 9);
  AddBox(dirty, {60, 20, 0}, {62, 22, 2});           // An island beside the body.
  dirty.vertices.emplace_back(0, std::nan(""), 0);   // Of no triangle.
  dirty.vertices.push_back(dirty.vertices.front());  // Twice at one place.
  const Result<BodyAnalysis> found = AnalyseScan(dirty, {});
  ASSERT_TRUE(found.ok()) << found.status().ToString();
  EXPECT_TRUE(found->cleaning.turned_inside_out);
  EXPECT_EQ(found->cleaning.islands, 1);
  EXPECT_EQ(found->cleaning.degenerate_triangles, 1);
  EXPECT_EQ(found->cleaning.duplicate_triangles, static_cast<int>((count + 6) / 7));
  EXPECT_EQ(found->body.mesh.vertices.size(), clean.vertices.size());
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    EXPECT_LT((found->body.landmarks[landmark].position - expected->body.landmarks[landmark].position).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace fitroom
