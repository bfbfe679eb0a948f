#include "fit_client/fit/fork/fork.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/fork/fork_mesh.h"
#include "fit_client/fit/grading/grade.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/fork/drafted_trousers.h"
#include "tests/fit_client/panels/drawn_kinds.h"

// Row S46 of the method: trousers drafted by three rules, folded, photographed and rebuilt. What is rebuilt is measured
// here on the pieces' outlines, by lines across them and along their seams.

namespace fitroom {
namespace {

using testing::Draft;
using testing::DraftedBody;
using testing::DraftedTrousers;
using testing::DraftRule;

GarmentPattern Reconciled(const Garment& garment) {
  Result<GarmentPattern> pattern = ReconcileViews(garment);
  if (!pattern.ok()) throw std::runtime_error(pattern.status().ToString());
  return std::move(pattern).value();
}

ForkedPattern Built(const GarmentPattern& pattern, const ForkEvidence& evidence) {
  Result<ForkedPattern> forked = BuildFork(pattern, evidence);
  if (!forked.ok()) throw std::runtime_error(forked.status().ToString());
  return std::move(forked).value();
}

// Width of a piece at a height, from its outermost crossings.
double WidthAt(const PanelPattern& piece, double height) {
  const std::vector<Eigen::Vector2d> outline = JoinedPoints(piece);
  double low = 1e9, high = -1e9;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > height) == (b.y() > height)) continue;
    const double x = a.x() + (height - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high - low;
}

double SeamLength(const PanelPattern& piece, const std::string& name) {
  const OutlineSection* section = FindSection(piece, name);
  double length = 0.0;
  for (size_t i = 1; i < section->points.size(); ++i) length += (section->points[i] - section->points[i - 1]).norm();
  return length;
}

struct Rebuilt {
  double hip_girth = 0.0, thigh_girth = 0.0, front_rise = 0.0, back_rise = 0.0;
  double crotch_length() const { return front_rise + back_rise; }
};

Rebuilt MeasureAgain(const ForkedPattern& forked, double hip_depth) {
  Rebuilt rebuilt;
  for (const PanelPattern& piece : forked.pieces) rebuilt.hip_girth += WidthAt(piece, -hip_depth);
  for (const size_t p : {0u, 2u}) {
    const PanelPattern& piece = forked.pieces[p];
    // At the fork, a hair below its tip, where the curve ends.
    const Eigen::Vector2d tip = FindSection(piece, "centre_L")->points.back();
    rebuilt.thigh_girth += WidthAt(piece, tip.y() - 1e-5);
  }
  rebuilt.front_rise = SeamLength(forked.pieces[0], "centre_L");
  rebuilt.back_rise = SeamLength(forked.pieces[2], "centre_L");
  return rebuilt;
}

struct Case {
  DraftRule drafted;
  ForkRule ruled;
  const char* name;
};
constexpr Case kCases[] = {{DraftRule::kAldrich, ForkRule::kAldrich, "Aldrich"},
                           {DraftRule::kTitan, ForkRule::kTitan, "Titan"},
                           {DraftRule::kGarmentCode, ForkRule::kGarmentCode, "GarmentCode"}};

std::vector<DraftedBody> Bodies() {
  DraftedBody slim, middle, full;
  slim = {.hip = 0.88,
          .waist = 0.64,
          .rise = 0.27,
          .waist_to_hip = 0.20,
          .inseam = 0.74,
          .leg = 0.53,
          .crotch_length = 0.62};
  full = {.hip = 1.12,
          .waist = 0.90,
          .rise = 0.30,
          .waist_to_hip = 0.215,
          .inseam = 0.70,
          .leg = 0.66,
          .crotch_length = 0.74};
  return {slim, middle, full};
}

enum class Evidence { kStated, kSideFolded, kRule };

ForkEvidence Gather(Evidence kind, const Case& rule, const DraftedTrousers& truth, const Garment& garment) {
  ForkEvidence evidence;
  if (kind == Evidence::kStated) {
    evidence.front_rise = truth.front_rise;
    evidence.back_rise = truth.back_rise;
    evidence.thigh_width = 0.5 * truth.thigh_girth;
  } else if (kind == Evidence::kSideFolded) {
    evidence.side_folded = garment.side_folded;
  } else {
    evidence.rule = rule.ruled;
  }
  return evidence;
}

// The table: three rules, three bodies, three kinds of evidence, photographs at two scales with a jitter of a pixel.
TEST(Fork, S46IsRebuiltFromStatedRisesFromTheSideAndByRule) {
  std::printf("%-12s %4s %-8s %5s  error of hip, thigh, crotch length (mm)\n", "draft", "hip", "evidence", "px/m");
  for (const Case& rule : kCases) {
    for (const DraftedBody& body : Bodies()) {
      const DraftedTrousers truth = Draft(rule.drafted, body);
      for (const double scale : {600.0, 1200.0}) {
        const Garment garment = testing::Photograph(truth, scale, 1.0, 7);
        const GarmentPattern pattern = Reconciled(garment);
        for (const Evidence kind : {Evidence::kStated, Evidence::kSideFolded, Evidence::kRule}) {
          const ForkedPattern forked = Built(pattern, Gather(kind, rule, truth, garment));
          const Rebuilt rebuilt = MeasureAgain(forked, body.waist_to_hip);
          const double hip = 1000.0 * (rebuilt.hip_girth - truth.hip_girth);
          const double thigh = 1000.0 * (rebuilt.thigh_girth - truth.thigh_girth);
          const double crotch = 1000.0 * (rebuilt.crotch_length() - truth.front_rise - truth.back_rise);
          const char* name = kind == Evidence::kStated ? "stated" : kind == Evidence::kSideFolded ? "side" : "rule";
          std::printf("%-12s %4.0f %-8s %5.0f  %6.1f %6.1f %6.1f\n", rule.name, 1000 * body.hip, name, scale, hip,
                      thigh, crotch);
          const double allowed = kind == Evidence::kRule ? 25.0 : 10.0;
          EXPECT_LE(std::abs(hip), 5.0) << rule.name << " " << name;
          EXPECT_LE(std::abs(thigh), allowed) << rule.name << " " << name;
          EXPECT_LE(std::abs(crotch), allowed) << rule.name << " " << name;
          if (kind != Evidence::kStated) continue;
          EXPECT_NEAR(rebuilt.front_rise, truth.front_rise, 0.001);
          EXPECT_NEAR(rebuilt.back_rise, truth.back_rise, 0.001);
        }
      }
    }
  }
}

class DraftedFork : public ::testing::Test {
 protected:
  const DraftedTrousers truth_ = Draft(DraftRule::kAldrich, DraftedBody());
  const Garment garment_ = testing::Photograph(truth_, 1000.0, 0.5, 3);
  const GarmentPattern pattern_ = Reconciled(garment_);
  const ForkEvidence stated_ = Gather(Evidence::kStated, kCases[0], truth_, garment_);
  const ForkEvidence ruled_ = Gather(Evidence::kRule, kCases[0], truth_, garment_);
};

TEST_F(DraftedFork, SeamsMatchOneToOne) {
  for (const ForkEvidence& evidence : {stated_, ruled_}) {
    const ForkedPattern forked = Built(pattern_, evidence);
    ASSERT_EQ(forked.pieces.size(), 4u);
    const auto length = [&](size_t piece, const std::string& name) { return SeamLength(forked.pieces[piece], name); };
    EXPECT_NEAR(length(0, "inseam_L"), length(2, "inseam_L"), 1e-6);
    EXPECT_NEAR(length(1, "inseam_R"), length(3, "inseam_R"), 1e-6);
    EXPECT_NEAR(length(0, "centre_L"), length(1, "centre_R"), 1e-9);
    EXPECT_NEAR(length(2, "centre_L"), length(3, "centre_R"), 1e-9);
    EXPECT_EQ(FindSection(forked.pieces[0], "outseam_L")->points, FindSection(forked.pieces[2], "outseam_L")->points);
    // The hem's and the waist's girth are the photograph's.
    for (const auto& [piece, end] : {std::pair(0, "_L"), std::pair(3, "_R")}) {
      EXPECT_NEAR(length(static_cast<size_t>(piece), std::string("leg_hem") + end),
                  SeamLength(pattern_.front, std::string("leg_hem") + end), 1e-9);
    }
  }
}

TEST_F(DraftedFork, CurvesStartUprightAndArriveLevel) {
  const ForkedPattern forked = Built(pattern_, stated_);
  for (const size_t p : {0u, 2u}) {
    const std::vector<Eigen::Vector2d>& centre = FindSection(forked.pieces[p], "centre_L")->points;
    const Eigen::Vector2d last = centre.back() - centre[centre.size() - 2];
    EXPECT_LT(std::abs(last.y()), 0.1 * std::abs(last.x()));
    for (size_t i = 1; i < centre.size(); ++i) {
      EXPECT_LE(centre[i].y(), centre[i - 1].y() + 1e-12);
      EXPECT_LE(centre[i].x(), centre[i - 1].x() + 1e-4);
    }
  }
}

TEST_F(DraftedFork, ThePiecesAreSewnToASphereWithThreeHoles) {
  for (const double pitch : {0.03, 0.02, 0.01}) {
    for (const ForkEvidence& evidence : {stated_, ruled_}) {
      const Result<ClothMesh> mesh = MeshFork(Built(pattern_, evidence), pitch);
      ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
      const ClothTopology sewn = ComputeWeldedTopology(*mesh);
      EXPECT_EQ(sewn.euler_characteristic(), -1);
      EXPECT_EQ(sewn.boundary_loop_count, 3);
      EXPECT_EQ(sewn.component_count, 1);
      EXPECT_TRUE(sewn.is_manifold);
      ClothMesh unsewn = *mesh;
      unsewn.seams.clear();
      EXPECT_EQ(ComputeWeldedTopology(unsewn).component_count, 4);
      // Along a seam the edges of both sides are equally long: sewing puckers nothing. The forks are one point.
      const std::vector<int> welded = WeldedParticles(*mesh);
      int at_fork = 0, fork = -1;
      for (const NamedParticle& named : mesh->named_particles) {
        if (named.name == "front/crotch") fork = welded[static_cast<size_t>(named.particle)];
      }
      for (const int target : welded) at_fork += target == fork;
      EXPECT_EQ(at_fork, 4);
    }
  }
}

TEST_F(DraftedFork, TheSameEvidenceGivesTheSameBytes) {
  const ClothMesh a = *MeshFork(Built(pattern_, stated_), 0.02), b = *MeshFork(Built(pattern_, stated_), 0.02);
  EXPECT_EQ(a.rest_positions, b.rest_positions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.texture_coordinates, b.texture_coordinates);
}

// No part of the cloth shows what is not garment: every pixel lies inside the photographed outline, but for a pixel.
TEST_F(DraftedFork, TheForkShowsTheGarmentsOwnPixels) {
  const Result<ClothMesh> mesh = MeshFork(Built(pattern_, stated_), 0.015);
  ASSERT_TRUE(mesh.ok());
  int outside = 0;
  for (size_t i = 0; i < mesh->rest_positions.size(); ++i) {
    const GarmentView& view = mesh->panel_of_particle[i] == 0 ? garment_.front : *garment_.back;
    const Eigen::Vector2d pixel(mesh->texture_coordinates[i].x() * view.image_width,
                                mesh->texture_coordinates[i].y() * view.image_height);
    bool inside = false;
    double nearest = 1e9;
    for (size_t k = 0, j = view.outline.size() - 1; k < view.outline.size(); j = k++) {
      const Eigen::Vector2d &a = view.outline[k], &b = view.outline[j];
      if ((a.y() > pixel.y()) != (b.y() > pixel.y()) &&
          pixel.x() < (b.x() - a.x()) * (pixel.y() - a.y()) / (b.y() - a.y()) + a.x()) {
        inside = !inside;
      }
      const double t = std::clamp((pixel - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-12), 0.0, 1.0);
      nearest = std::min(nearest, (pixel - a - t * (b - a)).norm());
    }
    outside += !inside && nearest > 3.0;
  }
  EXPECT_EQ(outside, 0);
}

Provenance ProvenanceOf(const ForkedPattern& forked, const std::string& name) {
  const GarmentMeasure* measure = FindMeasure(forked.measures, name);
  return measure == nullptr ? Provenance::kUnknown : measure->provenance;
}

TEST_F(DraftedFork, EveryValueSaysHowItIsKnown) {
  const ForkedPattern stated = Built(pattern_, stated_);
  EXPECT_EQ(ProvenanceOf(stated, "hip_width"), Provenance::kMeasured);
  for (const char* name : {"thigh_width", "front_rise", "back_rise", "crotch_length", "back_extension"}) {
    EXPECT_EQ(ProvenanceOf(stated, name), Provenance::kStated) << name;
  }
  const ForkedPattern seen = Built(pattern_, Gather(Evidence::kSideFolded, kCases[0], truth_, garment_));
  EXPECT_EQ(ProvenanceOf(seen, "thigh_width"), Provenance::kMeasured);
  EXPECT_EQ(ProvenanceOf(seen, "crotch_length"), Provenance::kMeasured);
  EXPECT_EQ(ProvenanceOf(seen, "front_rise"), Provenance::kRuled);
  const ForkedPattern ruled = Built(pattern_, ruled_);
  for (const char* name : {"thigh_width", "front_rise", "back_rise", "crotch_length", "back_extension"}) {
    EXPECT_EQ(ProvenanceOf(ruled, name), Provenance::kRuled) << name;
  }
  // The account agrees with the pieces.
  const Rebuilt rebuilt = MeasureAgain(stated, truth_.body.waist_to_hip);
  EXPECT_NEAR(2.0 * FindMeasure(stated.measures, "thigh_width")->value, rebuilt.thigh_girth, 0.001);
  EXPECT_NEAR(FindMeasure(stated.measures, "crotch_length")->value, rebuilt.crotch_length(), 1e-9);
}

TEST_F(DraftedFork, S46WithoutEvidenceNamesWhatFoldingHides) {
  const Status status = BuildFork(pattern_, {}).status();
  EXPECT_EQ(status.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(status.reason(), "FORK_UNKNOWN");
  for (const char* name : {"thigh_width", "front_rise", "back_rise"}) {
    EXPECT_NE(status.message().find(name), std::string::npos) << name;
  }
  const std::vector<std::string> all = {"thigh_width", "front_rise", "back_rise"};
  EXPECT_EQ(UndecidedByFolding(GarmentKind::kPants, {}), all);
  // A rule is an estimate and decides nothing; a photograph decides.
  EXPECT_EQ(UndecidedByFolding(GarmentKind::kShorts, ruled_), all);
  EXPECT_TRUE(UndecidedByFolding(GarmentKind::kPants, stated_).empty());
  EXPECT_TRUE(UndecidedByFolding(GarmentKind::kSkirt, {}).empty());
  ForkEvidence seen;
  seen.side_folded = garment_.side_folded;
  EXPECT_TRUE(UndecidedByFolding(GarmentKind::kPants, seen).empty());
}

// Both rises without a thigh: the back's extension follows from its rise.
TEST_F(DraftedFork, RisesAloneDecideTheFork) {
  ForkEvidence evidence = stated_;
  evidence.thigh_width.reset();
  const ForkedPattern forked = Built(pattern_, evidence);
  const Rebuilt rebuilt = MeasureAgain(forked, truth_.body.waist_to_hip);
  EXPECT_NEAR(rebuilt.front_rise, truth_.front_rise, 0.001);
  EXPECT_NEAR(rebuilt.back_rise, truth_.back_rise, 0.001);
  EXPECT_EQ(ProvenanceOf(forked, "thigh_width"), Provenance::kRuled);
}

TEST_F(DraftedFork, ContradictionsAreRefusedOrFlagged) {
  const auto reason = [&](const ForkEvidence& evidence) { return BuildFork(pattern_, evidence).status().reason(); };
  ForkEvidence evidence = stated_;
  evidence.front_rise = 27.0;  // Centimetres.
  EXPECT_EQ(reason(evidence), "FORK_MEASURE_ABSURD");
  evidence = stated_;
  evidence.back_rise = truth_.back_rise + 0.15;
  EXPECT_EQ(reason(evidence), "RISE_CONTRADICTS_PHOTOGRAPH");
  evidence = stated_;
  evidence.thigh_width = 1.0;
  EXPECT_EQ(reason(evidence), "FORK_MEASURE_ABSURD");
  evidence.thigh_width = std::nan("");
  EXPECT_EQ(reason(evidence), "FORK_MEASURE_ABSURD");
  // A thigh that leaves less than hip/20 for each extension is held there, and says so.
  evidence = ruled_;
  evidence.thigh_width = 0.5 * (truth_.thigh_girth - 0.12);
  const ForkedPattern clamped = Built(pattern_, evidence);
  EXPECT_TRUE(clamped.extension_clamped);
  EXPECT_EQ(ProvenanceOf(clamped, "thigh_width"), Provenance::kRuled);
  EXPECT_FALSE(Built(pattern_, stated_).extension_clamped);
  ForkEvidence seen;
  seen.side_folded = garment_.side_folded;
  seen.side_folded->metre_per_pixel *= 1.3;
  EXPECT_EQ(reason(seen), "SIDE_FOLD_CONTRADICTS_LENGTH");
  seen.side_folded->points.pop_back();
  EXPECT_EQ(reason(seen), "POINT_MISSING");
  const GarmentPattern skirt = Reconciled(testing::DrawKind(GarmentKind::kSkirt));
  EXPECT_EQ(BuildFork(skirt, ruled_).status().reason(), "KIND_WITHOUT_FORK");
}

// The photographed size is known from the side; the others follow it, and say that they were not measured.
TEST_F(DraftedFork, OtherSizesFollowThePhotographedOne) {
  const ForkedPattern medium = Built(pattern_, Gather(Evidence::kSideFolded, kCases[0], truth_, garment_));
  const auto size = [](const char* name, double hip, double length) {
    return GarmentSize{name, {{"hip_width", hip, Provenance::kStated}, {"length", length, Provenance::kStated}}, {}};
  };
  double last_thigh = 0.0, last_crotch = 0.0;
  for (const double step : {-1.0, 0.0, 1.0, 2.0}) {
    const Result<GarmentPattern> graded =
        GradePattern(pattern_, size("M", 0.5, 1.0), size("other", 0.5 + 0.02 * step, 1.0 + 0.01 * step));
    ASSERT_TRUE(graded.ok()) << graded.status().ToString();
    const ForkedPattern other = Built(*graded, EvidenceForSize(medium, *graded, {}));
    const double thigh = FindMeasure(other.measures, "thigh_width")->value;
    const double crotch = FindMeasure(other.measures, "crotch_length")->value;
    EXPECT_GT(thigh, last_thigh + 0.005);
    EXPECT_GT(crotch, last_crotch + 0.005);
    EXPECT_EQ(ProvenanceOf(other, "thigh_width"), Provenance::kRuled);
    EXPECT_EQ(ProvenanceOf(other, "crotch_length"), Provenance::kRuled);
    if (step == 0.0) {
      EXPECT_NEAR(thigh, FindMeasure(medium.measures, "thigh_width")->value, 1e-6);
      EXPECT_NEAR(crotch, FindMeasure(medium.measures, "crotch_length")->value, 1e-6);
    }
    EXPECT_TRUE(MeshFork(other, 0.02).ok());
    last_thigh = thigh;
    last_crotch = crotch;
  }
}

// Shorts are not photographed down to the knee: the fork's breadth reaches their hem.
TEST(Fork, ShortsAreRebuiltByEveryRule) {
  const GarmentPattern shorts = Reconciled(testing::DrawKind(GarmentKind::kShorts));
  for (int rule = 0; rule < kForkRuleCount; ++rule) {
    ForkEvidence evidence;
    evidence.rule = static_cast<ForkRule>(rule);
    const Result<ForkedPattern> forked = BuildFork(shorts, evidence);
    ASSERT_TRUE(forked.ok()) << ForkRuleName(*evidence.rule) << forked.status().ToString();
    const auto length = [&](size_t piece, const char* name) { return SeamLength(forked->pieces[piece], name); };
    EXPECT_NEAR(length(0, "inseam_L"), length(2, "inseam_L"), 1e-6);
    EXPECT_NEAR(length(0, "leg_hem_L") + length(2, "leg_hem_L"), 2.0 * SeamLength(shorts.front, "leg_hem_L"), 0.002);
    EXPECT_TRUE(MeshFork(*forked, 0.01).ok());
    EXPECT_EQ(ForkRuleFromName(ForkRuleName(*evidence.rule)), evidence.rule);
  }
}

// Hip 96: 6.5 + 12.1 by Aldrich, 6 + 6 close (numbers of the trade, for the body's hip).
TEST(Fork, RulesAreThoseOfTheBooks) {
  const auto extensions = [](ForkRule rule) {
    const DraftedTrousers truth = Draft(DraftRule::kAldrich, DraftedBody());
    const Garment garment = testing::Photograph(truth, 1000.0, 0.0, 1);
    ForkEvidence evidence;
    evidence.rule = rule;
    const ForkedPattern forked = Built(Reconciled(garment), evidence);
    return std::pair(FindMeasure(forked.measures, "front_extension")->value,
                     FindMeasure(forked.measures, "back_extension")->value);
  };
  EXPECT_NEAR(extensions(ForkRule::kAldrich).first, 0.065, 0.003);
  EXPECT_NEAR(extensions(ForkRule::kAldrich).second, 0.121, 0.005);
  EXPECT_NEAR(extensions(ForkRule::kClose).first, 0.060, 0.003);
  EXPECT_NEAR(extensions(ForkRule::kClose).second, 0.060, 0.003);
  EXPECT_NEAR(extensions(ForkRule::kClassic).second, 0.120, 0.005);
}

}  // namespace
}  // namespace fitroom
