#include "fit_client/fit/collision/side_votes.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

constexpr int kNodes = 9;
constexpr int kCells = kNodes - 1;
constexpr int kBricks = 3;  // Along each axis.
constexpr float kPitch = 0.004F;
constexpr float kRadius = 0.03F;

// The distance of a sphere in the middle of 3 x 3 x 3 bricks.
struct SampledSphere {
  std::vector<float> distances;
  std::vector<Eigen::Vector3i> bricks;

  SampledSphere() {
    const Eigen::Vector3f centre = Eigen::Vector3f::Constant(0.5F * kBricks * kCells * kPitch);
    for (int i = 0; i < kBricks * kBricks * kBricks; ++i) {
      bricks.emplace_back(i % kBricks, i / kBricks % kBricks, i / kBricks / kBricks);
      for (int z = 0; z < kNodes; ++z) {
        for (int y = 0; y < kNodes; ++y) {
          for (int x = 0; x < kNodes; ++x) {
            const Eigen::Vector3f node = (bricks.back() * kCells + Eigen::Vector3i(x, y, z)).cast<float>() * kPitch;
            distances.push_back((node - centre).norm() - kRadius);
          }
        }
      }
    }
  }

  void Settle() {
    const auto slot_at = [](const Eigen::Vector3i& brick) {
      const bool is_stored = (brick.array() >= 0).all() && (brick.array() < kBricks).all();
      return is_stored ? brick.x() + kBricks * (brick.y() + kBricks * brick.z()) : -1;
    };
    SerialExecutor executor;
    SettleSides({distances, bricks, slot_at, kNodes, kPitch}, executor);
  }
};

TEST(SettleSides, LeavesARightFieldAsItIs) {
  SampledSphere sphere;
  const std::vector<float> before = sphere.distances;
  sphere.Settle();
  EXPECT_EQ(sphere.distances, before);
}

TEST(SettleSides, TurnsBackAPocketOfWrongSigns) {
  SampledSphere sphere;
  const std::vector<float> before = sphere.distances;
  std::mt19937 random(7);
  for (float& distance : sphere.distances) {
    if (std::abs(distance) > kPitch && random() % 5 == 0) distance = -distance;
  }
  ASSERT_NE(sphere.distances, before);
  sphere.Settle();
  EXPECT_EQ(sphere.distances, before);
}

TEST(SettleSides, KeepsEveryDistance) {
  SampledSphere sphere;
  const std::vector<float> before = sphere.distances;
  for (size_t i = 0; i < sphere.distances.size(); i += 3) sphere.distances[i] = -sphere.distances[i];
  sphere.Settle();
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(std::abs(sphere.distances[i]), std::abs(before[i]));
}

}  // namespace
}  // namespace fitroom
