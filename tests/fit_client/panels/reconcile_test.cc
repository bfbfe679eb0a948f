#include "fit_client/fit/panels/reconcile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/panels/drawn_tshirt.h"
#include "tests/support/sample_garment.h"

namespace fitroom {
namespace {

using testing::DrawGarment;
using testing::DrawnTShirt;
using testing::DrawnView;

GarmentPattern Reconciled(const Garment& garment) {
  Result<GarmentPattern> pattern = ReconcileViews(garment);
  EXPECT_TRUE(pattern.ok()) << pattern.status().ToString();
  if (!pattern.ok()) throw std::runtime_error("no pattern");
  return std::move(pattern).value();
}

// The measures of the drawing, from its own numbers.
std::vector<GarmentMeasure> MeasuresOf(const DrawnTShirt& shirt) {
  // 2.5 cm below the underarm on the side, a parabola in y.
  const double depth = shirt.length + shirt.underarm.y();
  const double waist_t = (0.40 + shirt.underarm.y()) / depth, t = 0.025 / depth;
  const double chest = (t - waist_t) * (t - 1.0) / waist_t * shirt.underarm.x() +
                       t * (t - 1.0) / (waist_t * (waist_t - 1.0)) * shirt.half_waist +
                       t * (t - waist_t) / (1.0 - waist_t) * shirt.half_hem;
  return {{"front_length", shirt.length},
          {"back_length", shirt.length},
          {"chest_width", 2.0 * chest},
          {"waist_width", 2.0 * shirt.half_waist},
          {"hem_width", 2.0 * shirt.half_hem},
          {"shoulder_width", 2.0 * shirt.shoulder_tip.x()},
          {"neck_width", 2.0 * shirt.half_neck},
          // A smooth curve through shoulder, tip and sleeve cuts the drawing's corner at the tip.
          {"sleeve_length", (shirt.sleeve_top - shirt.shoulder_tip).norm()},
          {"sleeve_opening", (shirt.sleeve_top - shirt.sleeve_bottom).norm()}};
}

void ExpectMeasures(const GarmentPattern& pattern, const std::vector<GarmentMeasure>& truth, double tolerance) {
  const std::vector<GarmentMeasure> found = MeasurePattern(pattern);
  for (const GarmentMeasure& measure : truth) {
    const bool of_sleeve = measure.name.starts_with("sleeve");
    // A crumple of 1 mm moves the corners themselves by as much.
    EXPECT_NEAR(MeasureValue(found, measure.name), measure.value,
                std::max(0.0015, (of_sleeve ? 3.0 : 1.0) * tolerance * measure.value))
        << measure.name;
  }
}

// Half the girth of the sleeve at the underarm: from there straight to the sleeve's top edge.
void ExpectUpperArm(const GarmentPattern& pattern, const DrawnTShirt& shirt, double tolerance) {
  const Eigen::Vector2d along = (shirt.sleeve_top - shirt.shoulder_tip).normalized();
  const Eigen::Vector2d arm = shirt.underarm - shirt.shoulder_tip;
  const double drawn = std::abs(along.x() * arm.y() - along.y() * arm.x());
  const double found = panels::DistanceToChain(*FindPatternPoint(pattern.front, "underarm_L"),
                                               FindSection(pattern.front, "shoulder_L")->points);
  EXPECT_NEAR(found / drawn, 1.0, tolerance);
}

TEST(ReconcileViews, RecoversTheMeasuresOfADrawing) {
  const DrawnTShirt shirt;
  ExpectMeasures(Reconciled(DrawGarment(shirt, {}, {})), MeasuresOf(shirt), 0.003);
}

TEST(ReconcileViews, SeesThroughTiltScaleBendAndCrumple) {
  const DrawnTShirt shirt;
  for (double scale : {0.5, 1.0, 2.0}) {
    for (double tilt : {-5.0, 5.0}) {
      const DrawnView front{
          .tilt_deg = tilt, .pixels_per_metre = 1000 * scale, .sway = 0.004, .crumple = 0.001, .sleeve_turn_deg = 5};
      const DrawnView back{
          .tilt_deg = -0.7 * tilt, .pixels_per_metre = 1300, .sway = -0.005, .crumple = 0.001, .sleeve_turn_deg = -3};
      SCOPED_TRACE("scale " + std::to_string(scale) + " tilt " + std::to_string(tilt));
      const GarmentPattern pattern = Reconciled(DrawGarment(shirt, front, back));
      ExpectMeasures(pattern, MeasuresOf(shirt), 0.005);
      ExpectUpperArm(pattern, shirt, 0.015);
    }
  }
}

TEST(ReconcileViews, KeepsTheGivenLengthExactly) {
  DrawnTShirt shirt;
  Garment garment = DrawGarment(shirt, {.tilt_deg = 4}, {.tilt_deg = -2});
  garment.length = 0.70;  // The shop's scale is 3 % off; the stated length counts.
  EXPECT_NEAR(MeasureLength(Reconciled(garment)), 0.70, 0.0005);
}

TEST(ReconcileViews, GivesSeamsOneShapeAndSidesMirrorEachOther) {
  const GarmentPattern pattern = Reconciled(DrawGarment(DrawnTShirt(), {.tilt_deg = 5, .sway = 0.006, .crumple = 0.002},
                                                        {.pixels_per_metre = 700, .crumple = 0.002}));
  ASSERT_EQ(pattern.front.sections.size(), 10u);
  ASSERT_EQ(pattern.back.sections.size(), 10u);
  EXPECT_FALSE(pattern.asymmetric_by_design);
  for (size_t s = 0; s < 10; ++s) {
    const OutlineSection& front = pattern.front.sections[s];
    const OutlineSection& back = pattern.back.sections[s];
    EXPECT_EQ(front.name, back.name);
    EXPECT_EQ(front.pixels.size(), front.points.size());
    EXPECT_EQ(front.points.back(), pattern.front.sections[(s + 1) % 10].points.front());
    EXPECT_EQ(front.pixels.back(), pattern.front.sections[(s + 1) % 10].pixels.front());
    if (front.kind == SectionKind::kSeam) {
      EXPECT_EQ(front.points, back.points) << front.name;
    }
    // The outline runs neck, right side, hem, left side: mirrored, section s is section 10 - s, or itself.
    const OutlineSection& mirror = pattern.front.sections[(10 - s) % 10];
    ASSERT_EQ(front.points.size(), mirror.points.size());
    for (size_t i = 0; i < front.points.size(); ++i) {
      const Eigen::Vector2d& other = mirror.points[mirror.points.size() - 1 - i];
      EXPECT_EQ(front.points[i], Eigen::Vector2d(-other.x(), other.y())) << front.name;
    }
  }
}

TEST(ReconcileViews, PutsTheOriginBetweenTheNecksEndsAndTheWearersLeftOnPlusX) {
  const GarmentPattern pattern = Reconciled(DrawGarment(DrawnTShirt(), {}, {}));
  for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
    const Eigen::Vector2d cp = 0.5 * (*FindPatternPoint(*panel, "P1") + *FindPatternPoint(*panel, "P2"));
    EXPECT_NEAR(cp.norm(), 0.0, 1e-12);
    EXPECT_GT(FindPatternPoint(*panel, "P2")->x(), 0.05);
    EXPECT_GT(FindPatternPoint(*panel, "e4")->x(), 0.2);
    EXPECT_LT(FindPatternPoint(*panel, "hem_L")->y(), -0.5);
    EXPECT_GT(panels::SignedArea(JoinedPoints(*panel)), 0.0);
  }
  // The necks are their own: 9 cm in front, 2 cm behind, as drawn.
  EXPECT_NEAR(FindPatternPoint(pattern.front, "neck_drop")->y(), -0.09, 0.002);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "neck_drop")->y(), -0.02, 0.002);
}

TEST(ReconcileViews, SmoothsTheCrumpleOutOfTheOutline) {
  // Waves of 2 mm and 6 cm turn the outline by up to 12 degrees; the pattern's hem and sides must not.
  const GarmentPattern pattern = Reconciled(DrawGarment(DrawnTShirt(), {.crumple = 0.002}, {.crumple = 0.002}));
  for (const char* name : {"hem", "side_L", "sleeve_end_L", "underside_L"}) {
    const std::vector<Eigen::Vector2d>& points = FindSection(pattern.front, name)->points;
    double turn = 0.0;
    for (size_t i = 2; i < points.size(); ++i) {
      const Eigen::Vector2d u = points[i - 1] - points[i - 2], v = points[i] - points[i - 1];
      turn += std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
    }
    EXPECT_LT(turn, 0.6) << name;  // The drawn side turns by 0.3 in all; the waves would add about 3.
  }
}

TEST(ReconcileViews, TurnsEqualSleevesOfUnequalLayIntoEqualSleeves) {
  const DrawnTShirt shirt;
  const std::vector<GarmentMeasure> measures =
      MeasurePattern(Reconciled(DrawGarment(shirt, {.sleeve_turn_deg = 14}, {.sleeve_turn_deg = -14})));
  // The plain average of sleeves turned by ±14 degrees would be 3 % short.
  EXPECT_NEAR(MeasureValue(measures, "sleeve_length") / MeasureValue(MeasuresOf(shirt), "sleeve_length"), 1.0, 0.015);
}

TEST(ReconcileViews, KeepsAnAsymmetryThatBothPhotographsShow) {
  DrawnTShirt shirt;
  shirt.right_sleeve_share = 0.5;
  const Garment garment = DrawGarment(shirt, {.tilt_deg = 2}, {.pixels_per_metre = 800});
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_TRUE(pattern.asymmetric_by_design);
  const double left = (*FindPatternPoint(pattern.front, "e4") - *FindPatternPoint(pattern.front, "e3")).norm();
  const double right = (*FindPatternPoint(pattern.front, "e8") - *FindPatternPoint(pattern.front, "e7")).norm();
  EXPECT_NEAR(right / left, 0.5, 0.01);
}

TEST(ReconcileViews, AveragesAnAsymmetryThatOnePhotographShows) {
  DrawnTShirt folded;
  folded.right_sleeve_share = 0.8;
  Garment garment = DrawGarment(DrawnTShirt(), {}, {});
  garment.back = DrawView(folded, GarmentSide::kBack, {});
  EXPECT_FALSE(Reconciled(garment).asymmetric_by_design);
}

TEST(ReconcileViews, LevelsHemsThatBendOppositeWaysAndKeepsATail) {
  DrawnTShirt hanging, pushed_up;
  hanging.hem_sag = 0.017;
  pushed_up.hem_sag = -0.017;
  Garment garment = DrawGarment(hanging, {}, {});
  garment.back = DrawView(pushed_up, GarmentSide::kBack, {});
  const GarmentPattern level = Reconciled(garment);
  EXPECT_EQ(FindSection(level.front, "hem")->points, FindSection(level.back, "hem")->points);
  for (const Eigen::Vector2d& p : FindSection(level.front, "hem")->points) EXPECT_NEAR(p.y(), -0.68, 0.001);

  DrawnTShirt tailed;
  tailed.hem_sag = 0.06;
  garment = DrawGarment(DrawnTShirt(), {}, {});
  garment.back = DrawView(tailed, GarmentSide::kBack, {});
  const GarmentPattern tail = Reconciled(garment);
  const double drop = FindPatternPoint(tail.front, "hem_centre")->y() - FindPatternPoint(tail.back, "hem_centre")->y();
  EXPECT_NEAR(drop, 0.06, 0.003);
}

TEST(ReconcileViews, MakesABackOfTheFrontWhereNoneWasTaken) {
  Garment garment = DrawGarment(DrawnTShirt(), {}, {});
  garment.back.reset();
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_EQ(pattern.back.side, GarmentSide::kBack);
  EXPECT_EQ(FindSection(pattern.front, "side_L")->points, FindSection(pattern.back, "side_L")->points);
  EXPECT_NEAR(FindPatternPoint(pattern.front, "neck_drop")->y(), -0.09, 0.002);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "neck_drop")->y(), -0.025, 0.002);
  // Seen from behind, the wearer's left is on the left, where the photograph shows the wearer's right.
  const OutlineSection* front = FindSection(pattern.front, "side_R");
  const OutlineSection* back = FindSection(pattern.back, "side_L");
  EXPECT_NEAR((front->pixels.front() - back->pixels.back()).norm(), 0.0, 1e-6);
}

TEST(ReconcileViews, BridgesTheNeckOfAnOutlineThatFollowsTheBackEdge) {
  Garment garment = DrawGarment(DrawnTShirt(), {}, {});
  const Eigen::Vector2d drop = FindPoint(garment.front, "neck_drop")->pixel;
  // The front's neckline is replaced by the back's, as a mask that contains the inside of the back neck has it.
  DrawnTShirt shallow;
  shallow.front_drop = shallow.back_drop;
  garment.front = DrawView(shallow, GarmentSide::kFront, {});
  for (OutlinePoint& point : garment.front.points) {
    if (point.name == "neck_drop") point.pixel = drop;
  }
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_NEAR(FindPatternPoint(pattern.front, "neck_drop")->y(), -0.09, 0.002);
}

TEST(ReconcileViews, TakesTheStraightLinedSampleAsItIs) {
  const std::vector<GarmentMeasure> measures = MeasurePattern(Reconciled(testing::MakeSampleTShirt()));
  EXPECT_NEAR(MeasureValue(measures, "front_length"), 0.68, 0.001);
  EXPECT_NEAR(MeasureValue(measures, "chest_width"), 0.48, 0.0025);
  EXPECT_NEAR(MeasureValue(measures, "hem_width"), 0.48, 0.0025);
  EXPECT_NEAR(MeasureValue(measures, "shoulder_width"), 0.42, 0.01);
}

TEST(ReconcileViews, TakesLongSleevesTheSameWay) {
  DrawnTShirt shirt;
  shirt.sleeve_top = {0.62, -0.42};
  shirt.sleeve_bottom = {0.55, -0.50};
  Garment garment =
      DrawGarment(shirt, {.tilt_deg = 3, .crumple = 0.001, .sleeve_turn_deg = 8}, {.sleeve_turn_deg = -5});
  garment.kind = GarmentKind::kLongSleeve;
  const GarmentPattern pattern = Reconciled(garment);
  ExpectMeasures(pattern, MeasuresOf(shirt), 0.005);
  const Result<ClothMesh> mesh = MeshPattern(pattern, 0.01);
  ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
  EXPECT_EQ(ComputeEulerCharacteristic(*mesh), -2);
}

TEST(ReconcileViews, NeverCrashesOnPointsThatWander) {
  // Points thrown about by up to a few decimetres: a pattern that can be cut, or an error with a reason.
  int good_count = 0, refused_count = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0.0, std::pow(10.0, 0.5 + 2.0 * seed / 150.0));
    Garment garment = DrawGarment(DrawnTShirt(), {}, {.tilt_deg = 4});
    for (GarmentView* view : {&garment.front, &*garment.back}) {
      for (OutlinePoint& point : view->points) point.pixel += Eigen::Vector2d(step(random), step(random));
      if (seed % 3 != 0) continue;
      for (Eigen::Vector2d& p : view->outline) p += 0.2 * Eigen::Vector2d(step(random), step(random));
    }
    const Result<GarmentPattern> pattern = ReconcileViews(garment);
    if (!pattern.ok()) {
      EXPECT_FALSE(pattern.status().reason().empty());
      ++refused_count;
      continue;
    }
    const Result<ClothMesh> mesh = MeshPattern(*pattern, 0.02);
    EXPECT_TRUE(mesh.ok() || !mesh.status().reason().empty());
    if (mesh.ok()) {
      EXPECT_EQ(ComputeEulerCharacteristic(*mesh), -2);
      for (const Eigen::Vector2d& uv : mesh->texture_coordinates) EXPECT_TRUE(uv.allFinite());
    }
    ++good_count;
  }
  EXPECT_GT(good_count, 20);
  EXPECT_GT(refused_count, 20);
}

TEST(ReconcileViews, RefusesWithAReason) {
  const Garment good = DrawGarment(DrawnTShirt(), {}, {});
  const auto reason = [](const Garment& garment) { return ReconcileViews(garment).status().reason(); };
  ASSERT_TRUE(ReconcileViews(good).ok());

  Garment bad = good;
  bad.kind = GarmentKind::kPants;  // Its points are those of a top.
  EXPECT_EQ(reason(bad), "POINT_MISSING");

  bad = good;
  bad.front.outline.resize(5);
  EXPECT_EQ(reason(bad), "BAD_OUTLINE");

  bad = good;
  bad.back->outline[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason(bad), "BAD_OUTLINE");

  bad = good;
  bad.front.outline.assign(100, Eigen::Vector2d(50, 50));
  EXPECT_EQ(reason(bad), "BAD_OUTLINE");

  bad = good;  // A zigzag of 200 km.
  for (size_t i = 0; i < bad.front.outline.size(); i += 2) bad.front.outline[i].x() += 1e5;
  EXPECT_EQ(reason(bad), "BAD_OUTLINE");

  bad = good;
  bad.front.metre_per_pixel = 0.0;
  EXPECT_EQ(reason(bad), "BAD_SCALE");

  bad = good;
  bad.length = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reason(bad), "BAD_SCALE");

  bad = good;
  bad.length = 1.2;
  EXPECT_EQ(reason(bad), "SCALE_CONTRADICTS_LENGTH");

  bad = good;
  std::erase_if(bad.front.points, [](const OutlinePoint& point) { return point.name == "underarm_L"; });
  EXPECT_EQ(reason(bad), "POINT_MISSING");

  bad = good;
  for (OutlinePoint& point : bad.front.points) {
    if (point.name == "e4") point.pixel += Eigen::Vector2d(80, -80);
  }
  EXPECT_EQ(reason(bad), "POINT_OFF_OUTLINE");

  bad = good;  // Left and right as the image shows them instead of the wearer's.
  for (OutlinePoint& point : bad.front.points) point.name = TwinPointName(GarmentKind::kTShirt, point.name);
  EXPECT_EQ(reason(bad), "POINTS_OUT_OF_ORDER");

  bad = good;  // The sleeve's end taken for a point: its bottom corner beside its top one, on both sides and views.
  for (GarmentView* view : {&bad.front, &*bad.back}) {
    for (OutlinePoint& point : view->points) {
      if (point.name == "sleeve_bottom_L") point.pixel = FindPoint(*view, "e4")->pixel + Eigen::Vector2d(0, 10);
      if (point.name == "sleeve_bottom_R") point.pixel = FindPoint(*view, "e8")->pixel + Eigen::Vector2d(0, 10);
    }
  }
  EXPECT_EQ(reason(bad), "OPENING_TOO_NARROW");

  bad = good;
  std::swap(bad.front.points[18].pixel, bad.front.points[16].pixel);  // hem_L and hip_L.
  EXPECT_EQ(reason(bad), "POINTS_OUT_OF_ORDER");
}

}  // namespace
}  // namespace fitroom
