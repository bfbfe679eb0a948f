#include "fit_client/fit/measure/assess_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "fit_client/fit/measure/body_gap.h"
#include "fit_client/fit/measure/size_verdict.h"
#include "tests/fit_client/measure/band_on_cylinder.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.15;

// A body that is a cylinder, in a skirt that is a band.
class AssessFitTest : public ::testing::Test {
 protected:
  void SetUp() override {
    body_.mesh = MakeCylinder(kRadius);
    body_.measurements.waist = {2.0 * kPi * kRadius, 1.08};
    body_.measurements.hip = {2.0 * kPi * kRadius, 0.97};
  }

  // A band of this radius when worn, whose cloth is stretched by `strain`.
  FitAssessment Assess(double worn_radius, double strain) {
    band_ = MakeBand(worn_radius, 0.24, strain, -strain / 3.0, 0.01);
    double top = -1.0;
    double low = 1.0;
    for (const Eigen::Vector3d& rest : band_.cloth.rest_positions) {
      top = std::max(top, rest.y());
      low = std::min(low, rest.y());
    }
    for (size_t i = 0; i < band_.cloth.rest_positions.size(); ++i) {
      const std::string panel = band_.cloth.panel_of_particle[i] == 0 ? "front/" : "back/";
      const double y = band_.cloth.rest_positions[i].y();
      if (y == top) band_.cloth.named_particles.push_back({panel + "e1", static_cast<int>(i)});
      if (y == low) band_.cloth.named_particles.push_back({panel + "e2", static_cast<int>(i)});
    }
    if (shape_) std::for_each(band_.worn.begin(), band_.worn.end(), shape_);
    AssessInput input;
    if (!layer_.triangles.empty()) input.layers = {&layer_};
    input.kind = GarmentKind::kSkirt;
    input.fabric = FindFabric("woven");
    input.cloth = &band_.cloth;
    input.positions = &band_.worn;
    input.body = &body_;
    input.gravity.setZero();
    return AssessFit(input);
  }
  const ZoneFit& Zone(const FitAssessment& assessment, FitZone zone) const {
    for (const ZoneFit& fit : assessment.zones) {
      if (fit.zone == zone) return fit;
    }
    ADD_FAILURE() << "no zone " << FitZoneName(zone);
    return assessment.zones.front();
  }

  Body body_;
  Band band_;
  TriangleMesh layer_;                           // What is worn below, if it has triangles.
  std::function<void(Eigen::Vector3d&)> shape_;  // Moves the worn band's particles, if set.
};

// Garment girth less body girth, from the drape and from the flat pattern, within 10 mm, and in order over the sizes.
TEST_F(AssessFitTest, EaseIsGarmentLessBodyAndGrowsWithTheSize) {
  double last = -1.0;
  for (double ease = 0.0; ease <= 0.12; ease += 0.02) {
    const FitAssessment assessment = Assess(kRadius + ease / (2.0 * kPi), 0.0);
    const ZoneFit& hip = Zone(assessment, FitZone::kHip);
    ASSERT_TRUE(hip.measured) << hip.note;
    EXPECT_NEAR(hip.ease(), ease, 1e-6);
    EXPECT_NEAR(hip.worn_ease(), ease, 1e-3);
    EXPECT_GT(hip.worn_ease(), last);
    last = hip.worn_ease();
  }
}

// Wide enough all round, but the seams sit too far back: the front has to stretch, the back keeps its length.
TEST_F(AssessFitTest, ABodyThatIsWiderInFrontAsksForMoreThanTheFlatGirth) {
  constexpr double kOn = kRadius + 0.003;
  const double ease = 0.04;
  constexpr double kTurn = 0.3;  // Of each seam towards the back (unit: radian).
  shape_ = [](Eigen::Vector3d& place) {
    const double angle = std::atan2(place.x(), std::abs(place.z()));  // From the middle of front or back.
    const double side = place.z() > -1e-9 ? 1.0 : -1.0;  // The seams at z = 0 come out the same either way.
    const double turned = angle * (1.0 + side * 2.0 * kTurn / kPi);
    place = {kOn * std::sin(turned), place.y(), side * kOn * std::cos(turned)};
  };
  const FitAssessment assessment = Assess(kRadius + ease / (2.0 * kPi), 0.0);
  const ZoneFit& hip = Zone(assessment, FitZone::kHip);
  EXPECT_NEAR(hip.ease(), ease, 1e-6);
  const double flat_half = kPi * kRadius + 0.5 * ease;
  EXPECT_NEAR(hip.least_worn_girth, kOn * (kPi + 2.0 * kTurn) + flat_half, 1e-3);
}

// Over another layer the tape goes round that, and the cloth lies on it.
TEST_F(AssessFitTest, LayersBelowAreMeasuredAndTouched) {
  constexpr double kLayer = 0.17;
  layer_ = MakeCylinder(kLayer);
  const FitAssessment tight = Assess(kLayer + 0.003, 0.1);
  const ZoneFit& hip = Zone(tight, FitZone::kHip);
  EXPECT_NEAR(hip.body_girth, 2.0 * kPi * kRadius, 1e-6);
  EXPECT_NEAR(hip.layered_girth, 2.0 * kPi * kLayer, 1e-3);
  EXPECT_NEAR(hip.least_worn_girth, 2.0 * kPi * (kLayer + 0.003), 1e-3);
  EXPECT_NEAR(hip.worn_girth, hip.least_worn_girth, 2e-3);
  EXPECT_NEAR(hip.contact_share, 1.0, 1e-9);
  EXPECT_NEAR(hip.gap_mean, 0.003, 1e-4);
}

// A garment that ends a centimetre above the hip is measured where it is whole; farther up it does not reach it.
TEST_F(AssessFitTest, AGarmentThatEndsAtThePlaceIsMeasuredJustAboveItsHem) {
  body_.measurements.hip.height = 0.87;  // The band's lower edge is at 0.88.
  const ZoneFit near = Zone(Assess(kRadius + 0.01, 0.0), FitZone::kHip);
  ASSERT_TRUE(near.measured);
  EXPECT_NEAR(near.garment_girth, 2.0 * kPi * (kRadius + 0.01), 1e-6);
  body_.measurements.hip.height = 0.84;
  EXPECT_FALSE(Zone(Assess(kRadius + 0.01, 0.0), FitZone::kHip).measured);
}

TEST_F(AssessFitTest, StrainPressureAndGapAreThoseOfTheBand) {
  constexpr double kOffset = 0.003;
  const FitAssessment assessment = Assess(kRadius + kOffset, 0.04);
  const ZoneFit& hip = Zone(assessment, FitZone::kHip);
  ASSERT_TRUE(hip.has_strain);
  EXPECT_NEAR(hip.strain_mean, 0.04, 1e-3);
  EXPECT_NEAR(hip.strain_p95, 0.04, 2e-3);
  EXPECT_NEAR(hip.strain_angle, 0.0, 0.02);  // Round the body.
  EXPECT_NEAR(hip.contact_share, 1.0, 1e-9);
  EXPECT_NEAR(hip.gap_mean, kOffset, 5e-4);
  // The drape's woven has 1500 N/m; the fabric's other 1500 come in where the body forces the strain upon it.
  const double forced = kRadius * 1.04 / (kRadius + kOffset) - 1.0;
  const double expected =
      1500.0 * 0.04 / (1.0 - 0.04 / 3.0) / (kRadius + kOffset) + (3000.0 - 1500.0) * forced / kRadius;
  EXPECT_NEAR(hip.laplace_pressure, expected, 0.05 * expected);
  EXPECT_NEAR(hip.contact_pressure, expected, 0.05 * expected);
  EXPECT_EQ(assessment.maps.strain.size(), band_.cloth.triangles.size());
  EXPECT_EQ(assessment.maps.pressure.size(), band_.worn.size());
  EXPECT_EQ(assessment.maps.gap.size(), band_.worn.size());
}

TEST_F(AssessFitTest, ClothThatHangsFreeDoesNotPress) {
  const FitAssessment assessment = Assess(kRadius + 0.03, 0.02);
  EXPECT_EQ(Zone(assessment, FitZone::kHip).contact_share, 0.0);
  EXPECT_EQ(Zone(assessment, FitZone::kHip).laplace_pressure, 0.0);
  EXPECT_NEAR(Zone(assessment, FitZone::kHip).gap_mean, 0.03, 1e-3);
  for (const double pressure : assessment.maps.pressure) EXPECT_EQ(pressure, 0.0);
}

// Without a field the body's own mesh says the same, up to six centimetres.
TEST_F(AssessFitTest, GapsToTheMeshAreThoseToTheField) {
  for (const double gap : {0.0, 0.003, 0.012, 0.045, 0.2}) {
    const Band worn = MakeBand(kRadius + gap, 0.1, 0.0, 0.0, 0.01);
    const std::vector<double> gaps = MeasureGaps(body_.mesh, worn.worn);
    ASSERT_EQ(gaps.size(), worn.worn.size());
    // Facets of two degrees lie 23 micrometres inside of their circle.
    for (const double measured : gaps) EXPECT_NEAR(measured, std::min(gap, kLargestGap), 5e-5);
  }
  EXPECT_TRUE(MeasureGaps(TriangleMesh(), {{0.0, 0.0, 0.0}}).empty());
  EXPECT_TRUE(MeasureGaps(body_.mesh, {}).empty());
  const FitAssessment free = Assess(kRadius + 0.03, 0.02);
  EXPECT_EQ(Zone(free, FitZone::kHip).contact_share, 0.0);
  EXPECT_NEAR(Zone(free, FitZone::kHip).gap_mean, 0.03, 1e-3);
}

TEST_F(AssessFitTest, WhatCannotBeMeasuredSaysWhy) {
  body_.measurements.hip.height = 0.75;  // Below the skirt's hem.
  body_.measurements.waist = {};
  const FitAssessment assessment = Assess(kRadius, 0.0);
  EXPECT_FALSE(Zone(assessment, FitZone::kHip).measured);
  EXPECT_EQ(Zone(assessment, FitZone::kHip).note, "the garment does not reach round the hip");
  EXPECT_EQ(assessment.zones.size(), ZonesOf(GarmentKind::kSkirt).size());
  VerdictInput input;
  input.kind = GarmentKind::kSkirt;
  input.fabric = *FindFabric("woven");
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kUndecided);
}

}  // namespace
}  // namespace fitroom
