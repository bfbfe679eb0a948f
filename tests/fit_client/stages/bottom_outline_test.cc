#include "fit_client/fit/stages/bottom_outline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/fork/fork_mesh.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "tests/fit_client/panels/drawn_kinds.h"
#include "tests/fit_client/stages/tube_skirt.h"

namespace fitroom {
namespace {

double Place(const BottomOutline& outline, int particle) {
  for (const WaistParticle& edge : outline.waist) {
    if (edge.particle == particle) return edge.place;
  }
  return 1e9;
}

TEST(BottomOutline, ATubeSkirtHasTwoOutseamsAndAWaistMeasuredFromTheCentreFront) {
  const ClothMesh skirt = testing::MakeTubeSkirt(0.36, 0.5, 0.6, 18, 30);
  const Result<BottomOutline> outline = FindBottomOutline(skirt);
  ASSERT_TRUE(outline.ok()) << outline.status().ToString();
  EXPECT_FALSE(outline->has_legs());
  EXPECT_NEAR(outline->waist_girth, 0.72, 1e-12);
  EXPECT_EQ(outline->outseams[0][0].particles.size(), 31U);
  EXPECT_GT(skirt.rest_positions[static_cast<size_t>(outline->outseams[0][0].particles.front())].x(), 0.0);
  EXPECT_LT(skirt.rest_positions[static_cast<size_t>(outline->outseams[1][1].particles.front())].x(), 0.0);
  EXPECT_NEAR(Place(*outline, 9), 0.0, 1e-12);             // Middle of the front's upper row.
  EXPECT_NEAR(Place(*outline, 18), 0.18, 1e-12);           // e1: a quarter of the way round, over the left.
  EXPECT_NEAR(Place(*outline, 31 * 19 + 9), 0.36, 1e-12);  // Centre back.
}

TEST(BottomOutline, RefusesPanelsWithoutABottomsCorners) {
  ClothMesh skirt = testing::MakeTubeSkirt(0.36, 0.5, 0.6, 18, 30);
  skirt.named_particles.pop_back();
  EXPECT_EQ(FindBottomOutline(skirt).status().reason(), "BOTTOM_OUTLINE");
  skirt = testing::MakeTubeSkirt(0.36, 0.5, 0.6, 18, 30);
  skirt.seams.clear();
  EXPECT_EQ(FindBottomOutline(skirt).status().reason(), "BOTTOM_OUTLINE");
}

// Trousers of two pieces and of four have the same seams; all pieces meet at the crotch.
TEST(BottomOutline, TrousersAreFoundWhetherCutOfTwoPiecesOrOfFour) {
  const Result<GarmentPattern> pattern = ReconcileViews(testing::DrawKind(GarmentKind::kPants));
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  ForkEvidence evidence;
  evidence.rule = ForkRule::kAldrich;
  const Result<ForkedPattern> forked = BuildFork(*pattern, evidence);
  ASSERT_TRUE(forked.ok()) << forked.status().ToString();
  const ClothMesh two = MeshPattern(*pattern, 0.02).value();
  const ClothMesh four = MeshFork(*forked, 0.02).value();
  for (const auto& [cloth, pieces] : {std::pair(&two, 2), std::pair(&four, 4)}) {
    const Result<BottomOutline> outline = FindBottomOutline(*cloth);
    ASSERT_TRUE(outline.ok()) << outline.status().ToString();
    EXPECT_EQ(outline->crotch.size(), static_cast<size_t>(pieces));
    for (const size_t side : {0, 1}) {
      EXPECT_EQ(outline->inseams[side].size(), 2U);
      for (const auto& chain : outline->inseams[side]) EXPECT_EQ(chain.side, static_cast<int>(side));
    }
    EXPECT_EQ(outline->centre_seams[0].size() + outline->centre_seams[1].size(), pieces == 4 ? 4U : 0U);
    EXPECT_NEAR(outline->waist_girth, 4.0 * 0.19, 0.02);
  }
}

}  // namespace
}  // namespace fitroom
