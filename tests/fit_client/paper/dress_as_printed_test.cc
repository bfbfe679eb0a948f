#include "fit_client/fit/paper/dress_as_printed.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/fit_client/paper/common_case.h"

namespace fitroom::paper {
namespace {

constexpr int kColumns = 8;
constexpr int kRows = 5;

// A ring of two panels with the named points of a skirt, below a body that widens upwards.
ClothMesh NamedSkirt() {
  ClothMesh mesh = testing::MakeConeSkirt(0.0917, 0.0917, 0.8, -1.0, 1.0, -0.35, -0.2, 1.0, 0.12, kColumns, kRows);
  const int back = static_cast<int>(mesh.rest_positions.size()) / 2;
  const int top = kRows * (kColumns + 1);
  for (const auto& [panel, first] : {std::pair<std::string, int>{"front/", 0}, {"back/", back}}) {
    mesh.named_particles.push_back({panel + "e1", first + top + kColumns});  // The wearer's left is +x.
    mesh.named_particles.push_back({panel + "e2", first + kColumns});
    mesh.named_particles.push_back({panel + "e3", first + top});
    mesh.named_particles.push_back({panel + "e4", first});
    mesh.named_particles.push_back({panel + "waist_centre", first + top + kColumns / 2});
  }
  return mesh;
}

Body BodyWithWaist() {
  Body body;
  body.landmarks[BodyLandmark::kWaistFront] = {Eigen::Vector3d(0.0, 5.0, 0.0), 1.0};
  return body;
}

TEST(FindPaperBottom, S30_WalksTheTopEdgeFromTheCentreFrontOverTheLeft) {
  const ClothMesh skirt = NamedSkirt();
  const Result<PaperBottom> bottom = FindPaperBottom(skirt, BodyWithWaist());
  ASSERT_TRUE(bottom.ok()) << bottom.status().ToString();
  ASSERT_EQ(bottom->top_edge.size(), 2u * (kColumns + 1));  // Both panels, seam partners twice.
  const auto place = [&](size_t i) { return skirt.rest_positions[static_cast<size_t>(bottom->top_edge[i])]; };
  EXPECT_NEAR(place(0).x(), 0.0, 1e-12);
  EXPECT_GT(place(1).x(), 0.0);
  EXPECT_GT(place(0).z(), 0.0);
  for (size_t i = 0; i < bottom->top_edge.size(); ++i) EXPECT_NEAR(place(i).y(), -0.2, 1e-12);
  std::vector<int> sorted = bottom->top_edge;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
  for (const std::vector<int>& seam : bottom->outseams) EXPECT_EQ(seam.size(), 1u + kRows);
  EXPECT_EQ(FindPaperBottom(skirt, Body()).status().reason(), "LANDMARK_MISSING");
}

TEST(DressAsPrinted, S31_KeepsThePicturesOfTheStages) {
  const ClothMesh skirt = NamedSkirt();
  const TriangleMesh body = testing::MakeEllipticCone(0.12, 0.04, 0.8, -0.4, 0.3, 72, 60);
  PaperOptions options = RunnablePaperOptions();
  options.material.stretch_stiffness = 200.0;
  options.motion.stitching.law = StitchingLaw::kSeamsOnly;
  options.collision.registration = Registration::kOverlap;
  options.collision.swept = true;
  options.draping_step_limit = 300;
  SerialExecutor serial;
  PaperStage last = PaperStage::kStart;
  const Result<DressedAsPrinted> dressed =
      DressAsPrinted(skirt, BodyWithWaist(), body, skirt.rest_positions, options, serial, [&](PaperStage stage, int) {
        EXPECT_GE(stage, last);
        last = stage;
      });
  ASSERT_TRUE(dressed.ok()) << dressed.status().ToString();
  EXPECT_EQ(last, PaperStage::kFinished);
  EXPECT_EQ(dressed->start, skirt.rest_positions);
  const SeamPair seam = skirt.seams.front();
  const auto gap = [&](const std::vector<Eigen::Vector3d>& places) {
    return (places[static_cast<size_t>(seam.a)] - places[static_cast<size_t>(seam.b)]).norm();
  };
  EXPECT_GT(gap(dressed->merging), 0.0);
  EXPECT_LT(gap(dressed->merging), gap(dressed->start));
  EXPECT_EQ(gap(dressed->stitched), 0.0);
  EXPECT_GT(dressed->pulled_up[0].y(), dressed->stitched[0].y() + 0.1);
  EXPECT_EQ(dressed->final.size(), skirt.rest_positions.size());
}

TEST(ShoulderVertices, S27_AreThoseInsideTheAcromions) {
  Body body;
  body.landmarks[BodyLandmark::kAcromionLeft].position = {0.18, 1.4, 0.0};
  body.landmarks[BodyLandmark::kAcromionRight].position = {-0.18, 1.4, 0.0};
  ClothMesh mesh;
  mesh.named_particles = {{"front/e1", 0}, {"front/e4", 1}, {"back/e5", 2}, {"front/hem_L", 3}};
  const std::vector<Eigen::Vector3d> places = {{0.1, 1.4, 0.0}, {0.4, 1.2, 0.0}, {-0.17, 1.4, 0.0}, {0.1, 0.8, 0.0}};
  EXPECT_EQ(ShoulderVertices(mesh, body, places), (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace fitroom::paper
