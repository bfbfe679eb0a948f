#include <benchmark/benchmark.h>

#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

// A torus of 240,000 triangles and about a body's surface.
void BuildField(benchmark::State& state) {
  const TriangleMesh body = testing::MakeTorus(0.35, 0.12, 600, 200);
  ThreadPool pool(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(SignedDistanceField::Build(body, {}, pool).ok());
  }
  state.counters["triangles"] = static_cast<double>(body.triangles.size());
}
BENCHMARK(BuildField)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

// One substep of a sheet of 8,464 particles that lies on a sphere.
void Substep(benchmark::State& state) {
  ClothMesh sheet = testing::MakeSheet(0.91, 0.91, 91, 91);
  for (Eigen::Vector3d& place : sheet.rest_positions) place = {place.x() - 0.45, 0.21, place.y() - 0.45};
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  ThreadPool pool(static_cast<int>(state.range(0)));
  const SignedDistanceField body =
      SignedDistanceField::Build(testing::MakeSphere(Eigen::Vector3d::Zero(), 0.2, 5), {}, pool).value();
  std::vector<Eigen::Vector3d> start(sheet.rest_positions.size());
  for (size_t vertex = 0; vertex < start.size(); ++vertex) {
    start[static_cast<size_t>(model.particle_of_vertex()[vertex])] = sheet.rest_positions[vertex];
  }
  ClothSolver solver(model, body, pool);
  ClothState cloth = solver.MakeState(start);
  for (auto _ : state) solver.Advance(cloth, 10, {}, 0.0);
  state.counters["time_per_particle_substep"] =
      benchmark::Counter(10.0 * static_cast<double>(model.particle_count()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(Substep)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace fitroom
