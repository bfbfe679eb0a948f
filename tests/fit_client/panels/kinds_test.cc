#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/panels/drawn_kinds.h"

// What every kind of garment has in common, on drawings of all seven.

namespace fitroom {
namespace {

using testing::DrawGarment;
using testing::DrawKind;
using testing::DrawnDress;
using testing::DrawnSkirt;
using testing::DrawnTrousers;
using testing::DrawnView;

GarmentPattern Reconciled(const Garment& garment) {
  Result<GarmentPattern> pattern = ReconcileViews(garment);
  if (!pattern.ok()) throw std::runtime_error(pattern.status().ToString());
  return std::move(pattern).value();
}

ClothMesh Cut(const GarmentPattern& pattern, double pitch) {
  Result<ClothMesh> mesh = MeshPattern(pattern, pitch);
  if (!mesh.ok()) throw std::runtime_error(mesh.status().ToString());
  return std::move(mesh).value();
}

const DrawnView kLaidFront = {.tilt_deg = 5, .pixels_per_metre = 600, .sway = 0.003, .crumple = 0.001};
const DrawnView kLaidBack = {.tilt_deg = -3, .pixels_per_metre = 1300, .sway = -0.004, .crumple = 0.001};

// Cuts a pattern at all pitches that people use and expects triangles without slivers.
void ExpectCut(const GarmentPattern& pattern, double narrowest = 1.0) {
  for (const double pitch : {0.04, 0.03, 0.02, 0.01}) {
    SCOPED_TRACE(pitch);
    const Result<ClothMesh> mesh = MeshPattern(pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    EXPECT_EQ(ComputeEulerCharacteristic(*mesh), ExpectedEulerCharacteristic(pattern.kind));
    double least = 180.0;
    int turned_count = 0;  // Texture rows run down: what is counter-clockwise from outside is negative there.
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3i& t : mesh->triangles) {
      const Eigen::Vector2d corner = mesh->texture_coordinates[static_cast<size_t>(t[0])];
      const Eigen::Vector2d u = mesh->texture_coordinates[static_cast<size_t>(t[1])] - corner;
      const Eigen::Vector2d v = mesh->texture_coordinates[static_cast<size_t>(t[2])] - corner;
      if (u.x() * v.y() - u.y() * v.x() >= 0.0) ++turned_count;
      for (int k = 0; k < 3; ++k) {
        const auto at = [&](int i) { return mesh->rest_positions[static_cast<size_t>(t[(k + i) % 3])]; };
        const double angle = std::acos((at(1) - at(0)).normalized().dot((at(2) - at(0)).normalized())) * 180.0 / M_PI;
        if (angle < least) place = at(0);
        least = std::min(least, angle);
      }
    }
    EXPECT_EQ(turned_count, 0);
    // Across something narrower than the pitch, a strap, no triangle can be better than its own proportions.
    const double slender = std::atan(narrowest / pitch) * 180.0 / M_PI;
    EXPECT_GE(least, std::min(pitch < 0.015 ? 24.0 : 22.0, 0.8 * slender)) << place.transpose();
  }
}

std::vector<GarmentKind> AllKinds() {
  std::vector<GarmentKind> kinds;
  for (int k = 0; k < kGarmentKindCount; ++k) kinds.push_back(static_cast<GarmentKind>(k));
  return kinds;
}

std::string KindName(const ::testing::TestParamInfo<GarmentKind>& info) {
  return std::string(GarmentKindName(info.param));
}

class EveryKind : public ::testing::TestWithParam<GarmentKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind, ::testing::ValuesIn(AllKinds()), KindName);

// The method's table: T-shirt and one-piece are a sphere with four holes, a skirt has two, trousers three.
TEST_P(EveryKind, HasItsHolesOnceSewn) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam(), {.tilt_deg = 3}, {.tilt_deg = -2}));
  const int holes = GetParam() == GarmentKind::kSkirt ? 2 : HasLegs(GetParam()) ? 3 : 4;
  ExpectCut(Reconciled(DrawKind(GetParam(), kLaidFront, kLaidBack)));
  for (const double pitch : {0.05, 0.04, 0.03, 0.02, 0.01}) {
    const ClothTopology sewn = ComputeWeldedTopology(Cut(pattern, pitch));
    EXPECT_EQ(sewn.euler_characteristic(), 2 - holes) << pitch;
    EXPECT_EQ(sewn.boundary_loop_count, holes);
    EXPECT_EQ(sewn.component_count, 1);
    EXPECT_TRUE(sewn.is_manifold);
  }
  EXPECT_EQ(ExpectedEulerCharacteristic(GetParam()), 2 - holes);
}

TEST_P(EveryKind, GivesSeamsOneShapeAndSidesMirrorEachOther) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam(), {.tilt_deg = 4, .sway = 0.005, .crumple = 0.001},
                                                     {.pixels_per_metre = 700, .crumple = 0.001}));
  EXPECT_FALSE(pattern.asymmetric_by_design);
  const size_t count = pattern.front.sections.size();
  ASSERT_EQ(pattern.back.sections.size(), count);
  for (size_t s = 0; s < count; ++s) {
    const OutlineSection& front = pattern.front.sections[s];
    const OutlineSection& back = pattern.back.sections[s];
    EXPECT_EQ(front.name, back.name);
    EXPECT_EQ(front.points.back(), pattern.front.sections[(s + 1) % count].points.front());
    EXPECT_EQ(back.points.back(), pattern.back.sections[(s + 1) % count].points.front());
    if (front.kind == SectionKind::kSeam) {
      EXPECT_EQ(front.points, back.points) << front.name;
    }
    // The outline begins with the upper opening: mirrored, section s is section count - s, or itself.
    for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
      const std::vector<Eigen::Vector2d>& own = panel->sections[s].points;
      const std::vector<Eigen::Vector2d>& mirror = panel->sections[(count - s) % count].points;
      ASSERT_EQ(own.size(), mirror.size());
      for (size_t i = 0; i < own.size(); ++i) {
        const Eigen::Vector2d& other = mirror[mirror.size() - 1 - i];
        EXPECT_EQ(own[i], Eigen::Vector2d(-other.x(), other.y())) << front.name;
      }
    }
  }
}

TEST_P(EveryKind, LiesUprightWithTheWearersLeftOnPlusXAndItsOriginAtTheTop) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam(), {.tilt_deg = 5}, {.tilt_deg = -5}));
  for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
    EXPECT_GT(panels::SignedArea(JoinedPoints(*panel)), 0.05);
    EXPECT_TRUE(panels::IsSimplePolygon(JoinedPoints(*panel)));
    const bool bottom = IsBottom(GetParam());
    const Eigen::Vector2d left = *FindPatternPoint(*panel, bottom ? "e1" : "P2");
    const Eigen::Vector2d right = *FindPatternPoint(*panel, bottom ? "e3" : "P1");
    EXPECT_NEAR((left + right).norm(), 0.0, 1e-12);
    EXPECT_GT(left.x(), 0.05);
    EXPECT_LT(FindPatternPoint(*panel, bottom ? "e2" : "hem_L")->y(), -0.35);
    for (const std::string& name : OutlinePointNames(GetParam())) {
      const Eigen::Vector2d* point = FindPatternPoint(*panel, name);
      ASSERT_NE(point, nullptr) << name;
      if (TwinPointName(GetParam(), name) == name) {
        EXPECT_NEAR(point->x(), 0.0, 1e-9) << name;
      } else {
        EXPECT_EQ(point->x() > 0.0, IsLeftPoint(GetParam(), name)) << name;
      }
    }
  }
}

TEST_P(EveryKind, NamesAParticleForEachPointOnBothPanels) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam()));
  const ClothMesh mesh = Cut(pattern, 0.01);
  EXPECT_EQ(mesh.named_particles.size(), 44u);
  for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
    const bool front = panel->side == GarmentSide::kFront;
    for (const std::string& name : OutlinePointNames(GetParam())) {
      const std::string full = (front ? "front/" : "back/") + name;
      const auto found = std::find_if(mesh.named_particles.begin(), mesh.named_particles.end(),
                                      [&](const NamedParticle& named) { return named.name == full; });
      ASSERT_NE(found, mesh.named_particles.end()) << full;
      const size_t particle = static_cast<size_t>(found->particle);
      EXPECT_EQ(mesh.panel_of_particle[particle], front ? 0 : 1);
      // Knots nearer than 0.8 pitches to a corner share its particle.
      EXPECT_LT((mesh.rest_positions[particle].head<2>() - *FindPatternPoint(*panel, name)).norm(), 0.0081) << full;
    }
  }
}

TEST_P(EveryKind, CoversThePatternsAreaWithTrianglesThatFaceOutwards) {
  const GarmentPattern pattern = Reconciled(DrawKind(GetParam()));
  const ClothMesh mesh = Cut(pattern, 0.01);
  double areas[2] = {0.0, 0.0};
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.rest_positions[static_cast<size_t>(t[k])]; };
    const Eigen::Vector3d u = at(1) - at(0), v = at(2) - at(0);
    const double turn = u.x() * v.y() - u.y() * v.x();
    const int panel = mesh.panel_of_particle[static_cast<size_t>(t[0])];
    EXPECT_EQ(turn > 0.0, panel == 0);
    areas[panel] += 0.5 * std::abs(turn);
  }
  EXPECT_NEAR(areas[0] / panels::SignedArea(JoinedPoints(pattern.front)), 1.0, 0.003);
  EXPECT_NEAR(areas[1] / panels::SignedArea(JoinedPoints(pattern.back)), 1.0, 0.003);
  double heaviest = 0.0;
  for (const double weight : mesh.left_sleeve_weights) heaviest = std::max(heaviest, weight);
  EXPECT_EQ(heaviest, HasSleeves(GetParam()) ? 1.0 : 0.0);
}

TEST_P(EveryKind, MeasuresWhatTheChartNames) {
  const std::vector<GarmentMeasure> measures = MeasurePattern(Reconciled(DrawKind(GetParam())));
  ASSERT_EQ(measures.size(), MeasureNames(GetParam()).size());
  for (size_t i = 0; i < measures.size(); ++i) {
    EXPECT_EQ(measures[i].name, MeasureNames(GetParam())[i]);
    EXPECT_GT(measures[i].value, 0.05) << measures[i].name;
    EXPECT_LT(measures[i].value, 1.1) << measures[i].name;
    const bool hidden = measures[i].name.ends_with("_rise") || measures[i].name == "thigh_width";
    EXPECT_EQ(measures[i].provenance, hidden ? Provenance::kUnknown : Provenance::kMeasured) << measures[i].name;
  }
}

// Every measure within 0.5 %, or 2 mm where a crumple of 1 mm moves both ends or a bend is rounded.
void ExpectMeasures(const GarmentPattern& pattern, const std::vector<GarmentMeasure>& truth) {
  const std::vector<GarmentMeasure> found = MeasurePattern(pattern);
  for (const GarmentMeasure& measure : truth) {
    EXPECT_NEAR(MeasureValue(found, measure.name), measure.value, std::max(0.002, 0.005 * measure.value))
        << measure.name;
  }
}

TEST(ReconcileSkirt, RecoversTheMeasuresOfADrawing) {
  const DrawnSkirt skirt;
  const std::vector<GarmentMeasure> truth = {{"waist_width", 2.0 * skirt.half_waist},
                                             {"hip_width", 2.0 * skirt.half_hip},
                                             {"hem_width", 2.0 * skirt.half_hem},
                                             {"length", skirt.length}};
  ExpectMeasures(Reconciled(DrawGarment(skirt)), truth);
  ExpectMeasures(Reconciled(DrawGarment(skirt, kLaidFront, kLaidBack)), truth);
}

TEST(ReconcileSkirt, KeepsTheWaistOfEachPanel) {
  const GarmentPattern pattern = Reconciled(DrawGarment(DrawnSkirt{.front_dip = 0.035, .back_dip = -0.01}));
  EXPECT_NEAR(FindPatternPoint(pattern.front, "waist_centre")->y(), -0.035, 0.002);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "waist_centre")->y(), 0.01, 0.002);
}

TEST(ReconcileSkirt, KeepsAnAsymmetryThatBothPhotographsShow) {
  EXPECT_FALSE(Reconciled(DrawGarment(DrawnSkirt{.right_hip_share = 0.97})).asymmetric_by_design);
  Garment garment = DrawGarment(DrawnSkirt{.right_hem_lift = 0.20}, {.tilt_deg = 2});
  garment.length = 0.50;  // The mean of both sides.
  const GarmentPattern slanting = Reconciled(garment);
  EXPECT_TRUE(slanting.asymmetric_by_design);
  const double lift = FindPatternPoint(slanting.front, "e4")->y() - FindPatternPoint(slanting.front, "e2")->y();
  EXPECT_NEAR(lift, 0.20, 0.01);
  ExpectCut(slanting);

  Garment mixed = DrawGarment(DrawnSkirt());
  mixed.back = DrawView(DrawnSkirt{.right_hem_lift = 0.10}, GarmentSide::kBack, {});
  EXPECT_FALSE(Reconciled(mixed).asymmetric_by_design);
}

// Most front photographs show the inside of the back waistband above the front's edge; the points are the front's.
TEST(ReconcileSkirt, BridgesTheWaistOfAnOutlineThatFollowsTheBackEdge) {
  Garment garment = DrawGarment(DrawnSkirt{.front_dip = 0.04});
  const std::vector<OutlinePoint> points = garment.front.points;
  garment.front = DrawView(DrawnSkirt{.front_dip = -0.01}, GarmentSide::kFront, {});
  for (OutlinePoint& point : garment.front.points) {
    if (!point.name.starts_with("waist")) continue;
    point.pixel = std::find_if(points.begin(), points.end(), [&](const OutlinePoint& other) {
                    return other.name == point.name;
                  })->pixel;
  }
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_NEAR(FindPatternPoint(pattern.front, "waist_centre")->y(), -0.04, 0.003);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "waist_centre")->y(), 0.0, 0.002);
}

TEST(ReconcileSkirt, LeavesAShareOfTheFrontsDipToABackThatNobodyPhotographed) {
  Garment garment = DrawGarment(DrawnSkirt{.front_dip = 0.04, .back_dip = 0.04});
  garment.back.reset();
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_LT(FindPatternPoint(pattern.back, "waist_centre")->y(), 0.0);
  EXPECT_GT(FindPatternPoint(pattern.back, "waist_centre")->y(),
            FindPatternPoint(pattern.front, "waist_centre")->y() + 0.015);
  EXPECT_EQ(FindSection(pattern.front, "side_L")->points, FindSection(pattern.back, "side_L")->points);
}

std::vector<GarmentMeasure> MeasuresOf(const DrawnTrousers& drawn) {
  // Outseam below the hip and inseam are straight lines; widths are taken at equal shares of them.
  const double hem_y = drawn.length;
  const double level = (drawn.crotch - 0.18) / (hem_y - 0.18);
  const auto across = [&](double share) -> Eigen::Vector2d {
    const double outer_share = level + share * (1.0 - level);
    const Eigen::Vector2d outer((1.0 - outer_share) * drawn.half_hip + outer_share * drawn.outer_hem,
                                (1.0 - outer_share) * 0.18 + outer_share * hem_y);
    const Eigen::Vector2d inner(share * drawn.inner_hem, (1.0 - share) * drawn.crotch + share * hem_y);
    return outer - inner;
  };
  // The knee is measured square to the leg, from the middle of its upper end to that of its hem.
  const Eigen::Vector2d top(0.5 * across(0.0).x(), drawn.crotch);
  const Eigen::Vector2d along = (Eigen::Vector2d(0.5 * (drawn.outer_hem + drawn.inner_hem), hem_y) - top).normalized();
  const double knee = std::abs(across(0.5).x() * along.y() - across(0.5).y() * along.x());
  return {{"waist_width", 2.0 * drawn.half_waist},
          {"hip_width", 2.0 * drawn.half_hip},
          {"thigh_width", across(0.25).norm()},
          {"knee_width", knee},
          {"hem_width", drawn.outer_hem - drawn.inner_hem},
          {"front_rise", drawn.crotch - drawn.front_dip},
          {"back_rise", drawn.crotch - drawn.back_dip},
          {"inseam", std::hypot(drawn.inner_hem, hem_y - drawn.crotch)},
          {"length", drawn.length}};
}

TEST(ReconcileTrousers, RecoversTheMeasuresOfADrawing) {
  const DrawnTrousers trousers;
  ExpectMeasures(Reconciled(DrawGarment(trousers)), MeasuresOf(trousers));
  ExpectMeasures(Reconciled(DrawGarment(trousers, kLaidFront, kLaidBack)), MeasuresOf(trousers));
  const DrawnTrousers shorts{.length = 0.45, .inner_hem = 0.03, .outer_hem = 0.29};
  ExpectMeasures(Reconciled(DrawGarment(shorts, kLaidFront, kLaidBack)), MeasuresOf(shorts));
}

TEST(ReconcileTrousers, TurnsEqualLegsOfUnequalLayIntoEqualLegs) {
  // The mean of all four legs is laid as drawn; one by one they lie up to 9 degrees off.
  const DrawnTrousers trousers;
  Garment garment = DrawGarment(trousers);
  garment.front = DrawView(trousers, GarmentSide::kFront, {.tilt_deg = 2, .sleeve_turn_deg = 5}, 4.0);
  garment.back = DrawView(trousers, GarmentSide::kBack, {.pixels_per_metre = 800, .sleeve_turn_deg = -3}, -4.0);
  const GarmentPattern pattern = Reconciled(garment);
  EXPECT_FALSE(pattern.asymmetric_by_design);
  ExpectMeasures(pattern, MeasuresOf(trousers));
}

TEST(ReconcileTrousers, PartsLegsThatLieSideBySide) {
  // Half the gap at the hem: 0 is a mask whose gap was filled and slit again.
  for (const double inner_hem : {0.0, 0.002}) {
    SCOPED_TRACE(inner_hem);
    DrawnTrousers trousers;
    trousers.inner_hem = inner_hem;
    trousers.outer_hem = 0.17;
    const GarmentPattern pattern = Reconciled(DrawGarment(trousers));
    const Eigen::Vector2d crotch = *FindPatternPoint(pattern.front, "crotch");
    for (const Eigen::Vector2d& p : FindSection(pattern.front, "inseam_L")->points) {
      EXPECT_GE(p.x(), 0.01 * (crotch.y() - p.y()) - 1e-9) << p.transpose();
    }
    ExpectMeasures(pattern, {{"hem_width", 0.17 - inner_hem}, {"waist_width", 0.38}, {"hip_width", 0.50}});
    ExpectCut(pattern);
  }
}

TEST(ReconcileDress, RecoversTheMeasuresOfADrawing) {
  for (const bool sleeved : {false, true}) {
    DrawnDress dress;
    dress.sleeved = sleeved;
    std::vector<GarmentMeasure> truth = {{"shoulder_width", 2.0 * dress.shoulder_tip.x()},
                                         {"waist_width", 2.0 * dress.half_waist},
                                         {"hip_width", 2.0 * dress.half_hip},
                                         {"hem_width", 2.0 * dress.half_hem},
                                         {"neck_width", 2.0 * dress.half_neck},
                                         {"front_length", dress.length},
                                         {"back_length", dress.length}};
    if (sleeved) truth.push_back({"sleeve_opening", (dress.sleeve_top - dress.sleeve_bottom).norm()});
    ExpectMeasures(Reconciled(DrawGarment(dress)), truth);
    ExpectMeasures(Reconciled(DrawGarment(dress, kLaidFront, kLaidBack)), truth);
  }
}

TEST(ReconcileDress, KeepsTheArmholesOfEachPanel) {
  const DrawnDress dress;
  const GarmentPattern pattern = Reconciled(DrawGarment(dress));
  EXPECT_NEAR(FindPatternPoint(pattern.front, "armhole_L")->x(), dress.front_armhole, 0.003);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "armhole_L")->x(), dress.back_armhole, 0.003);
  EXPECT_NEAR(FindPatternPoint(pattern.front, "neck_drop")->y(), -dress.front_drop, 0.002);
  EXPECT_NEAR(FindPatternPoint(pattern.back, "neck_drop")->y(), -dress.back_drop, 0.002);
}

TEST(ReconcileDress, TakesNarrowStraps) {
  for (const double strap : {0.04, 0.02, 0.01, 0.006}) {
    SCOPED_TRACE(strap);
    DrawnDress dress;
    dress.half_neck = 0.11;
    dress.shoulder_tip = {0.11 + strap, -0.003};
    dress.front_armhole = 0.13 + 0.5 * strap;
    dress.back_armhole = 0.135 + 0.5 * strap;
    const GarmentPattern pattern = Reconciled(DrawGarment(dress));
    EXPECT_NEAR((*FindPatternPoint(pattern.front, "e2") - *FindPatternPoint(pattern.front, "P2")).norm(), strap, 0.001);
    ExpectCut(pattern, strap);
  }
}

TEST(ReconcileSkirt, TakesFlaredOnesAndWideHems) {
  for (const double half_hem : {0.10, 0.20, 0.45, 0.60, 0.75}) {
    SCOPED_TRACE(half_hem);
    DrawnSkirt skirt;
    skirt.half_hem = half_hem;
    skirt.hem_sag = std::max(0.0, 0.4 * (half_hem - 0.3));
    const GarmentPattern pattern = Reconciled(DrawGarment(skirt));
    EXPECT_NEAR(MeasureValue(MeasurePattern(pattern), "hem_width"), 2.0 * half_hem, 0.005);
    ExpectCut(pattern);
  }
}

TEST(ReconcileDress, FollowsAVNeck) {
  DrawnDress dress;
  dress.v_neck = true;
  dress.front_drop = 0.18;
  const GarmentPattern pattern = Reconciled(DrawGarment(dress, {.crumple = 0.0005}, {.crumple = 0.0005}));
  EXPECT_NEAR(FindPatternPoint(pattern.front, "neck_drop")->y(), -dress.front_drop, 0.003);
  const Eigen::Vector2d drop(0.0, -dress.front_drop), end(dress.half_neck, 0.0);
  for (const Eigen::Vector2d& p : FindSection(pattern.front, "neck")->points) {
    EXPECT_LT(panels::DistanceToSegment({std::abs(p.x()), p.y()}, drop, end), 0.004) << p.transpose();
  }
  ExpectCut(pattern);
}

TEST(ReconcileSkirt, SewsSlitsUp) {
  for (const double depth : {0.05, 0.15, 0.25}) {
    const GarmentPattern pattern = Reconciled(DrawGarment(DrawnSkirt{.slit_depth = depth}));
    for (const Eigen::Vector2d& p : FindSection(pattern.front, "hem")->points) {
      EXPECT_NEAR(p.y(), -0.60, 0.004) << "slit " << depth << " at " << p.transpose();
    }
    ExpectCut(pattern);
  }
}

TEST(ReconcileTrousers, FindsThePointsOfEachLegAcrossANarrowGap) {
  // Legs 6 mm apart; points are given up to 5 mm off, so that some lie nearer to the other leg.
  DrawnTrousers trousers;
  trousers.inner_hem = 0.003;
  trousers.outer_hem = 0.17;
  Garment garment = DrawGarment(trousers);
  for (GarmentView* view : {&garment.front, &*garment.back}) {
    for (OutlinePoint& point : view->points) {
      const bool inner = point.name == "hem_inner_L" || point.name == "knee_inner_L" || point.name == "thigh_inner_R";
      if (inner) point.pixel.x() = 750.0 + (point.pixel.x() - 750.0) * -1.5;
    }
  }
  const GarmentPattern pattern = Reconciled(garment);
  const std::vector<GarmentMeasure> measures = MeasurePattern(pattern);
  EXPECT_NEAR(MeasureValue(measures, "hem_width"), 0.167, 0.003);
  EXPECT_NEAR(MeasureValue(measures, "inseam"), 0.73, 0.012);  // Parting the legs lengthens it.
}

TEST_P(EveryKind, NeverCrashesOnPointsThatWander) {
  int good_count = 0, refused_count = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0.0, std::pow(10.0, 0.3 + 2.0 * seed / 40.0));
    Garment garment = DrawKind(GetParam(), {.pixels_per_metre = 500}, {.tilt_deg = 4, .pixels_per_metre = 500});
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
    const Result<ClothMesh> mesh = MeshPattern(*pattern, 0.03);
    EXPECT_TRUE(mesh.ok() || !mesh.status().reason().empty());
    if (mesh.ok()) {
      EXPECT_EQ(ComputeEulerCharacteristic(*mesh), ExpectedEulerCharacteristic(GetParam()));
      for (const Eigen::Vector2d& uv : mesh->texture_coordinates) EXPECT_TRUE(uv.allFinite());
    }
    ++good_count;
  }
  EXPECT_GT(good_count, 3);
  EXPECT_GT(refused_count, 5);
}

}  // namespace
}  // namespace fitroom
