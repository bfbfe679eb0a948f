#include "fit_client/fit/measure/garment_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/fit_client/measure/band_on_cylinder.h"

namespace fitroom {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(GarmentLine, IsTheFlatGirthAndTheStretchedOne) {
  for (const double strain : {0.0, 0.08}) {
    const Band band = MakeBand(0.15, 0.3, strain, 0.0, 0.01);
    const GarmentLine line = MeasureLine(band.cloth, band.worn, {0.03, 0.03});
    ASSERT_TRUE(line.found);
    EXPECT_NEAR(line.flat_girth, 2.0 * kPi * 0.15 / (1.0 + strain), 1e-9);
    // Chords of a centimetre on a circle of 15 cm are shorter than their arcs by 2e-4 of themselves.
    EXPECT_NEAR(line.worn_girth, 2.0 * kPi * 0.15, 5e-4);
    EXPECT_NEAR(line.height, 1.03, 1e-9);
  }
}

// However the cloth folds and tilts, the line stays the garment's: a level cut would be longer or shorter.
TEST(GarmentLine, KeepsItsLengthInFoldsAndOnASlant) {
  Band band = MakeBand(0.15, 0.3, 0.0, 0.0, 0.01);
  const double before = MeasureLine(band.cloth, band.worn, {0.0, 0.0}).worn_girth;
  for (Eigen::Vector3d& place : band.worn) {
    const Eigen::Vector3d old = place;  // Turned by 25 degrees about x.
    place.y() = 1.0 + (old.y() - 1.0) * std::cos(0.436) - old.z() * std::sin(0.436);
    place.z() = (old.y() - 1.0) * std::sin(0.436) + old.z() * std::cos(0.436);
  }
  EXPECT_NEAR(MeasureLine(band.cloth, band.worn, {0.0, 0.0}).worn_girth, before, 1e-9);
}

TEST(GarmentLine, IsFoundWhereItLiesWhenWorn) {
  Band band = MakeBand(0.15, 0.3, 0.0, -0.1, 0.01);  // A tenth shorter when worn.
  const std::optional<LineHeights> heights = FindLineAt(band.cloth, band.worn, 1.045);
  ASSERT_TRUE(heights);
  EXPECT_NEAR((*heights)[0], 0.05, 1e-9);
  EXPECT_NEAR((*heights)[1], 0.05, 1e-9);
  EXPECT_FALSE(FindLineAt(band.cloth, band.worn, 1.2));
  EXPECT_FALSE(FindLineAt(band.cloth, band.worn, 0.8));
  EXPECT_FALSE(FindLineAt(band.cloth, {}, 1.0));
}

TEST(GarmentLine, IsNotFoundWhereTheHemPassesThroughTheHeight) {
  Band band = MakeBand(0.15, 0.3, 0.0, 0.0, 0.01);
  for (Eigen::Vector3d& place : band.worn) place.y() += 0.6 * place.x();
  EXPECT_TRUE(FindLineAt(band.cloth, band.worn, 1.0));
  EXPECT_FALSE(FindLineAt(band.cloth, band.worn, 0.80));
}

// Where the flat hem runs aslant, level lines near it run out of the cloth: what is left of them is no girth.
TEST(GarmentLine, IsClosedOnlyFromSeamToSeam) {
  Band band = MakeBand(0.15, 0.3, 0.0, 0.0, 0.01);
  for (Eigen::Vector3d& rest : band.cloth.rest_positions) rest.y() += 0.2 * rest.x();
  const GarmentLine whole = MeasureLine(band.cloth, band.worn, {0.0, 0.0});
  EXPECT_TRUE(whole.is_closed);
  for (const double height : {-0.14, 0.14}) {
    const GarmentLine cut_off = MeasureLine(band.cloth, band.worn, {height, height});
    EXPECT_TRUE(cut_off.found);
    EXPECT_FALSE(cut_off.is_closed) << height;
  }
}

// Front and back meet at the seams: on a cylinder at its two sides, each half as long as the other.
TEST(GarmentLine, HasItsHalvesBetweenTheSeams) {
  const Band band = MakeBand(0.15, 0.3, 0.08, 0.0, 0.01);
  const GarmentLine line = MeasureLine(band.cloth, band.worn, {0.02, 0.02});
  for (const LineHalf& half : line.halves) {
    EXPECT_NEAR(half.flat_length, 0.5 * line.flat_girth, 1e-9);
    EXPECT_NEAR(half.worn_length, kPi * 0.15, 5e-4);
    EXPECT_NEAR(half.height, 1.02, 1e-9);
    EXPECT_NEAR((half.ends[0] - Eigen::Vector3d(-0.15, 1.02, 0.0)).norm(), 0.0, 1e-3);
    EXPECT_NEAR((half.ends[1] - Eigen::Vector3d(0.15, 1.02, 0.0)).norm(), 0.0, 1e-3);
  }
}

TEST(GarmentLine, LeavesSleevesOut) {
  Band band = MakeBand(0.15, 0.3, 0.0, 0.0, 0.01);
  for (const Eigen::Vector3d& rest : band.cloth.rest_positions) {
    band.cloth.left_sleeve_weights.push_back(rest.x() > 0.1 ? 1.0 : 0.0);
    band.cloth.right_sleeve_weights.push_back(0.0);
  }
  const double whole = 2.0 * kPi * 0.15;
  const double left_out = 2.0 * (0.25 * whole - 0.1);
  EXPECT_NEAR(MeasureLine(band.cloth, band.worn, {0.0, 0.0}).flat_girth, whole - left_out, 0.025);
  const GarmentLine sleeve =
      MeasureSleeve(band.cloth, band.worn, {0.15, 1.0, 0.0}, Eigen::Vector3d::UnitY(), 0.2, true);
  EXPECT_NEAR(sleeve.flat_girth, left_out, 0.025);
  EXPECT_FALSE(MeasureSleeve(band.cloth, band.worn, {0.15, 1.0, 0.0}, Eigen::Vector3d::UnitY(), 0.2, false).found);
}

// Across a whole tube it is closed; where a part of the tube is the torso's it runs out of the sleeve.
TEST(GarmentLine, RoundASleeveIsClosedBelowTheArmholeOnly) {
  Band band = MakeBand(0.05, 0.3, 0.0, 0.0, 0.01);
  for (const Eigen::Vector3d& rest : band.cloth.rest_positions) {
    band.cloth.left_sleeve_weights.push_back(rest.y() < 0.5 * rest.x() ? 1.0 : 0.0);  // A slanting armhole.
    band.cloth.right_sleeve_weights.push_back(0.0);
  }
  const auto at = [&](double height) {
    return MeasureSleeve(band.cloth, band.worn, {0.0, height, 0.0}, Eigen::Vector3d::UnitY(), 0.2, true);
  };
  const GarmentLine through_armhole = at(1.0);
  EXPECT_TRUE(through_armhole.found);
  EXPECT_FALSE(through_armhole.is_closed);
  const GarmentLine below = at(0.9);
  EXPECT_TRUE(below.is_closed);
  EXPECT_NEAR(below.flat_girth, 2.0 * kPi * 0.05, 1e-6);
}

TEST(GarmentLine, OfAnOpeningIsItsEdge) {
  const Band band = MakeBand(0.15, 0.3, 0.08, 0.0, 0.01);
  std::vector<int> upper;
  double top = -1.0;
  for (const Eigen::Vector3d& rest : band.cloth.rest_positions) top = std::max(top, rest.y());
  for (size_t i = 0; i < band.worn.size(); ++i) {
    // One particle of each panel's upper edge, not a corner.
    const bool is_middle = std::abs(band.cloth.rest_positions[i].x()) < 0.006;
    if (band.cloth.rest_positions[i].y() == top && is_middle) upper.push_back(static_cast<int>(i));
  }
  ASSERT_GE(upper.size(), 2U);
  const GarmentLine edge = MeasureOpening(band.cloth, band.worn, upper);
  ASSERT_TRUE(edge.found);
  EXPECT_NEAR(edge.flat_girth, 2.0 * kPi * 0.15 / 1.08, 1e-9);
  EXPECT_NEAR(edge.worn_girth, 2.0 * kPi * 0.15, 5e-4);
  EXPECT_NEAR(edge.height, 1.0 + top, 1e-9);
  EXPECT_FALSE(MeasureOpening(band.cloth, band.worn, {-1}).found);
  EXPECT_FALSE(MeasureOpening(band.cloth, {}, upper).found);
}

}  // namespace
}  // namespace fitroom
