#include "fit_client/fit/solver/drape_measures.h"

#include <random>

#include <gtest/gtest.h>

#include "fit_client/fit/collision/triangle_distance.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

std::vector<Eigen::Vector3d> AsParticles(const ClothModel& model, const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<Eigen::Vector3d> particles(static_cast<size_t>(model.particle_count()));
  for (size_t vertex = 0; vertex < vertices.size(); ++vertex) {
    particles[static_cast<size_t>(model.particle_of_vertex()[vertex])] = vertices[vertex];
  }
  return particles;
}

TEST(DrapeMeasures, SelfCrossingsAreThoseOfEveryPairTried) {
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 20, 20);
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  std::vector<Eigen::Vector3d> places = AsParticles(model, sheet.rest_positions);
  for (Eigen::Vector3d& place : places) place += Eigen::Vector3d(shift(random), shift(random), shift(random));
  int expected = 0;
  for (const auto& [p, q] : model.edges()) {
    for (const auto& [a, b, c] : model.triangles()) {
      if (a == p || a == q || b == p || b == q || c == p || c == q) continue;
      const auto at = [&](int particle) { return places[static_cast<size_t>(particle)]; };
      expected += SegmentCrossesTriangle(at(p), at(q), at(a), at(b), at(c)) ? 1 : 0;
    }
  }
  EXPECT_GT(expected, 100);
  ThreadPool pool(2);
  EXPECT_EQ(CountSelfCrossings(model, places, pool), expected);
}

TEST(DrapeMeasures, StrainOfAUniformStretchIsThatStretch) {
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 10, 10);
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  std::vector<Eigen::Vector3d> places = AsParticles(model, sheet.rest_positions);
  for (Eigen::Vector3d& place : places) place *= 1.07;
  DrapeReport report;
  MeasureStrain(model, places, sheet, report);
  EXPECT_NEAR(report.strain_p50, 0.07, 1e-9);
  EXPECT_NEAR(report.strain_max, 0.07, 1e-9);
}

TEST(DrapeMeasures, PenetrationSeesParticlesEdgesAndTriangles) {
  ClothMesh mesh;
  mesh.rest_positions = {{-0.1, 0.05, -0.1}, {0.1, 0.05, -0.1}, {0.0, 0.05, 0.12}};
  mesh.triangles = {{0, 1, 2}};
  const ClothModel model = ClothModel::Create(mesh, {}, {}).value();
  SerialExecutor serial;
  // A sphere that reaches 1 mm above the triangle's centre and nowhere near its corners and edges.
  const SignedDistanceField body =
      SignedDistanceField::Build(testing::MakeSphere({0.0, 0.041, -0.0267}, 0.01, 4), {}, serial).value();
  DrapeReport report;
  MeasurePenetration(model, AsParticles(model, mesh.rest_positions), body, serial, report);
  EXPECT_EQ(report.particles_inside, 0);
  EXPECT_EQ(report.samples_inside, 1);
  EXPECT_NEAR(report.deepest_penetration, 0.001, 1e-4);
}

TEST(DrapeMeasures, PercentileIsTheNearestRank) {
  EXPECT_EQ(Percentile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(Percentile({3.0, 1.0, 2.0}, 1.0), 3.0);
  EXPECT_EQ(Percentile({4.0}, 0.95), 4.0);
}

}  // namespace
}  // namespace fitroom
