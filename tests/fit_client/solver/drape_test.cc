#include "fit_client/fit/solver/drape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"
#include "tests/fit_client/solver/cloth_shapes.h"

namespace fitroom {
namespace {

SignedDistanceField MakeColumn(double radius) {
  SerialExecutor serial;
  return SignedDistanceField::Build(testing::MakeCylinder(radius, -0.2, 0.5, 64, 30), {}, serial).value();
}

double Girth(const ClothMesh& tube, const std::vector<Eigen::Vector3d>& positions, int columns, int row) {
  double girth = 0.0;
  const int back = static_cast<int>(tube.rest_positions.size()) / 2;
  for (const int first : {0, back}) {
    for (int column = 0; column < columns; ++column) {
      const size_t at = static_cast<size_t>(first + row * (columns + 1) + column);
      girth += (positions[at + 1] - positions[at]).norm();
    }
  }
  return girth;
}

TEST(Drape, ATubeClosesRoundAColumnAndComesToRest) {
  // 2 x 24 cm of cloth round a column of 5.5 cm radius (34.6 cm): 13 cm of ease.
  const ClothMesh tube = testing::MakeTube(0.24, 0.2, 24, 20, 0.12);
  const SignedDistanceField body = MakeColumn(0.055);
  SerialExecutor serial;
  std::vector<DrapeStage> stages;
  const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, {}, serial, [&](const DrapeSnapshot& s) {
    EXPECT_EQ(s.positions.size(), tube.rest_positions.size());
    if (stages.empty() || stages.back() != s.stage) stages.push_back(s.stage);
  });
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->report.open_seam_count, 0);
  EXPECT_EQ(result->report.particles_inside + result->report.samples_inside, 0);
  EXPECT_LT(result->report.strain_p95, 0.05);
  EXPECT_EQ(result->report.self_crossing_count, 0);
  for (const SeamPair& pair : tube.seams) {
    EXPECT_EQ(result->positions[static_cast<size_t>(pair.a)], result->positions[static_cast<size_t>(pair.b)]);
  }
  EXPECT_EQ(stages, (std::vector<DrapeStage>{DrapeStage::kStart, DrapeStage::kMerging, DrapeStage::kStitched,
                                             DrapeStage::kDraping, DrapeStage::kFinished}));
}

TEST(Drape, ATightTubeIsStretchedByTheColumnsGirth) {
  // 2 x 16 cm round a column whose offset surface has radius 5.5 cm: hoop strain = 2 pi r / 0.32 - 1 = 8 %.
  const ClothMesh tube = testing::MakeTube(0.16, 0.1, 16, 10, 0.1);
  DrapeOptions options;
  options.contact_offset = 0.003;
  options.gravity.setZero();
  options.material.stretch_stiffness = 100.0;
  const SignedDistanceField body = MakeColumn(0.055 - options.contact_offset);
  SerialExecutor serial;
  const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, options, serial, {});
  ASSERT_TRUE(result.ok());
  ASSERT_EQ(result->report.open_seam_count, 0) << result->report.finishing_reason;
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kAtRest) << result->report.finishing_reason;
  // Chords of a circle are a little shorter than the arc.
  const double expected = 2.0 * M_PI * 0.055 / 0.32 - 1.0;
  EXPECT_NEAR(Girth(tube, result->positions, 16, 5) / 0.32 - 1.0, expected, 0.012);
  EXPECT_EQ(result->report.particles_inside + result->report.samples_inside, 0);
}

// The angle between the two sides of a seam pair about the column's axis, times the radius: the gap that one sees.
double ArcBetween(const std::vector<Eigen::Vector3d>& places, const SeamPair& pair, double radius) {
  const Eigen::Vector3d& a = places[static_cast<size_t>(pair.a)];
  const Eigen::Vector3d& b = places[static_cast<size_t>(pair.b)];
  const double angle = std::atan2(a.x() * b.z() - a.z() * b.x(), a.x() * b.x() + a.z() * b.z());
  return std::abs(angle) * radius;
}

// A tube of girth R whose fabric gives s round a column of girth G lacks G - R (1 + s), and gapes by as much: the
// column's girth is known without any cloth.
TEST(Drape, ATubeThatItsFabricCannotCloseGapesByTheGirthThatIsMissing) {
  constexpr double kRadius = 0.06;  // Of the column's offset surface; its girth is 37.7 cm.
  DrapeOptions options;
  options.gravity.setZero();
  options.material.stretch_stiffness = 200.0;
  const SignedDistanceField body = MakeColumn(kRadius - options.contact_offset);
  SerialExecutor serial;
  for (const double limit : {0.1, 0.2}) {
    for (const double missing : {0.03, 0.08}) {
      const double width = 0.5 * (2.0 * M_PI * kRadius - missing) / (1.0 + limit);
      const ClothMesh tube = testing::MakeTube(width, 0.12, 16, 12, 0.1);
      options.limit_strain = limit;
      const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, options, serial, {});
      ASSERT_TRUE(result.ok()) << result.status().ToString();
      const DrapeReport& report = result->report;
      EXPECT_EQ(report.outcome, DrapeOutcome::kSeamsOpen);
      ASSERT_EQ(report.openings.size(), 1U) << report.finishing_reason;
      EXPECT_NEAR(report.openings[0].lacking_girth, missing, 0.006) << report.finishing_reason;
      double widest = 0.0;
      for (const SeamPair& pair : tube.seams) {
        widest = std::max(widest, ArcBetween(result->positions, pair, kRadius));
      }
      EXPECT_NEAR(widest, missing, 0.01) << "limit " << limit;
      EXPECT_NEAR(report.openings[0].gap, widest, 0.006);
      EXPECT_NEAR(report.openings[0].seam_length, 0.12, 0.011);
      EXPECT_LT(report.strain_max, 1.0);
      EXPECT_EQ(report.particles_inside + report.samples_inside, 0);
    }
  }
}

// What closes within its fabric's limit is the same to the last bit as if seams held everything.
TEST(Drape, ASeamThatHoldsChangesNothing) {
  const ClothMesh tube = testing::MakeTube(0.16, 0.1, 16, 10, 0.1);  // Stretched by 8 %.
  DrapeOptions options;
  options.gravity.setZero();
  options.material.stretch_stiffness = 100.0;
  const SignedDistanceField body = MakeColumn(0.052);
  SerialExecutor serial;
  const Result<DrapeResult> unbreakable = Drape(tube, tube.rest_positions, body, options, serial, {});
  options.limit_strain = 0.1;
  options.tug = TugOptions();
  options.tug->waist_vertices = {0};
  const Result<DrapeResult> sewn = Drape(tube, tube.rest_positions, body, options, serial, {});
  ASSERT_TRUE(unbreakable.ok() && sewn.ok());
  EXPECT_EQ(sewn->report.outcome, DrapeOutcome::kAtRest);
  EXPECT_EQ(sewn->positions, unbreakable->positions);
}

// A hip that widens downwards: a cone whose offset surface has this radius at height y.
constexpr double kConeSlope = 0.2;  // Friction of 0.5 holds cloth on it however tight, that of stitching does not.
double ConeRadius(double y) { return 0.07 - kConeSlope * y; }

SignedDistanceField MakeCone(double contact_offset) {
  TriangleMesh cone = testing::MakeCylinder(1.0, -0.1, 0.25, 64, 30);
  for (Eigen::Vector3d& vertex : cone.vertices) {
    const double radius = ConeRadius(vertex.y()) - contact_offset * std::hypot(1.0, kConeSlope);
    vertex.x() *= radius;
    vertex.z() *= radius;
  }
  SerialExecutor serial;
  return SignedDistanceField::Build(cone, {}, serial).value();
}

// A closed tube of 10 cm height on that cone, level, from y = 0 upwards; the cone's girth is 44 cm there.
struct TubeOnCone {
  double girth;
  ClothMesh cloth;
  std::vector<Eigen::Vector3d> worn;
  TugOptions tug;  // Of the tube's lower edge.
  DrapeOptions options;
  SignedDistanceField body = MakeCone(options.contact_offset);

  explicit TubeOnCone(double its_girth) : girth(its_girth), cloth(testing::MakeTube(0.5 * girth, 0.1, 18, 10, 0.0)) {
    const size_t back = cloth.rest_positions.size() / 2;
    for (size_t i = 0; i < cloth.rest_positions.size(); ++i) {
      const Eigen::Vector3d& rest = cloth.rest_positions[i];
      const double angle = 2.0 * M_PI * rest.x() / girth;
      const double radius = ConeRadius(rest.y());
      worn.emplace_back(radius * std::sin(angle), rest.y(), (i < back ? 1.0 : -1.0) * radius * std::cos(angle));
      if (rest.y() == 0.0) tug.waist_vertices.push_back(static_cast<int>(i));
    }
    options.material.stretch_stiffness = 1000.0;
    options.friction_coefficient = 0.5;
    options.limit_strain = 0.1;
  }

  double LargestGirth() const { return girth * (1.0 + options.limit_strain); }
  double LowerEdge(const std::vector<Eigen::Vector3d>& places) const {
    double sum = 0.0;
    for (const int vertex : tug.waist_vertices) sum += places[static_cast<size_t>(vertex)].y();
    return sum / static_cast<double>(tug.waist_vertices.size());
  }
};

// What lacks girth where friction holds it, and has it higher up, closes once its wearer has pulled it up: there, no
// higher than it needs but for a reserve, and outside the body.
TEST(Drape, AGarmentThatIsHeldTooLowIsPulledUpToWhereItCloses) {
  TubeOnCone tube(0.36);
  SerialExecutor serial;
  const Result<DrapeResult> held = Settle(tube.cloth, tube.worn, tube.body, tube.options, serial, {});
  ASSERT_TRUE(held.ok()) << held.status().ToString();
  EXPECT_GT(Girth(tube.cloth, held->positions, 18, 0), tube.LargestGirth() + 0.01);
  EXPECT_EQ(held->report.tugged_way, 0.0);

  tube.options.tug = tube.tug;
  const Result<DrapeResult> pulled = Settle(tube.cloth, tube.worn, tube.body, tube.options, serial, {});
  ASSERT_TRUE(pulled.ok()) << pulled.status().ToString();
  const DrapeReport& report = pulled->report;
  EXPECT_EQ(report.outcome, DrapeOutcome::kAtRest) << report.finishing_reason;
  EXPECT_EQ(report.final_seam_gap_max, 0.0);
  EXPECT_EQ(report.particles_inside + report.samples_inside, 0);
  EXPECT_GT(report.tugged_way, 0.0);
  for (int row = 0; row <= 10; ++row) {
    EXPECT_LT(Girth(tube.cloth, pulled->positions, 18, row), tube.LargestGirth() + 0.01);
  }
  // Girths are known to a centimetre, which is 0.8 cm of the cone's height; the reserve is another 1.2.
  const double closing_height = (ConeRadius(0.0) - tube.LargestGirth() / (2.0 * M_PI)) / kConeSlope;
  EXPECT_GT(tube.LowerEdge(pulled->positions), closing_height - 0.01);
  EXPECT_LT(tube.LowerEdge(pulled->positions), closing_height + 0.02);
}

// No garment is pulled up farther than its waist may go; what does not close there either opens where it hung, to the
// last bit, and lacks the girth of the cone there, less the cloth's at its limit.
TEST(Drape, AGarmentThatNoTugClosesStaysWhereItHung) {
  TubeOnCone tube(0.28);
  SerialExecutor serial;
  const Result<DrapeResult> held = Settle(tube.cloth, tube.worn, tube.body, tube.options, serial, {});
  tube.options.tug = tube.tug;
  tube.options.tug->highest = 0.01;
  const Result<DrapeResult> result = Settle(tube.cloth, tube.worn, tube.body, tube.options, serial, {});
  ASSERT_TRUE(held.ok() && result.ok());
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kSeamsOpen) << result->report.finishing_reason;
  EXPECT_EQ(result->report.tugged_way, 0.0);
  EXPECT_EQ(result->positions, held->positions);
  ASSERT_FALSE(result->report.openings.empty());
  EXPECT_NEAR(result->report.openings[0].lacking_girth,
              2.0 * M_PI * ConeRadius(tube.LowerEdge(result->positions)) - tube.LargestGirth(), 0.01);
}

TEST(Drape, AGarmentThatIsFarTooSmallEndsWithThatOutcome) {
  const ClothMesh tube = testing::MakeTube(0.1, 0.08, 10, 8, 0.1);  // 20 cm of cloth round 50 cm of body.
  const SignedDistanceField body = MakeColumn(0.08);
  SerialExecutor serial;
  DrapeOptions options;
  options.draping_substep_limit = 600;
  const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, options, serial, {});
  ASSERT_TRUE(result.ok()) << result.status().ToString();
  EXPECT_EQ(result->report.outcome, DrapeOutcome::kSeamsOpen);
  EXPECT_GT(result->report.open_seam_count, 0);
  EXPECT_NE(result->report.finishing_reason.find("does not close"), std::string::npos);
  EXPECT_LT(result->report.deepest_penetration, 1e-4);
  for (const Eigen::Vector3d& position : result->positions) EXPECT_TRUE(position.allFinite());
}

// Equation (6): a vertex that has to touch and does says so; one that cannot is reported, and the run still ends at
// rest.
TEST(Drape, TheTouchingConditionIsReportedAndDoesNotKeepRestFromEndingTheRun) {
  const ClothMesh tube = testing::MakeTube(0.17, 0.06, 17, 6, 0.1);  // 34 cm of cloth, tight on 34.6 cm of column.
  const SignedDistanceField body = MakeColumn(0.052);
  SerialExecutor serial;
  DrapeOptions options;
  options.gravity.setZero();
  options.touching_vertices = {3 * 18 + 9};
  for (const double touching_distance : {0.01, -0.01}) {  // Nothing lies a centimetre inside.
    options.touching_distance = touching_distance;
    const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, options, serial, {});
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->report.outcome, DrapeOutcome::kAtRest) << result->report.finishing_reason;
    EXPECT_LT(result->report.draping_substeps, options.draping_substep_limit);
    EXPECT_EQ(result->report.touching_condition_met, touching_distance > 0.0);
  }
}

TEST(Drape, GivesTheSameForAnyThreadCount) {
  const ClothMesh tube = testing::MakeTube(0.24, 0.2, 48, 40, 0.12);
  const SignedDistanceField body = MakeColumn(0.055);
  DrapeOptions options;
  options.draping_substep_limit = 200;
  std::vector<Eigen::Vector3d> reference;
  for (const int thread_count : {1, 2, 3}) {
    ThreadPool pool(thread_count);
    const Result<DrapeResult> result = Drape(tube, tube.rest_positions, body, options, pool, {});
    ASSERT_TRUE(result.ok());
    if (reference.empty()) reference = result->positions;
    EXPECT_EQ(result->positions, reference) << thread_count << " threads";
  }
}

TEST(Drape, RefusesInputThatIsNotFiniteOrDoesNotMatch) {
  const ClothMesh tube = testing::MakeTube(0.2, 0.1, 8, 4, 0.12);
  const SignedDistanceField body = testing::MakeFarBody();
  SerialExecutor serial;
  std::vector<Eigen::Vector3d> start = tube.rest_positions;
  start.pop_back();
  EXPECT_EQ(Drape(tube, start, body, {}, serial, {}).status().reason(), "START_SIZE_MISMATCH");
  start = tube.rest_positions;
  start[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Drape(tube, start, body, {}, serial, {}).status().reason(), "START_NOT_FINITE");
  ClothMesh broken = tube;
  broken.seams[0].b = 100000;
  EXPECT_EQ(Drape(broken, tube.rest_positions, body, {}, serial, {}).status().reason(), "SEAM_INDEX_OUT_OF_RANGE");
  DrapeOptions options;
  options.touching_vertices = {-1};
  EXPECT_EQ(Drape(tube, tube.rest_positions, body, options, serial, {}).status().reason(), "VERTEX_OUT_OF_RANGE");
  EXPECT_EQ(Drape({}, {}, body, {}, serial, {}).status().code(), StatusCode::kInvalidArgument);
}

TEST(Drape, WrittenSeamPartnersLieApartByTheGap) {
  const ClothMesh tube = testing::MakeTube(0.2, 0.1, 8, 4, 0.0);
  const std::vector<Eigen::Vector3d> apart = SeparateSeamPartners(tube, tube.rest_positions, 1e-4);
  for (size_t vertex = 0; vertex < apart.size(); ++vertex) {
    EXPECT_LE((apart[vertex] - tube.rest_positions[vertex]).norm(), 0.5e-4 + 1e-12);
  }
}

}  // namespace
}  // namespace fitroom
