#include "fit_client/fit/stages/sleeve_tube.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"

namespace fitroom {
namespace {

using Eigen::Vector3d;

constexpr double kArmRadius = 0.04;
constexpr double kUpperArm = 0.28;
constexpr double kForearm = 0.25;

// A left arm of even thickness that hangs beside the body and is bent forwards at the elbow by 50 degrees.
struct BentArm {
  BentArm() {
    const Vector3d forearm = Eigen::AngleAxisd(-50.0 * M_PI / 180.0, Vector3d::UnitX()) * -Vector3d::UnitY();
    axis.root = {0.2, 1.4, 0.0};
    axis.joint = axis.root - kUpperArm * Vector3d::UnitY();
    axis.end = axis.joint + kForearm * forearm;
    const Vector3d forwards = Vector3d::UnitX().cross(forearm);
    mesh = testing::MakeCylinder(kArmRadius, -0.70, 0.05, 48, 150);
    for (Vector3d& vertex : mesh.vertices) {
      const double way = -vertex.y();
      vertex = way <= kUpperArm ? Vector3d(axis.root + vertex)
                                : Vector3d(axis.joint + (way - kUpperArm) * forearm + vertex.x() * Vector3d::UnitX() +
                                           vertex.z() * (forwards.z() < 0.0 ? Vector3d(-forwards) : forwards));
    }
  }
  double DistanceFromAxis(const Vector3d& place) const {
    double least = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way < 0.40; way += 0.001) {
      const Vector3d on_forearm = axis.joint + way * (axis.end - axis.joint).normalized();
      const Vector3d on_upper_arm = axis.joint + std::min(way, kUpperArm) * Vector3d::UnitY();
      least = std::min({least, (place - on_forearm).norm(), (place - on_upper_arm).norm()});
    }
    return least;
  }
  LimbAxis axis;
  TriangleMesh mesh;
};

// A flat sleeve, front and back: rows of particles from the underarm downwards, from the top seam to the underside.
struct FlatSleeve {
  static constexpr int kAcross = 8;
  explicit FlatSleeve(double length) : rows(static_cast<int>(std::lround(length / 0.01)) + 1) {
    for (const int panel : {0, 1}) {
      for (int row = 0; row < rows; ++row) {
        for (int k = 0; k <= kAcross; ++k) {
          const int particle = static_cast<int>(cloth.rest_positions.size());
          cloth.rest_positions.emplace_back(0.3 - 0.015 * k, -0.01 * row, 0.0);
          cloth.panel_of_particle.push_back(panel);
          if (k == 0) seams.top[static_cast<size_t>(panel)].push_back(particle);
          if (k == kAcross) seams.under[static_cast<size_t>(panel)].push_back(particle);
        }
      }
    }
    cloth.left_sleeve_weights.assign(cloth.rest_positions.size(), 1.0);
    cloth.right_sleeve_weights.assign(cloth.rest_positions.size(), 0.0);
    // As seen from the front, the sleeve hangs straight down beside the arm's axis.
    for (const Vector3d& rest : cloth.rest_positions) places.emplace_back(0.2 + rest.x() - 0.24, 1.35 + rest.y(), 0.0);
  }
  int rows = 0;
  ClothMesh cloth;
  SleeveSeams seams;
  std::vector<Vector3d> places;
};

TEST(SleeveTube, FollowsTheForearmThatIsBentForwardsAndLiesOutsideOfIt) {
  const BentArm arm;
  FlatSleeve sleeve(0.46);
  LaySleeveRoundArm(sleeve.cloth, sleeve.seams, +1, arm.axis, arm.mesh, 0.006, sleeve.places);
  for (const size_t panel : {0, 1}) {
    for (int row = 20; row < sleeve.rows; ++row) {
      Vector3d middle = Vector3d::Zero();
      for (int k = 0; k <= FlatSleeve::kAcross; ++k) {
        const size_t particle = panel * sleeve.places.size() / 2 + static_cast<size_t>(row * 9 + k);
        // A sleeve of 24 cm round a cylinder of 25.1 cm starts the clearance away from it; inside the elbow, where
        // sections overlap, outside of it at least.
        const double way = (sleeve.places[particle] - arm.axis.joint).norm();
        EXPECT_GT(arm.DistanceFromAxis(sleeve.places[particle]), kArmRadius + (way < 0.08 ? 0.001 : 0.004))
            << row << " " << k;
        middle += sleeve.places[particle] / 9.0;
      }
      const Vector3d along = (arm.axis.end - arm.axis.joint).normalized();
      if ((middle - arm.axis.joint).dot(along) < 0.06) continue;
      // The front lies before the forearm, the back behind it.
      const double before = (middle - arm.axis.joint).dot(Vector3d::UnitX().cross(along));
      EXPECT_GT(panel == 0 ? -before : before, 0.01) << row;
    }
  }
}

TEST(SleeveTube, SeamPartnersMeet) {
  const BentArm arm;
  FlatSleeve sleeve(0.46);
  LaySleeveRoundArm(sleeve.cloth, sleeve.seams, +1, arm.axis, arm.mesh, 0.006, sleeve.places);
  for (const auto* seam : {&sleeve.seams.top, &sleeve.seams.under}) {
    for (size_t k = 18; k < (*seam)[0].size(); ++k) {
      const Vector3d& front = sleeve.places[static_cast<size_t>((*seam)[0][k])];
      const Vector3d& back = sleeve.places[static_cast<size_t>((*seam)[1][k])];
      EXPECT_LT((front - back).norm(), 1e-9) << k;
    }
  }
}

TEST(SleeveTube, ASleeveThatIsTooLongStartsPushedUpToTheWrist) {
  const BentArm arm;
  FlatSleeve sleeve(0.62);
  LaySleeveRoundArm(sleeve.cloth, sleeve.seams, +1, arm.axis, arm.mesh, 0.006, sleeve.places);
  const Vector3d along = (arm.axis.end - arm.axis.joint).normalized();
  for (const size_t panel : {0, 1}) {
    for (const std::vector<int>* seam : {&sleeve.seams.top[panel], &sleeve.seams.under[panel]}) {
      const double way = (sleeve.places[static_cast<size_t>(seam->back())] - arm.axis.joint).dot(along);
      EXPECT_NEAR(way, kForearm, 0.03);
    }
  }
}

TEST(SleeveTube, ShortSleevesAndSleevesOfUnknownParticlesStayAsTheyAre) {
  const BentArm arm;
  FlatSleeve shorter(0.15);
  const std::vector<Vector3d> before = shorter.places;
  LaySleeveRoundArm(shorter.cloth, shorter.seams, +1, arm.axis, arm.mesh, 0.006, shorter.places);
  EXPECT_EQ(shorter.places, before);
  FlatSleeve unknown(0.46);
  unknown.cloth.left_sleeve_weights.clear();
  const std::vector<Vector3d> as_placed = unknown.places;
  LaySleeveRoundArm(unknown.cloth, unknown.seams, +1, arm.axis, arm.mesh, 0.006, unknown.places);
  EXPECT_EQ(unknown.places, as_placed);
}

}  // namespace
}  // namespace fitroom
