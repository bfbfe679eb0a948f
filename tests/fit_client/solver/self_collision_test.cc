#include "fit_client/fit/solver/self_collision.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fit_client/fit/solver/self_collision_near.h"
#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

using Places = std::vector<Eigen::Vector3d>;

SignedDistanceField MakeFloor() {
  SerialExecutor serial;
  const TriangleMesh box =
      testing::MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.4, -0.1, -0.4), Eigen::Vector3d(0.4, 0.0, 0.4)), 16);
  return SignedDistanceField::Build(box, {}, serial).value();
}

// Two sheets of one cloth, side by side where they rest, and each at its own place in the world.
struct TwoSheets {
  ClothMesh mesh;
  Places places;
  int vertices_of_first = 0;
};

TwoSheets PlaceTwoSheets(const ClothMesh& first, const Eigen::Isometry3d& first_in_world, const ClothMesh& second,
                         const Eigen::Isometry3d& second_in_world) {
  TwoSheets sheets;
  sheets.mesh = first;
  sheets.vertices_of_first = static_cast<int>(first.rest_positions.size());
  for (const Eigen::Vector3d& rest : first.rest_positions) sheets.places.push_back(first_in_world * rest);
  for (const Eigen::Vector3d& rest : second.rest_positions) {
    sheets.places.push_back(second_in_world * rest);
    sheets.mesh.rest_positions.push_back(rest + Eigen::Vector3d(5.0, 0.0, 0.0));
  }
  for (const Eigen::Vector3i& triangle : second.triangles) {
    sheets.mesh.triangles.push_back(triangle.array() + sheets.vertices_of_first);
  }
  return sheets;
}

// A sheet of MakeSheet() laid level, centred above `centre`, turned by `angle` about the vertical.
Eigen::Isometry3d Level(double width, double height, const Eigen::Vector3d& centre, double angle) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(centre);
  pose.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()));
  pose.translate(Eigen::Vector3d(-0.5 * width, -0.5 * height, 0.0));
  return pose;
}

// Cloth in motion, with or without self-collision.
class Scene {
 public:
  Scene(const ClothMesh& mesh, const Places& places, const SignedDistanceField& body, Executor& executor,
        bool with_self_collision)
      : mesh_(mesh),
        model_(ClothModel::Create(mesh, {}, {}).value()),
        solver_(model_, body, executor),
        self_collision_(model_, {}, executor) {
    Places particles(places.size());
    for (size_t vertex = 0; vertex < places.size(); ++vertex) particles[Particle(vertex)] = places[vertex];
    state_ = solver_.MakeState(particles);
    if (with_self_collision) solver_.SetSelfCollision(&self_collision_);
  }

  size_t Particle(size_t vertex) const { return static_cast<size_t>(model_.particle_of_vertex()[vertex]); }
  void Move(double time_step, const Eigen::Vector3d& gravity, double drag, double seconds) {
    MotionOptions motion;
    motion.time_step = time_step;
    motion.gravity = gravity;
    motion.drag = drag;
    solver_.SetMotion(motion);
    solver_.Advance(state_, static_cast<int>(std::lround(seconds / time_step)), {}, 0.0);
  }
  void SetVelocity(size_t vertex, const Eigen::Vector3d& velocity) {
    state_.velocities[Particle(vertex)] = {static_cast<float>(velocity.x()), static_cast<float>(velocity.y()),
                                           static_cast<float>(velocity.z()), 0.0F};
  }
  Eigen::Vector3d Momentum() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t particle = 0; particle < model_.masses().size(); ++particle) {
      const Float4& v = state_.velocities[particle];
      sum += model_.masses()[particle] * Eigen::Vector3d(v.x, v.y, v.z);
    }
    return sum;
  }
  // One a vertex of the mesh.
  Places Positions() const {
    const Places particles = ClothSolver::Positions(state_, model_.particle_count());
    Places places;
    for (size_t vertex = 0; vertex < mesh_.rest_positions.size(); ++vertex) {
      places.push_back(particles[Particle(vertex)]);
    }
    return places;
  }
  void Iron(const SignedDistanceField& body) {
    self_collision_.Iron(body, /*contact_offset=*/0.003, /*may_yield=*/false, state_);
  }
  const ClothState& state() const { return state_; }
  const ClothModel& model() const { return model_; }
  SelfCollision& self_collision() { return self_collision_; }

 private:
  const ClothMesh& mesh_;
  ClothModel model_;
  ClothSolver solver_;
  SelfCollision self_collision_;
  ClothState state_;
};

// Six times the signed volume of a tetrahedron.
double Volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Counts edges through triangles, each against each, by the signs of five volumes.
int CountCrossings(const ClothMesh& mesh, const Places& places) {
  const auto at = [&](int vertex) -> const Eigen::Vector3d& { return places[static_cast<size_t>(vertex)]; };
  std::set<std::array<int, 2>> edges;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      edges.insert({std::min(t[corner], t[(corner + 1) % 3]), std::max(t[corner], t[(corner + 1) % 3])});
    }
  }
  int count = 0;
  for (const auto& [p, q] : edges) {
    for (const Eigen::Vector3i& t : mesh.triangles) {
      if ((t.array() == p).any() || (t.array() == q).any()) continue;
      if ((Volume(at(t[0]), at(t[1]), at(t[2]), at(p)) > 0.0) == (Volume(at(t[0]), at(t[1]), at(t[2]), at(q)) > 0.0)) {
        continue;
      }
      const bool first = Volume(at(p), at(q), at(t[0]), at(t[1])) > 0.0;
      const bool second = Volume(at(p), at(q), at(t[1]), at(t[2])) > 0.0;
      const bool third = Volume(at(p), at(q), at(t[2]), at(t[0])) > 0.0;
      if (first == second && second == third) ++count;
    }
  }
  return count;
}

TEST(SelfCollision, NearParticlesAreThoseOfAComparisonOfEachWithEach) {
  const unsigned seed = 7;
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-0.05F, 0.05F);
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 20, 20);
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  const SelfCollisionTopology topology = MakeSelfCollisionTopology(model);
  const int count = model.particle_count();
  std::vector<Float4> positions(static_cast<size_t>(count));
  for (Float4& at : positions) at = {place(random), place(random), place(random), 1.0F};
  SerialExecutor serial;
  const NumberLists near = FindNearParticles(positions, count, topology.neighbours_of_particle, 0.013F, 100000, serial);
  size_t pair_count = 0;
  for (int a = 0; a < count; ++a) {
    const auto distance_to = [&](int b) {
      const Float4& p = positions[static_cast<size_t>(a)];
      const Float4& q = positions[static_cast<size_t>(b)];
      return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    };
    std::set<int> expected;
    const std::span<const int> ring = topology.neighbours_of_particle.Of(a);
    for (int b = 0; b < count; ++b) {
      if (b != a && distance_to(b) < 0.013F && std::count(ring.begin(), ring.end(), b) == 0) expected.insert(b);
    }
    const std::span<const int> found = near.Of(a);
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_EQ(std::set<int>(found.begin(), found.end()), expected);
    pair_count += expected.size();
  }
  EXPECT_GT(pair_count, 400u);
  // The stated limit holds, whatever lies in one place.
  for (Float4& at : positions) at = {0.0F, 0.0F, 0.0F, 1.0F};
  EXPECT_EQ(FindNearParticles(positions, count, topology.neighbours_of_particle, 0.013F, 500, serial).items.size(),
            1000u);
}

TEST(SelfCollision, ASheetThatFallsOnAnotherEndsApartByTheThickness) {
  const ClothMesh lower = testing::MakeSheet(0.2, 0.2, 20, 20);
  const ClothMesh upper = testing::MakeSheet(0.12, 0.12, 12, 12);
  const TwoSheets sheets =
      PlaceTwoSheets(lower, Level(0.2, 0.2, {0.0, 0.003, 0.0}, 0.0), upper, Level(0.12, 0.12, {0.0, 0.03, 0.0}, 0.5));
  const SignedDistanceField floor = MakeFloor();
  SerialExecutor serial;
  for (const bool with_self_collision : {true, false}) {
    Scene scene(sheets.mesh, sheets.places, floor, serial, with_self_collision);
    scene.Move(4e-4, {0.0, -9.81, 0.0}, 5.0, 0.5);
    const Places places = scene.Positions();
    double lower_top = 0.0;
    for (int vertex = 0; vertex < sheets.vertices_of_first; ++vertex) {
      lower_top = std::max(lower_top, places[static_cast<size_t>(vertex)].y());
    }
    double least = 1.0;
    double most = 0.0;
    for (size_t vertex = static_cast<size_t>(sheets.vertices_of_first); vertex < places.size(); ++vertex) {
      least = std::min(least, places[vertex].y() - lower_top);
      most = std::max(most, places[vertex].y() - lower_top);
    }
    const double thickness = SelfCollisionOptions().thickness;
    if (with_self_collision) {
      EXPECT_GT(least, 0.85 * thickness);
      EXPECT_LT(most, 1.3 * thickness);
      EXPECT_EQ(CountCrossings(sheets.mesh, places), 0);
    } else {
      EXPECT_LT(most, 0.5 * thickness);  // Both lie on the floor.
    }
  }
}

TEST(SelfCollision, AStripThatPilesUpOnTheFloorDoesNotPassThroughItself) {
  const ClothMesh strip = testing::MakeSheet(0.06, 0.3, 6, 30);
  Places places = strip.rest_positions;
  for (Eigen::Vector3d& place : places) {
    place += Eigen::Vector3d(-0.03, 0.01, 0.001 * std::sin(40.0 * place.y()) + 0.03 * place.x());
  }
  const SignedDistanceField floor = MakeFloor();
  SerialExecutor serial;
  Scene loose(strip, places, floor, serial, false);
  loose.Move(4e-4, {0.0, -9.81, 0.0}, 5.0, 0.8);
  EXPECT_GT(CountCrossings(strip, loose.Positions()), 10);
  Scene scene(strip, places, floor, serial, true);
  scene.Move(4e-4, {0.0, -9.81, 0.0}, 5.0, 0.8);
  EXPECT_EQ(CountCrossings(strip, scene.Positions()), 0);
  for (const Eigen::Vector3d& place : scene.Positions()) EXPECT_LT(place.y(), 0.12);
}

TEST(SelfCollision, SheetsThatMeetKeepTheirMomentum) {
  const ClothMesh first = testing::MakeSheet(0.1, 0.1, 10, 10);
  const ClothMesh second = testing::MakeSheet(0.06, 0.07, 6, 7);
  const TwoSheets sheets =
      PlaceTwoSheets(first, Level(0.1, 0.1, {0.0, 0.0, 0.0}, 0.0), second, Level(0.06, 0.07, {0.0, 0.012, 0.0}, 0.4));
  const SignedDistanceField far = testing::MakeFarBody();
  SerialExecutor serial;
  Scene scene(sheets.mesh, sheets.places, far, serial, true);
  for (size_t vertex = 0; vertex < sheets.places.size(); ++vertex) {
    const bool is_first = vertex < static_cast<size_t>(sheets.vertices_of_first);
    scene.SetVelocity(vertex, is_first ? Eigen::Vector3d(0.1, 0.05, 0.0) : Eigen::Vector3d(0.0, -0.4, 0.1));
  }
  const Eigen::Vector3d before = scene.Momentum();
  scene.Move(2.5e-4, Eigen::Vector3d::Zero(), 0.0, 0.1);
  EXPECT_GT(scene.self_collision().contact_count(), 50);
  EXPECT_LT((scene.Momentum() - before).norm(), 2e-3 * before.norm());
  // They did meet: the second no longer moves through the first.
  const Places places = scene.Positions();
  EXPECT_EQ(CountCrossings(sheets.mesh, places), 0);
  EXPECT_GT(places.back().y(), places.front().y());
}

TEST(SelfCollision, ASheetThatStartsThroughAnotherIsDrawnOut) {
  const ClothMesh level = testing::MakeSheet(0.16, 0.16, 16, 16);
  const ClothMesh upright = testing::MakeSheet(0.06, 0.08, 6, 8);
  Eigen::Isometry3d through = Eigen::Isometry3d::Identity();
  through.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  through.translate(Eigen::Vector3d(-0.033, -0.027, 0.004));  // Its lower border has come 2.7 cm through.
  const TwoSheets sheets = PlaceTwoSheets(level, Level(0.16, 0.16, {0.0, 0.0, 0.0}, 0.0), upright, through);
  const SignedDistanceField far = testing::MakeFarBody();
  SerialExecutor serial;
  Scene scene(sheets.mesh, sheets.places, far, serial, true);
  ASSERT_GT(CountCrossings(sheets.mesh, scene.Positions()), 10);
  scene.Move(2.5e-4, Eigen::Vector3d::Zero(), 10.0, 1.0);
  EXPECT_EQ(CountCrossings(sheets.mesh, scene.Positions()), 0);
}

TEST(SelfCollision, IroningTakesABulgeOutOfTheLayerAboveAndMovesNothingElse) {
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 20, 20);
  TwoSheets sheets = PlaceTwoSheets(sheet, Level(0.2, 0.2, {0.0, 0.03, 0.0}, 0.0), sheet,
                                    Level(0.2, 0.2, {0.0023, 0.034, 0.0013}, 0.3));
  for (int vertex = 0; vertex < sheets.vertices_of_first; ++vertex) {
    Eigen::Vector3d& place = sheets.places[static_cast<size_t>(vertex)];
    const double distance = std::hypot(place.x() - 0.0031, place.z() - 0.0017);
    place.y() += 0.01 * std::exp(-distance * distance / (0.02 * 0.02));
  }
  const SignedDistanceField floor = MakeFloor();
  SerialExecutor serial;
  Scene scene(sheets.mesh, sheets.places, floor, serial, true);
  const Places before = scene.Positions();
  ASSERT_GT(CountCrossings(sheets.mesh, before), 10);
  scene.Iron(floor);
  EXPECT_EQ(scene.self_collision().crossing_count(), 0);
  const Places after = scene.Positions();
  EXPECT_EQ(CountCrossings(sheets.mesh, after), 0);
  for (size_t vertex = 0; vertex < after.size(); ++vertex) {
    if (std::hypot(before[vertex].x(), before[vertex].z()) > 0.06) {
      EXPECT_EQ(after[vertex], before[vertex]);
    }
    EXPECT_LT((after[vertex] - before[vertex]).norm(), 0.015);
  }
  scene.Iron(floor);  // Nothing crosses any more.
  EXPECT_EQ(scene.Positions(), after);
}

// What tangles again and again is left: nothing pushes there any more, and ironing takes it out at the end.
TEST(SelfCollision, WhatIsLeftIsNotPushedAndStillIroned) {
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 20, 20);
  TwoSheets sheets = PlaceTwoSheets(sheet, Level(0.2, 0.2, {0.0, 0.03, 0.0}, 0.0), sheet,
                                    Level(0.2, 0.2, {0.0023, 0.034, 0.0013}, 0.3));
  for (int vertex = 0; vertex < sheets.vertices_of_first; ++vertex) {
    Eigen::Vector3d& place = sheets.places[static_cast<size_t>(vertex)];
    const double distance = std::hypot(place.x() - 0.0031, place.z() - 0.0017);
    place.y() += 0.01 * std::exp(-distance * distance / (0.02 * 0.02));
  }
  const SignedDistanceField floor = MakeFloor();
  SerialExecutor serial;
  Scene scene(sheets.mesh, sheets.places, floor, serial, true);
  scene.self_collision().Refresh(scene.state());
  ASSERT_GT(scene.self_collision().crossing_count(), 10);
  scene.self_collision().LeaveTangles();
  EXPECT_EQ(scene.self_collision().crossing_count(), 0);
  scene.self_collision().Refresh(scene.state());
  EXPECT_EQ(scene.self_collision().crossing_count(), 0);
  EXPECT_GT(CountCrossings(sheets.mesh, scene.Positions()), 10);
  Scene free(sheets.mesh, sheets.places, floor, serial, false);
  for (Scene* const each : {&scene, &free}) each->Move(4e-4, Eigen::Vector3d::Zero(), 0.0, 4e-4);
  for (size_t vertex = 0; vertex < sheets.places.size(); ++vertex) {
    if (std::hypot(sheets.places[vertex].x(), sheets.places[vertex].z()) > 0.005) continue;  // Outside of the tangle.
    EXPECT_LT((scene.Positions()[vertex] - free.Positions()[vertex]).norm(), 1e-6);
  }
  scene.Iron(floor);
  EXPECT_EQ(CountCrossings(sheets.mesh, scene.Positions()), 0);
}

TEST(SelfCollision, GivesTheSameForAnyThreadCount) {
  const ClothMesh lower = testing::MakeSheet(0.2, 0.2, 40, 40);
  const ClothMesh upper = testing::MakeSheet(0.15, 0.15, 30, 30);
  const TwoSheets sheets =
      PlaceTwoSheets(lower, Level(0.2, 0.2, {0.0, 0.003, 0.0}, 0.0), upper, Level(0.15, 0.15, {0.0, 0.006, 0.0}, 0.5));
  const SignedDistanceField floor = MakeFloor();
  std::vector<Float4> reference;
  for (const int thread_count : {1, 2, 3}) {
    ThreadPool pool(thread_count);
    Scene scene(sheets.mesh, sheets.places, floor, pool, true);
    scene.Move(2e-4, {0.0, -9.81, 0.0}, 5.0, 0.04);
    EXPECT_GT(scene.self_collision().contact_count(), 1000);
    if (reference.empty()) reference = scene.state().positions;
    EXPECT_EQ(std::memcmp(reference.data(), scene.state().positions.data(), reference.size() * sizeof(Float4)), 0)
        << thread_count << " threads";
  }
}

TEST(SelfCollision, AClothWithoutContactsMovesAsIfThereWereNone) {
  const ClothMesh sheet = testing::MakeSheet(0.2, 0.2, 20, 20);
  Places places = sheet.rest_positions;
  for (Eigen::Vector3d& place : places) place.z() += 0.01 * std::sin(20.0 * place.x());
  const SignedDistanceField far = testing::MakeFarBody();
  SerialExecutor serial;
  Scene with(sheet, places, far, serial, true);
  Scene without(sheet, places, far, serial, false);
  for (Scene* const scene : {&with, &without}) scene->Move(2.5e-4, {0.0, -9.81, 0.0}, 5.0, 0.3);
  EXPECT_EQ(std::memcmp(with.state().positions.data(), without.state().positions.data(),
                        with.state().positions.size() * sizeof(Float4)),
            0);
}

}  // namespace
}  // namespace fitroom
