#include "fit_client/fit/solver/cloth_model.h"

#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/solver/cloth_kernels.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

TEST(ClothModel, MassIsArealDensityTimesArea) {
  const ClothMesh sheet = testing::MakeSheet(0.4, 0.3, 20, 15);
  ClothMaterial material;
  material.areal_density = 0.2;
  const Result<ClothModel> model = ClothModel::Create(sheet, material, {});
  ASSERT_TRUE(model.ok());
  EXPECT_NEAR(std::accumulate(model->masses().begin(), model->masses().end(), 0.0), 0.2 * 0.4 * 0.3, 1e-12);
  // An inner particle of the grid owns one square of 2 cm.
  const size_t inner = static_cast<size_t>(model->particle_of_vertex()[21 * 7 + 10]);
  EXPECT_NEAR(model->masses()[inner], 0.2 * 0.02 * 0.02, 1e-12);
}

TEST(ClothModel, EveryEdgeIsOneSpringAndNoBatchSharesAParticle) {
  const ClothMesh sheet = testing::MakeSheet(0.6, 0.6, 60, 60);
  const Result<ClothModel> model = ClothModel::Create(sheet, {}, {});
  ASSERT_TRUE(model.ok());
  EXPECT_GT(model->chunks().size(), 1u);
  std::set<std::pair<int, int>> springs;
  const auto collect = [&](const ClothChunk& chunk) {
    for (const StretchBatch& batch : chunk.stretch) {
      std::set<int> ends;
      for (size_t lane = 0; lane < 4; ++lane) {
        if (batch.a[lane] >= model->particle_count()) continue;
        EXPECT_TRUE(springs.emplace(batch.a[lane], batch.b[lane]).second);
        EXPECT_TRUE(ends.insert(batch.a[lane]).second);
        EXPECT_TRUE(ends.insert(batch.b[lane]).second);
      }
    }
  };
  for (const ClothChunk& chunk : model->chunks()) {
    collect(chunk);
    for (const StretchBatch& batch : chunk.stretch) {
      for (size_t lane = 0; lane < 4; ++lane) {
        for (const int end : {batch.a[lane], batch.b[lane]}) {
          if (end >= model->particle_count()) continue;
          EXPECT_GE(end, chunk.first_particle);
          EXPECT_LT(end, chunk.first_particle + chunk.particle_count);
        }
      }
    }
  }
  collect(model->border());
  EXPECT_EQ(springs.size(), 3u * 60 * 60 + 2 * 60);  // V + F - 1 edges of a disc.
  EXPECT_EQ(model->edges().size(), springs.size());
}

// Neighbours of one colour are solved at once: what one writes the other must not read.
TEST(ClothModel, ConstraintsOfOneColourShareNoParticle) {
  const ClothMesh sheet = testing::MakeSheet(0.6, 0.6, 60, 60);
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  const auto check = [&](const ClothChunk& chunk) {
    ASSERT_EQ(static_cast<size_t>(chunk.stretch_colour_ends.back()), chunk.stretch.size());
    ASSERT_EQ(static_cast<size_t>(chunk.bend_colour_ends.back()), chunk.bend.size());
    size_t index = 0;
    for (const int end : chunk.stretch_colour_ends) {
      std::set<int> met;
      for (; index < static_cast<size_t>(end); ++index) {
        for (size_t lane = 0; lane < 4; ++lane) {
          if (chunk.stretch[index].a[lane] >= model.particle_count()) continue;
          EXPECT_TRUE(met.insert(chunk.stretch[index].a[lane]).second);
          EXPECT_TRUE(met.insert(chunk.stretch[index].b[lane]).second);
        }
      }
    }
    index = 0;
    for (const int end : chunk.bend_colour_ends) {
      std::set<int> met;
      for (; index < static_cast<size_t>(end); ++index) {
        for (const int particle : chunk.bend[index].particles) EXPECT_TRUE(met.insert(particle).second);
      }
    }
  };
  for (const ClothChunk& chunk : model.chunks()) check(chunk);
  check(model.border());
}

TEST(ClothKernels, BothWidthsGiveTheSameBits) {
  if (WidestKernel() != KernelWidth::kEight) GTEST_SKIP() << "this processor has registers of 128 bits only";
  const ClothMesh sheet = testing::MakeSheet(0.6, 0.5, 61, 50);
  const ClothModel model = ClothModel::Create(sheet, {}, {}).value();
  std::mt19937 random(17);
  std::uniform_real_distribution<float> place(-0.3F, 0.3F);
  std::vector<Float4> start(static_cast<size_t>(model.particle_count() + model.idle_particle_count()));
  for (size_t particle = 0; particle < static_cast<size_t>(model.particle_count()); ++particle) {
    start[particle] = {place(random), place(random), place(random),
                       particle % 7 == 0 ? 0.0F : static_cast<float>(1.0 / model.masses()[particle])};
  }
  const auto solve = [&](const ClothChunk& chunk, KernelWidth width) {
    ChunkDenominators denominators;
    for (size_t i = 0; i < chunk.stretch.size(); ++i) denominators.stretch.push_back({1e-5F, 2e-5F, 3e-5F, 1.5e-5F});
    for (size_t i = 0; i < chunk.bend.size(); ++i) denominators.bend.push_back({0.02F, 0.01F, -0.03F, 0.02F});
    std::vector<Float4> positions = start;
    SolveChunk(width, positions, chunk, denominators, /*compression_factor=*/0.4F);
    return positions;
  };
  const auto check = [&](const ClothChunk& chunk) {
    const std::vector<Float4> four = solve(chunk, KernelWidth::kFour);
    const std::vector<Float4> eight = solve(chunk, KernelWidth::kEight);
    EXPECT_EQ(std::memcmp(four.data(), eight.data(), four.size() * sizeof(Float4)), 0);
    EXPECT_NE(std::memcmp(four.data(), start.data(), four.size() * sizeof(Float4)), 0);
  };
  for (const ClothChunk& chunk : model.chunks()) check(chunk);
  check(model.border());
}

TEST(ClothModel, WeldedPairsAreOneParticleWithBothMasses) {
  const ClothMesh tube = testing::MakeTube(0.3, 0.2, 15, 10, 0.1);
  const Result<ClothModel> apart = ClothModel::Create(tube, {}, {});
  const Result<ClothModel> welded = ClothModel::Create(tube, {}, tube.seams);
  ASSERT_TRUE(apart.ok() && welded.ok());
  EXPECT_EQ(apart->particle_count(), 2 * 16 * 11);
  EXPECT_EQ(welded->particle_count(), 2 * 16 * 11 - 2 * 11);
  const SeamPair& pair = tube.seams[6];
  const auto mass = [](const ClothModel& model, int vertex) {
    return model.masses()[static_cast<size_t>(model.particle_of_vertex()[static_cast<size_t>(vertex)])];
  };
  EXPECT_EQ(welded->particle_of_vertex()[static_cast<size_t>(pair.a)],
            welded->particle_of_vertex()[static_cast<size_t>(pair.b)]);
  EXPECT_NEAR(mass(*welded, pair.a), mass(*apart, pair.a) + mass(*apart, pair.b), 1e-15);
}

TEST(ClothModel, RefusesWhatIsNotCloth) {
  EXPECT_EQ(ClothModel::Create({}, {}, {}).status().reason(), "CLOTH_EMPTY");
  ClothMesh sheet = testing::MakeSheet(0.1, 0.1, 3, 3);
  sheet.rest_positions[4].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ClothModel::Create(sheet, {}, {}).status().reason(), "CLOTH_NOT_FINITE");
  sheet = testing::MakeSheet(0.1, 0.1, 3, 3);
  sheet.triangles[2][0] = 16;
  EXPECT_EQ(ClothModel::Create(sheet, {}, {}).status().reason(), "CLOTH_INDEX_OUT_OF_RANGE");
  sheet = testing::MakeSheet(0.1, 0.1, 3, 3);
  sheet.rest_positions.emplace_back(1.0, 1.0, 1.0);
  EXPECT_EQ(ClothModel::Create(sheet, {}, {}).status().reason(), "CLOTH_PARTICLE_WITHOUT_AREA");
}

}  // namespace
}  // namespace fitroom
