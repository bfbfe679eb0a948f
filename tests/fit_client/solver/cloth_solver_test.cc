#include "fit_client/fit/solver/cloth_solver.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

// A cloth in motion with everything it needs.
struct Scene {
  Scene(const ClothMesh& cloth, const ClothMaterial& material, SignedDistanceField collider)
      : mesh(cloth),
        body(std::move(collider)),
        model(ClothModel::Create(mesh, material, {}).value()),
        solver(model, body, serial) {
    std::vector<Eigen::Vector3d> particles(static_cast<size_t>(model.particle_count()));
    for (size_t vertex = 0; vertex < mesh.rest_positions.size(); ++vertex) {
      particles[static_cast<size_t>(model.particle_of_vertex()[vertex])] = mesh.rest_positions[vertex];
    }
    state = solver.MakeState(particles);
  }
  Eigen::Vector3d At(int vertex) const {
    return ClothSolver::Positions(state, model.particle_count())[Particle(vertex)];
  }
  size_t Particle(int vertex) const {
    return static_cast<size_t>(model.particle_of_vertex()[static_cast<size_t>(vertex)]);
  }
  void Pin(int vertex) {
    state.positions[Particle(vertex)].w = 0.0F;
    state.previous[Particle(vertex)].w = 0.0F;
  }
  Eigen::Vector3d Centre() const {
    const std::vector<Eigen::Vector3d> places = ClothSolver::Positions(state, model.particle_count());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t particle = 0; particle < places.size(); ++particle) sum += model.masses()[particle] * places[particle];
    double mass = 0.0;
    for (const double m : model.masses()) mass += m;
    return sum / mass;
  }

  ClothMesh mesh;
  SignedDistanceField body;
  ClothModel model;
  SerialExecutor serial;
  ClothSolver solver;
  ClothState state;
};

MotionOptions FreeMotion(double time_step) {
  MotionOptions motion;
  motion.time_step = time_step;
  motion.drag = 0.0;
  return motion;
}

ClothMesh MakeTriangle() {
  ClothMesh mesh;
  mesh.rest_positions = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.01, 0.02, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(ClothSolver, FreeFallIsHalfGTSquared) {
  Scene scene(MakeTriangle(), {}, testing::MakeFarBody());
  scene.solver.SetMotion(FreeMotion(5e-4));
  scene.solver.Advance(scene.state, 600, {}, 0.0);
  const double expected = -0.5 * 9.81 * 0.3 * 0.3;
  EXPECT_NEAR(scene.Centre().y() - 0.02 / 3.0, expected, 0.01 * std::abs(expected));
  EXPECT_NEAR((scene.At(1) - scene.At(0)).norm(), 0.02, 1e-5);
}

TEST(ClothSolver, DragDecayDoesNotDependOnTheStep) {
  for (const double step : {2e-4, 1e-3}) {
    Scene scene(MakeTriangle(), {}, testing::MakeFarBody());
    MotionOptions motion = FreeMotion(step);
    motion.gravity.setZero();
    motion.drag = 7.0;
    scene.solver.SetMotion(motion);
    for (Float4& velocity : scene.state.velocities) velocity = {0.4F, 0.0F, 0.0F, 0.0F};
    scene.solver.Advance(scene.state, static_cast<int>(std::lround(0.2 / step)), {}, 0.0);
    EXPECT_NEAR(scene.state.velocities[0].x, 0.4 * std::exp(-7.0 * 0.2), 2e-3) << step;
  }
}

// An equilateral triangle of three springs k between three masses m breathes with omega^2 = 3 k / m. Here k = Y A / l^2
// and m = rho A / 3, so that the period is 2 pi l / 3 sqrt(rho / Y).
TEST(ClothSolver, ATriangleBreathesWithThePeriodOfItsSpringsAndMasses) {
  const double length = 0.02;
  ClothMesh mesh;
  mesh.rest_positions = {{0.0, 0.0, 0.0}, {length, 0.0, 0.0}, {0.5 * length, 0.5 * std::sqrt(3.0) * length, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  for (const double stiffness : {200.0, 1500.0}) {
    ClothMaterial material;
    material.stretch_stiffness = stiffness;
    Scene scene(mesh, material, testing::MakeFarBody());
    const double period = 2.0 * M_PI * length / 3.0 * std::sqrt(material.areal_density / stiffness);
    MotionOptions motion = FreeMotion(period / 400.0);
    motion.gravity.setZero();
    scene.solver.SetMotion(motion);
    for (Float4& position : scene.state.positions) {  // One per cent larger than at rest.
      position.x *= 1.01F;
      position.y *= 1.01F;
    }
    std::vector<double> passages;  // Through the rest length, in steps.
    double before = 0.01 * length;
    for (int step = 1; step <= 600 && passages.size() < 3; ++step) {
      scene.solver.Advance(scene.state, 1, {}, 0.0);
      const double excess = (scene.At(1) - scene.At(0)).norm() - length;
      if ((excess > 0.0) != (before > 0.0)) passages.push_back(step - excess / (excess - before));
      before = excess;
    }
    ASSERT_EQ(passages.size(), 3u);
    EXPECT_NEAR((passages[2] - passages[0]) / 400.0, 1.0, 0.02) << stiffness;
  }
}

TEST(ClothSolver, AHangingStripStretchesByWeightOverStiffness) {
  // A strip of width w and length l under its own weight: the top edge carries rho g l per width, so the mean strain is
  // rho g l / (2 Y). Short steps, so that the numerical give is a small part.
  ClothMaterial material;
  material.areal_density = 0.5;
  material.stretch_stiffness = 30.0;
  for (const int rows : {10, 20}) {
    const ClothMesh sheet = testing::MakeSheet(0.1, 0.2, rows / 2, rows);
    Scene scene(sheet, material, testing::MakeFarBody());
    for (int column = 0; column <= rows / 2; ++column) scene.Pin(rows * (rows / 2 + 1) + column);
    for (int column = 0; column <= rows / 2; ++column) {
      scene.state.velocities[scene.Particle(rows * (rows / 2 + 1) + column)] = {};
    }
    MotionOptions motion = FreeMotion(1e-4);
    motion.drag = 30.0;
    // Pinned particles have no mass to fall with: hold them by taking gravity as acceleration of the others only.
    scene.solver.SetMotion(motion);
    for (int done = 0; done < 6000; done += 1) {
      scene.solver.Advance(scene.state, 1, {}, 0.0);
      for (int column = 0; column <= rows / 2; ++column) {
        const size_t top = scene.Particle(rows * (rows / 2 + 1) + column);
        const Eigen::Vector3d rest =
            sheet.rest_positions[static_cast<size_t>(rows * (rows / 2 + 1) + column)] - scene.state.centre;
        scene.state.positions[top] = {static_cast<float>(rest.x()), static_cast<float>(rest.y()),
                                      static_cast<float>(rest.z()), 0.0F};
        scene.state.velocities[top] = {};
      }
    }
    const double strain = (scene.At(rows * (rows / 2 + 1) + rows / 4) - scene.At(rows / 4)).norm() / 0.2 - 1.0;
    const double expected = 0.5 * 9.81 * 0.2 / (2.0 * 30.0);
    EXPECT_NEAR(strain, expected, 0.25 * expected) << rows << " rows";
  }
}

TEST(ClothSolver, ImpactIsInelastic) {
  ClothMesh mesh = MakeTriangle();
  for (Eigen::Vector3d& position : mesh.rest_positions) {
    position = Eigen::Vector3d(position.x(), 0.03, position.y());  // Lying flat, 3 cm above a level plate.
  }
  Scene scene(mesh, {}, testing::MakeSlope(0.0));
  MotionOptions motion = FreeMotion(5e-4);
  motion.friction_coefficient = 0.0;
  scene.solver.SetMotion(motion);
  double highest_after_contact = 0.0;
  bool touched = false;
  for (int step = 0; step < 600; ++step) {
    scene.solver.Advance(scene.state, 1, {}, 0.0);
    touched = touched || scene.Centre().y() < motion.contact_offset + 2e-4;
    if (touched) highest_after_contact = std::max(highest_after_contact, scene.Centre().y());
  }
  EXPECT_TRUE(touched);
  EXPECT_NEAR(scene.Centre().y(), motion.contact_offset, 2e-4);
  EXPECT_LT(highest_after_contact, motion.contact_offset + 4e-4);
}

// Between two plates that are nearer to each other than twice the offset neither side can have its due: the cloth stays
// in the middle, at rest, instead of being pushed to and fro.
TEST(ClothSolver, WhereTheBodyLeavesNoRoomForTheOffsetTheClothStaysInTheMiddle) {
  constexpr double kHalfGap = 0.002;
  TriangleMesh plates = testing::MakeBox(
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.02, -0.02, kHalfGap), Eigen::Vector3d(0.08, 0.08, 0.01)), 8);
  const TriangleMesh behind = testing::MakeBox(
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.02, -0.02, -0.01), Eigen::Vector3d(0.08, 0.08, -kHalfGap)), 8);
  const int first = static_cast<int>(plates.vertices.size());
  plates.vertices.insert(plates.vertices.end(), behind.vertices.begin(), behind.vertices.end());
  for (const Eigen::Vector3i& triangle : behind.triangles) {
    plates.triangles.emplace_back(triangle + Eigen::Vector3i::Constant(first));
  }
  SerialExecutor serial;
  SignedDistanceFieldOptions fine;
  fine.pitch = 0.001;
  ClothMesh sheet = testing::MakeSheet(0.06, 0.06, 6, 6);
  for (Eigen::Vector3d& position : sheet.rest_positions) position.z() = 0.0006;
  Scene scene(sheet, {}, SignedDistanceField::Build(plates, fine, serial).value());
  MotionOptions motion = FreeMotion(4e-4);
  motion.gravity.setZero();
  motion.contact_offset = 0.003;
  scene.solver.SetMotion(motion);
  scene.solver.Advance(scene.state, 400, {}, 0.0);
  const std::vector<Float4> before = scene.state.positions;
  scene.solver.Advance(scene.state, 1, {}, 0.0);
  for (int vertex = 0; vertex < static_cast<int>(sheet.rest_positions.size()); ++vertex) {
    EXPECT_NEAR(scene.At(vertex).z(), 0.0, 0.5 * kHalfGap);
    const Float4& from = before[scene.Particle(vertex)];
    const Float4& to = scene.state.positions[scene.Particle(vertex)];
    EXPECT_LT(std::abs(to.z - from.z), 1e-5F);
  }
}

TEST(ClothSolver, NothingTunnelsAtAnySpeed) {
  ClothMesh mesh = MakeTriangle();
  for (Eigen::Vector3d& position : mesh.rest_positions) position = {position.x(), 0.05, position.y()};
  Scene scene(mesh, {}, testing::MakeSlope(0.0));
  scene.solver.SetMotion(FreeMotion(5e-4));
  for (Float4& velocity : scene.state.velocities) velocity = {0.0F, -80.0F, 0.0F, 0.0F};  // 4 cm a step, unchecked.
  scene.solver.Advance(scene.state, 400, {}, 0.0);
  EXPECT_GT(scene.Centre().y(), 0.0025);
}

// Coulomb: a block slides on a slope if and only if tan(angle) > mu, then with g (sin - mu cos), whatever the step.
TEST(ClothSolver, SlidesOnASlopeExactlyWhenCoulombSays) {
  const double friction = 0.4;
  for (const double step : {2.5e-4, 1e-3}) {
    for (const double tangent : {0.3, 0.37, 0.45, 0.6}) {
      const double angle = std::atan(tangent);
      ClothMesh mesh = MakeTriangle();
      const Eigen::Matrix3d tilt = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      for (Eigen::Vector3d& position : mesh.rest_positions) {
        position = tilt * Eigen::Vector3d(position.x() - 0.1, 0.0035, position.y() - 0.01);
      }
      Scene scene(mesh, {}, testing::MakeSlope(angle));
      MotionOptions motion = FreeMotion(step);
      motion.friction_coefficient = friction;
      scene.solver.SetMotion(motion);
      const Eigen::Vector3d start = scene.Centre();
      scene.solver.Advance(scene.state, static_cast<int>(std::lround(0.25 / step)), {}, 0.0);
      const double way = (scene.Centre() - start).norm();
      const double acceleration = 9.81 * (std::sin(angle) - friction * std::cos(angle));
      const double expected = std::max(0.0, 0.5 * acceleration * 0.25 * 0.25);
      EXPECT_NEAR(way, expected, 0.06 * expected + 3e-4) << "tan " << tangent << ", step " << step;
    }
  }
}

TEST(ClothSolver, SeamPullsAreEqualAndOppositeAndCapped) {
  const ClothMesh tube = testing::MakeTube(0.1, 0.1, 5, 5, 0.05);
  Scene scene(tube, {}, testing::MakeFarBody());
  MotionOptions motion = FreeMotion(5e-4);
  motion.gravity.setZero();
  scene.solver.SetMotion(motion);
  std::vector<SeamPull> pulls;
  for (const SeamPair& pair : tube.seams) {
    pulls.push_back({static_cast<int>(scene.Particle(pair.a)), static_cast<int>(scene.Particle(pair.b)), false});
  }
  const Eigen::Vector3d before = scene.Centre();
  const double gap_before = (scene.At(tube.seams[0].a) - scene.At(tube.seams[0].b)).norm();
  scene.solver.Advance(scene.state, 1, pulls, /*closing_speed=*/1.0);
  const double gap_after = (scene.At(tube.seams[0].a) - scene.At(tube.seams[0].b)).norm();
  EXPECT_NEAR(gap_before - gap_after, 1.0 * 5e-4, 1e-6);
  EXPECT_NEAR((scene.Centre() - before).norm(), 0.0, 1e-7);
}

// Attached particles go where they are told, at their own speed, and hold what hangs on them: the strip's upper edge is
// carried 10 cm up; the rest follows and the edge stays to the micrometre.
TEST(ClothSolver, AttachedParticlesWalkToTheirTargetsAndHoldTheCloth) {
  const ClothMesh strip = testing::MakeSheet(0.1, 0.2, 5, 10);
  Scene scene(strip, {}, testing::MakeFarBody());
  std::vector<Attachment> attachments;
  for (int column = 0; column <= 5; ++column) {
    const int vertex = 10 * 6 + column;
    attachments.push_back({static_cast<int>(scene.Particle(vertex)),
                           strip.rest_positions[static_cast<size_t>(vertex)] + Eigen::Vector3d(0.0, 0.1, 0.0)});
  }
  MotionOptions motion = FreeMotion(4e-4);
  motion.drag = 20.0;
  motion.attachment_speed = 0.5;
  scene.solver.SetMotion(motion);
  scene.solver.Attach(scene.state, attachments);
  scene.solver.Advance(scene.state, 250, {}, 0.0);  // 0.1 s at 0.5 m/s: half of the way.
  EXPECT_NEAR(scene.At(10 * 6).y(), 0.25, 1e-4);
  scene.solver.Advance(scene.state, 4750, {}, 0.0);
  for (int column = 0; column <= 5; ++column) EXPECT_NEAR(scene.At(10 * 6 + column).y(), 0.3, 1e-6);
  EXPECT_NEAR(scene.At(2).y(), 0.1, 0.002);  // Hangs below, stretched by no more than its weight.
}

// Equation (8): antigravity takes the weight away, so that a free cloth stays where it is.
TEST(ClothSolver, AFreeClothKeepsStillUnderAntigravity) {
  const ClothMesh sheet = testing::MakeSheet(0.1, 0.1, 5, 5);
  Scene scene(sheet, {}, testing::MakeFarBody());
  MotionOptions motion = FreeMotion(4e-4);
  motion.gravity += Eigen::Vector3d(0.0, 9.81, 0.0);
  scene.solver.SetMotion(motion);
  scene.solver.Advance(scene.state, 1000, {}, 0.0);
  for (int vertex = 0; vertex < 36; ++vertex) {
    EXPECT_LT((scene.At(vertex) - sheet.rest_positions[static_cast<size_t>(vertex)]).norm(), 1e-6);
  }
}

TEST(ClothSolver, EveryThreadCountGivesTheSameBits) {
  const ClothMesh tube = testing::MakeTube(0.5, 0.5, 50, 50, 0.02);
  const ClothModel model = ClothModel::Create(tube, {}, tube.seams).value();
  EXPECT_GT(model.chunks().size(), 2u);
  SerialExecutor serial;
  const SignedDistanceField body =
      SignedDistanceField::Build(testing::MakeSphere({0.05, 0.2, 0.0}, 0.1, 4), {}, serial).value();
  std::vector<Float4> reference;
  for (const int thread_count : {1, 2, 3}) {
    ThreadPool pool(thread_count);
    ClothSolver solver(model, body, pool);
    std::vector<Eigen::Vector3d> start(static_cast<size_t>(model.particle_count()));
    for (size_t vertex = 0; vertex < tube.rest_positions.size(); ++vertex) {
      start[static_cast<size_t>(model.particle_of_vertex()[vertex])] = tube.rest_positions[vertex];
    }
    ClothState state = solver.MakeState(start);
    solver.Advance(state, 100, {}, 0.0);
    solver.RaiseOffsets(state, 0.001);
    solver.Advance(state, 50, {}, 0.0);
    if (reference.empty()) {
      reference = state.positions;
    } else {
      ASSERT_EQ(std::memcmp(reference.data(), state.positions.data(), reference.size() * sizeof(Float4)), 0)
          << thread_count << " threads";
    }
  }
}

}  // namespace
}  // namespace fitroom
