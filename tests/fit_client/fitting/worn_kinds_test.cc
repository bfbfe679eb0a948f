#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/executor.h"
#include "fit_client/fit/collision/body_repair.h"
#include "fit_client/fit/fork/fork.h"
#include "fit_client/fit/fork/fork_mesh.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "fit_client/fit/refine/dress_coarse_to_fine.h"
#include "fit_client/fit/stages/dress_garment.h"
#include "fit_client/fit/stages/tuck_in.h"
#include "fit_client/fitting/cut_garment.h"
#include "fit_client/fitting/describe_fit.h"
#include "fit_client/fitting/fit_inputs.h"
#include "tests/fit_client/fitting/winding_number.h"
#include "tests/fit_client/panels/drawn_kinds.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

ClothMesh Cut(GarmentKind kind, const Garment& garment) {
  const GarmentPattern pattern = ReconcileViews(garment).value();
  if (!HasLegs(kind)) return MeshPattern(pattern, 0.015).value();
  ForkEvidence evidence;
  evidence.rule = ForkRule::kAldrich;
  return MeshFork(BuildFork(pattern, evidence).value(), 0.015).value();
}

struct Wearer {
  explicit Wearer(const std::string& name)
      : scan(LoadScan(testing::TestDataFolder() / "bodies/population" / (name + ".ply")).value()),
        collider(RepairBody(scan.body.mesh).value()) {}
  Result<Dressing> PutOn(GarmentKind kind, const ClothMesh& cloth, const std::vector<WornGarment>& layers,
                         Executor& executor) const {
    return DressGarment(cloth, kind, {scan.body, collider, layers}, DressingOptions(), executor, {});
  }
  BodyInput scan;
  TriangleMesh collider;
};

int CountInside(const TriangleMesh& solid, const std::vector<Eigen::Vector3d>& places) {
  int count = 0;
  for (size_t i = 0; i < places.size(); i += 13) count += testing::WindingNumber(solid, places[i]) > 0.5;
  return count;
}

double MeanHeight(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& places, const std::string& ending) {
  double sum = 0.0;
  int count = 0;
  for (const NamedParticle& named : cloth.named_particles) {
    if (!named.name.ends_with(ending)) continue;
    sum += places[static_cast<size_t>(named.particle)].y();
    ++count;
  }
  EXPECT_GT(count, 0) << ending;
  return sum / std::max(count, 1);
}

// S40, S41: every kind comes to rest on a body, its seams closed, nothing inside the body by the winding number.
TEST(WornKinds, EveryKindIsWornOutsideTheBodyAndAtRest) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p001");
  ThreadPool executor(2);
  for (const GarmentKind kind : {GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts,
                                 GarmentKind::kLongSleeve, GarmentKind::kOnePiece, GarmentKind::kSleevedOnePiece}) {
    const std::string what(GarmentKindName(kind));
    const ClothMesh cloth = Cut(kind, testing::DrawKind(kind));
    EXPECT_EQ(ComputeEulerCharacteristic(cloth), ExpectedEulerCharacteristic(kind)) << what;
    const Result<Dressing> worn = wearer.PutOn(kind, cloth, {}, executor);
    ASSERT_TRUE(worn.ok()) << what << worn.status().ToString();
    EXPECT_EQ(worn->report.outcome, DrapeOutcome::kAtRest) << what << ": " << worn->report.finishing_reason;
    EXPECT_LE(worn->report.final_seam_gap_max, 0.0005) << what;
    EXPECT_EQ(CountInside(wearer.scan.body.mesh, worn->stages.final), 0) << what;
    EXPECT_EQ(worn->bottom.has_value(), IsBottom(kind)) << what;
    if (kind == GarmentKind::kPants) {
      EXPECT_NEAR(MeanHeight(cloth, worn->stages.final, "/crotch"),
                  wearer.scan.body.landmarks[BodyLandmark::kCrotch].position.y(), 0.01);
    }
    if (kind == GarmentKind::kSkirt) {
      EXPECT_NEAR(worn->bottom->belt.height, wearer.scan.body.measurements.waist.height, 0.01);
      EXPECT_EQ(worn->bottom->pull_end, PullEnd::kEdgeAtHeight);
    }
  }
}

// S41: the stages show the order, from below the groin upwards.
TEST(WornKinds, TrousersComeFromBelowTheGroin) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p001");
  ThreadPool executor(2);
  const ClothMesh cloth = Cut(GarmentKind::kPants, testing::DrawKind(GarmentKind::kPants));
  const DressingStages stages = wearer.PutOn(GarmentKind::kPants, cloth, {}, executor).value().stages;
  const double groin = wearer.scan.body.landmarks[BodyLandmark::kCrotch].position.y();
  EXPECT_LT(MeanHeight(cloth, stages.start, "/crotch"), groin - 0.1);
  EXPECT_LT(MeanHeight(cloth, stages.stitched, "/crotch"), groin - 0.1);
  EXPECT_GT(MeanHeight(cloth, stages.pulled_up, "/e1"), MeanHeight(cloth, stages.stitched, "/e1") + 0.1);
  EXPECT_NEAR(MeanHeight(cloth, stages.belted, "/e1"), MeanHeight(cloth, stages.final, "/e1"), 1e-4);
  for (const SeamPair& pair : cloth.seams) {
    EXPECT_LT((stages.stitched[static_cast<size_t>(pair.a)] - stages.stitched[static_cast<size_t>(pair.b)]).norm(),
              0.01);
  }
}

// S42: a shirt over a skirt ends outside of it.
TEST(WornKinds, AShirtIsWornOverASkirtAndNothingOfItEndsInside) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p002");
  ThreadPool executor(2);
  const ClothMesh skirt = Cut(GarmentKind::kSkirt, testing::DrawKind(GarmentKind::kSkirt));
  const Dressing below = wearer.PutOn(GarmentKind::kSkirt, skirt, {}, executor).value();
  const std::vector<WornGarment> layers = {MakeWornGarment(GarmentKind::kSkirt, skirt, below.stages.final).value()};
  const ClothMesh shirt = Cut(GarmentKind::kTShirt, testing::DrawKind(GarmentKind::kTShirt));
  const Result<Dressing> over = wearer.PutOn(GarmentKind::kTShirt, shirt, layers, executor);
  ASSERT_TRUE(over.ok()) << over.status().ToString();
  EXPECT_EQ(over->report.outcome, DrapeOutcome::kAtRest) << over->report.finishing_reason;
  EXPECT_EQ(CountInside(layers[0].surface, over->stages.final), 0);
  EXPECT_EQ(CountInside(wearer.scan.body.mesh, over->stages.final), 0);
}

// Friction holds a garment where the way there left it: every pitch is put on by edges of at most a centimetre, and
// where it is tight none has longer ones.
TEST(WornKinds, EveryPitchIsDressedByEdgesOfACentimetreAtMost) {
  const Garment garment = testing::DrawKind(GarmentKind::kTShirt);
  CutOptions options;
  options.with_coarser = true;
  for (const double pitch : {0.02, 0.01, 0.005}) {
    options.pitch = pitch;
    const CutGarment cut = CutGarmentToSize(garment, options).value();
    const ClothMesh& first = cut.coarser.empty() ? cut.cloth : cut.coarser.front();
    EXPECT_NEAR(MeanEdgeLength(first), 0.01, 0.001) << pitch;
    EXPECT_EQ(cut.coarser.empty(), pitch == 0.01);
  }
}

// S46: folded photographs do not decide the fork. The garment can be worn, what is hidden stays unknown; asked for, a
// rule's estimate is one.
TEST(WornKinds, AnAssumedForkIsWornAndNotMeasured) {
  const Garment garment = testing::DrawKind(GarmentKind::kPants);
  CutOptions options;
  options.pitch = 0.02;
  const CutGarment assumed = CutGarmentToSize(garment, options).value();
  options.fork_rule = ForkRule::kAldrich;
  const CutGarment ruled = CutGarmentToSize(garment, options).value();
  options.with_fork = false;
  const CutGarment flat = CutGarmentToSize(garment, options).value();
  EXPECT_EQ(ComputeEulerCharacteristic(assumed.cloth), ExpectedEulerCharacteristic(GarmentKind::kPants));
  // Four pieces: a fork lies between the legs, which the two folded panels do not have.
  EXPECT_EQ(FindPieces(assumed.cloth).count, 4);
  EXPECT_EQ(FindPieces(flat.cloth).count, 2);
  for (const char* name : {"thigh_width", "front_rise", "back_rise"}) {
    const GarmentMeasure* of_assumed = FindMeasure(assumed.measures, name);
    const GarmentMeasure* of_ruled = FindMeasure(ruled.measures, name);
    EXPECT_TRUE(of_assumed == nullptr || of_assumed->provenance == Provenance::kUnknown) << name;
    ASSERT_NE(of_ruled, nullptr) << name;
    EXPECT_EQ(of_ruled->provenance, Provenance::kRuled) << name;
  }
  ASSERT_FALSE(assumed.notes.empty());
  EXPECT_NE(assumed.notes.front().find("thigh_width"), std::string::npos) << assumed.notes.front();
}

// S42: before a bottom is put on over it, a shirt is tucked in: close to the body below the waistband, its hem above
// the crotch, and the trousers end outside of it.
TEST(WornKinds, AShirtIsTuckedIntoTrousersThatArePutOnOverIt) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p002");
  ThreadPool executor(2);
  const ClothMesh shirt = Cut(GarmentKind::kTShirt, testing::DrawKind(GarmentKind::kTShirt));
  const ClothMesh trousers = Cut(GarmentKind::kPants, testing::DrawKind(GarmentKind::kPants));
  const Dressing worn = wearer.PutOn(GarmentKind::kTShirt, shirt, {}, executor).value();
  const Result<DrapeResult> tucked =
      TuckIn(shirt, worn.stages.final, trousers, {wearer.scan.body, wearer.collider, {}}, DressingOptions(), executor);
  ASSERT_TRUE(tucked.ok()) << tucked.status().ToString();
  EXPECT_EQ(tucked->report.outcome, DrapeOutcome::kAtRest);
  EXPECT_EQ(CountInside(wearer.scan.body.mesh, tucked->positions), 0);
  const double groin = wearer.scan.body.landmarks[BodyLandmark::kCrotch].position.y();
  for (const Eigen::Vector3d& place : tucked->positions) EXPECT_GT(place.y(), groin);
  const std::vector<WornGarment> layers = {MakeWornGarment(GarmentKind::kTShirt, shirt, tucked->positions).value()};
  const Result<Dressing> over = wearer.PutOn(GarmentKind::kPants, trousers, layers, executor);
  ASSERT_TRUE(over.ok()) << over.status().ToString();
  EXPECT_EQ(over->report.outcome, DrapeOutcome::kAtRest) << over->report.finishing_reason;
  EXPECT_EQ(CountInside(layers[0].surface, over->stages.final), 0);
  // Nothing of the shirt looks out below the waistband.
  const TriangleMesh outside = MakeWornGarment(GarmentKind::kPants, trousers, over->stages.final)->surface;
  for (size_t i = 0; i < tucked->positions.size(); i += 7) {
    const Eigen::Vector3d& place = tucked->positions[i];
    if (place.y() >= over->bottom->belt.height - 0.04) continue;
    EXPECT_GT(testing::WindingNumber(outside, place), 0.5) << i;
  }
}

TEST(WornKinds, OneThreadAndTwoGiveTheSameBytes) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p003");
  const ClothMesh skirt = Cut(GarmentKind::kSkirt, testing::DrawKind(GarmentKind::kSkirt));
  SerialExecutor one;
  ThreadPool two(2);
  EXPECT_EQ(wearer.PutOn(GarmentKind::kSkirt, skirt, {}, one)->stages.final,
            wearer.PutOn(GarmentKind::kSkirt, skirt, {}, two)->stages.final);
}

// A coarse mesh of the worn skirt, then a finer one: the belt holds the waist where it held it, the skirt hangs as
// wide, and any number of threads gives the same bytes.
TEST(WornKinds, DressedFromCoarseToFineTheSkirtHangsWhereTheCoarseOneHung) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p003");
  const GarmentPattern pattern = ReconcileViews(testing::DrawKind(GarmentKind::kSkirt)).value();
  const ClothMesh coarse = MeshPattern(pattern, 0.024).value();
  const ClothMesh fine = MeshPattern(pattern, 0.012).value();
  const std::vector<const ClothMesh*> meshes = {&coarse, &fine};
  SerialExecutor one;
  ThreadPool two(2);
  const auto put_on = [&](Executor& executor) {
    return DressCoarseToFine(meshes, GarmentKind::kSkirt, {wearer.scan.body, wearer.collider, {}}, DressingOptions(),
                             executor, {})
        .value();
  };
  const Dressing worn = put_on(one);
  EXPECT_EQ(worn.stages.final, put_on(two).stages.final);
  EXPECT_EQ(worn.report.outcome, DrapeOutcome::kAtRest) << worn.report.finishing_reason;
  EXPECT_EQ(worn.report.particles_inside + worn.report.samples_inside, 0);
  EXPECT_EQ(worn.report.self_crossing_count, 0);
  EXPECT_LE(worn.report.final_seam_gap_max, 0.0005);
  const Dressing alone = wearer.PutOn(GarmentKind::kSkirt, coarse, {}, one).value();
  EXPECT_NEAR(worn.bottom->belt.height, alone.bottom->belt.height, 1e-9);
  EXPECT_NEAR(worn.bottom->belt.garment_girth, alone.bottom->belt.garment_girth, 0.002);
  for (const char* corner : {"/e1", "/e2", "/e3", "/e4"}) {
    EXPECT_NEAR(MeanHeight(fine, worn.stages.final, corner), MeanHeight(coarse, alone.stages.final, corner), 0.01);
  }
  EXPECT_EQ(worn.stages.belted.size(), fine.rest_positions.size());
}

// What a drape says in numbers is put into words with a remedy: cloth that trembles, and a dress that was pulled up.
TEST(WornKinds, TheReportNamesARemedyForTremblingAndTheWayOfATug) {
  Dressing dressed;
  dressed.report.outcome = DrapeOutcome::kNotAtRest;
  dressed.report.finishing_reason = "not at rest after 20000 substeps";
  dressed.report.tugging_substeps = 160;
  dressed.report.tugged_way = 0.031;
  FitReport report;
  DescribeOutcome(dressed, /*is_bottom=*/false, {}, report);
  EXPECT_EQ(report.finishing_reason, "STEP_LIMIT");
  EXPECT_NE(report.finishing_text.find("scan again with arms and legs away"), std::string::npos);
  const auto names_way = [](const std::string& note) { return note.find("up by 31 mm") != std::string::npos; };
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(), names_way));
  dressed.report = {};
  dressed.report.outcome = DrapeOutcome::kAtRest;
  FitReport calm;
  DescribeOutcome(dressed, /*is_bottom=*/false, {}, calm);
  EXPECT_EQ(calm.finishing_text.find("scan again"), std::string::npos);
  EXPECT_FALSE(std::any_of(calm.notes.begin(), calm.notes.end(), names_way));
}

// A woven skirt that is a fifth too narrow: its side seam gapes by the girth that is missing, which a tape round the
// body's hip and the drawing's formula know without any cloth.
TEST(WornKinds, ASkirtThatDoesNotCloseGapesByTheGirthThatIsMissing) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p001");
  ThreadPool executor(2);
  ClothMesh cloth = Cut(GarmentKind::kSkirt, testing::DrawKind(GarmentKind::kSkirt));
  const double hip = wearer.scan.body.measurements.hip.girth;
  DressingOptions options;
  options.drape.limit_strain = 0.1;
  const double girth_of_layer = hip + 2.0 * M_PI * options.drape.contact_offset;
  const double missing = 0.08;
  const double width_share =
      (girth_of_layer - missing) / (1.0 + options.drape.limit_strain) / (4.0 * testing::DrawnSkirt().half_hip);
  for (Eigen::Vector3d& place : cloth.rest_positions) place.x() *= width_share;
  const Result<Dressing> worn =
      DressGarment(cloth, GarmentKind::kSkirt, {wearer.scan.body, wearer.collider, {}}, options, executor, {});
  ASSERT_TRUE(worn.ok()) << worn.status().ToString();
  EXPECT_EQ(worn->report.outcome, DrapeOutcome::kSeamsOpen) << worn->report.finishing_reason;
  ASSERT_FALSE(worn->report.openings.empty());
  EXPECT_NEAR(worn->report.openings[0].lacking_girth, missing, 0.025) << worn->report.finishing_reason;
  EXPECT_NEAR(worn->report.openings[0].gap, worn->report.openings[0].lacking_girth, 0.015);
  EXPECT_LT(worn->report.strain_max, 2.0);
  EXPECT_EQ(CountInside(wearer.scan.body.mesh, worn->stages.final), 0);
}

// Trousers say in words what a belt and the waist's height show: too wide, and short of rise by what was taken off it.
TEST(WornKinds, TrousersSayThatTheyAreBeltedAndThatTheirRiseIsShort) {
  FR_REQUIRE_TEST_DATA();
  const Wearer wearer("p001");
  ThreadPool executor(2);
  const ClothMesh cloth = Cut(GarmentKind::kPants, testing::DrawKind(GarmentKind::kPants));
  ClothMesh wide = cloth;
  for (Eigen::Vector3d& place : wide.rest_positions) place.x() *= 1.25;
  const Dressing belted = wearer.PutOn(GarmentKind::kPants, wide, {}, executor).value();
  const double ease = belted.bottom->belt.garment_girth - belted.bottom->belt.body_girth;
  ASSERT_GT(ease, 0.03);
  char expected[64];
  std::snprintf(expected, sizeof(expected), "waist %.1f cm too wide, belted", 100.0 * ease);
  EXPECT_EQ(belted.bottom->sentences.front(), expected);

  const double depth = testing::DrawnTrousers().crotch;
  const auto without = [&](double taken_off) {
    ClothMesh low = cloth;
    for (Eigen::Vector3d& place : low.rest_positions) {
      if (place.y() > -depth) place.y() = -depth + (place.y() + depth) * (1.0 - taken_off / depth);
    }
    return wearer.PutOn(GarmentKind::kPants, low, {}, executor).value();
  };
  // Taut above the crotch: what the rise lacks, the waist is lower, as long as the hips do not catch it.
  const Dressing usual = without(0.0);
  EXPECT_NEAR(usual.bottom->belt.height - without(0.08).bottom->belt.height, 0.08, 0.015);
  const Dressing short_rise = without(0.15);
  EXPECT_GT(usual.bottom->belt.height - short_rise.bottom->belt.height, 0.075);
  ASSERT_GT(short_rise.bottom->rise_short, usual.bottom->rise_short);
  std::snprintf(expected, sizeof(expected), "rise short by %.0f mm", 1000.0 * short_rise.bottom->rise_short);
  EXPECT_EQ(short_rise.bottom->sentences.back(), expected);
}

}  // namespace
}  // namespace fitroom
