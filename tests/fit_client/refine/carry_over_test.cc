#include "fit_client/fit/refine/carry_over.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/base/executor.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/solver/drape.h"
#include "tests/fit_client/panels/drawn_kinds.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

// An affine map of the flat panels into space.
Eigen::Vector3d Mapped(const Eigen::Vector3d& at, int panel) {
  return {0.3 + 0.9 * at.x() - 0.2 * at.y(), 1.1 * at.y() + 0.1 * at.x(), (panel == 0 ? 0.1 : -0.1) + 0.4 * at.y()};
}

std::vector<Eigen::Vector3d> MappedAll(const ClothMesh& mesh) {
  std::vector<Eigen::Vector3d> positions;
  for (size_t vertex = 0; vertex < mesh.rest_positions.size(); ++vertex) {
    positions.push_back(Mapped(mesh.rest_positions[vertex], mesh.panel_of_particle[vertex]));
  }
  return positions;
}

// Pieces of two triangles, and one beside them: numbered by their lowest particles, seams do not join them.
TEST(ClothMesh, PiecesAreWhatTrianglesJoin) {
  ClothMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {5, 0, 0}, {1, 0, 0}, {6, 0, 0}, {0, 1, 0}, {5, 1, 0}, {1, 1, 0}, {9, 9, 0}};
  mesh.triangles = {{0, 2, 4}, {1, 3, 5}, {6, 4, 2}};
  mesh.seams = {{2, 1}};
  const ClothPieces pieces = FindPieces(mesh);
  EXPECT_EQ(pieces.piece_of_particle, (std::vector<int>{0, 1, 0, 1, 0, 1, 0, 2}));
  EXPECT_EQ(pieces.count, 3);
  EXPECT_EQ(FindPieces({}).count, 0);
}

TEST(ClothMesh, TheMeanEdgeOfUnitRightTrianglesIsTheirPerimetersThird) {
  ClothMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  EXPECT_NEAR(MeanEdgeLength(mesh), (2.0 + std::sqrt(2.0)) / 3.0, 1e-12);
  EXPECT_EQ(MeanEdgeLength({}), 0.0);
}

// Barycentric interpolation and extrapolation reproduce affine maps exactly, beside the coarse outline as well.
TEST(CarryOver, ReproducesAnAffineMapOnEveryVertexOfTheFinerMesh) {
  const GarmentPattern pattern = ReconcileViews(testing::DrawKind(GarmentKind::kTShirt)).value();
  const ClothMesh coarse = MeshPattern(pattern, 0.03).value();
  const ClothMesh fine = MeshPattern(pattern, 0.011).value();
  const Result<std::vector<PlaceOnMesh>> places = FindPlaces(coarse, fine);
  ASSERT_TRUE(places.ok()) << places.status().ToString();
  const std::vector<Eigen::Vector3d> carried = CarryOver(*places, MappedAll(coarse));
  const std::vector<Eigen::Vector3d> expected = MappedAll(fine);
  ASSERT_EQ(carried.size(), expected.size());
  int beside = 0;
  for (size_t vertex = 0; vertex < carried.size(); ++vertex) {
    EXPECT_LT((carried[vertex] - expected[vertex]).norm(), 1e-9);
    for (const double weight : (*places)[vertex].weights) beside += weight < -1e-6;
    for (const int corner : (*places)[vertex].vertices) {
      EXPECT_EQ(coarse.panel_of_particle[static_cast<size_t>(corner)], fine.panel_of_particle[vertex]);
    }
  }
  EXPECT_GT(beside, 0) << "no vertex lay beside the coarse outline: its curves were not tried";
}

// Two pieces of one panel that lie on each other when flat keep their vertices apart.
TEST(CarryOver, TellsPiecesThatOverlapApart) {
  const auto doubled = [](ClothMesh mesh) {
    const int count = static_cast<int>(mesh.rest_positions.size());
    const std::vector<Eigen::Vector3i> triangles = mesh.triangles;
    for (int vertex = 0; vertex < count; ++vertex) {
      mesh.rest_positions.push_back(mesh.rest_positions[static_cast<size_t>(vertex)]);
    }
    for (const Eigen::Vector3i& triangle : triangles) {
      mesh.triangles.emplace_back(triangle + Eigen::Vector3i::Constant(count));
    }
    return mesh;
  };
  const ClothMesh one = testing::MakeSheet(0.2, 0.1, 4, 2);
  const ClothMesh coarse = doubled(one);
  const ClothMesh fine = doubled(testing::MakeSheet(0.2, 0.1, 12, 6));
  const std::vector<PlaceOnMesh> places = FindPlaces(coarse, fine).value();
  for (size_t vertex = 0; vertex < places.size(); ++vertex) {
    for (const int corner : places[vertex].vertices) {
      EXPECT_EQ(static_cast<size_t>(corner) >= one.rest_positions.size(), vertex >= places.size() / 2);
    }
  }
  EXPECT_EQ(FindPlaces(one, fine).status().reason(), "MESHES_DIFFER");
}

TEST(CarryOver, LeavesStagesThatDoNotExistEmpty) {
  const ClothMesh mesh = testing::MakeSheet(0.2, 0.1, 4, 2);
  EXPECT_TRUE(CarryOver(FindPlaces(mesh, mesh).value(), {}).empty());
}

// A tube round a sphere, draped coarse, settles fine: it stays where it was, and any number of threads gives its bytes.
TEST(Settle, StaysWhereTheCoarseMeshCameToRestAndGivesTheSameForAnyThreadCount) {
  const SignedDistanceField body = testing::MakeFarBody();
  const ClothMesh coarse = testing::MakeTube(0.24, 0.2, 12, 10, 0.12);
  const ClothMesh fine = testing::MakeTube(0.24, 0.2, 24, 20, 0.12);
  SerialExecutor serial;
  DrapeOptions options;
  options.gravity.setZero();
  const DrapeResult worn = Drape(coarse, coarse.rest_positions, body, options, serial, {}).value();
  ASSERT_EQ(worn.report.outcome, DrapeOutcome::kAtRest);
  std::vector<Eigen::Vector3d> start = CarryOver(FindPlaces(coarse, fine).value(), worn.positions);
  std::vector<Eigen::Vector3d> reference;
  for (const int thread_count : {1, 2}) {
    ThreadPool pool(thread_count);
    const Result<DrapeResult> settled = Settle(fine, start, body, options, pool, {});
    ASSERT_TRUE(settled.ok());
    EXPECT_EQ(settled->report.outcome, DrapeOutcome::kAtRest);
    EXPECT_EQ(settled->report.merging_substeps, 0);
    EXPECT_EQ(settled->report.final_seam_gap_max, 0.0);
    for (size_t vertex = 0; vertex < start.size(); ++vertex) {
      EXPECT_LT((settled->positions[vertex] - start[vertex]).norm(), 0.005);
    }
    if (reference.empty()) reference = settled->positions;
    EXPECT_EQ(settled->positions, reference) << thread_count << " threads";
  }
}

}  // namespace
}  // namespace fitroom
