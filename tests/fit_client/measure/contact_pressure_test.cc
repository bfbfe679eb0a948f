#include "fit_client/fit/measure/contact_pressure.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "common/base/executor.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/drape.h"
#include "tests/fit_client/measure/band_on_cylinder.h"

namespace fitroom {
namespace {

Fabric MakeFabric(double stiffness) {
  Fabric fabric;
  fabric.stretch_stiffness = stiffness;
  fabric.areal_density = 0.2;
  return fabric;
}

// Mean over the particles that are farther than `margin` from the band's edges.
double MeanInside(const Band& band, const std::vector<double>& values, double margin) {
  double top = -1e9;
  for (const Eigen::Vector3d& rest : band.cloth.rest_positions) top = std::max(top, rest.y());
  double sum = 0.0;
  int count = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::abs(band.cloth.rest_positions[i].y()) > top - margin) continue;
    sum += values[i];
    ++count;
  }
  return sum / count;
}

// A strip that may narrow freely pulls with T = Y e per width at rest. It presses with T / r, T per width as worn: a
// third of e narrower.
double BandPressure(double stiffness, double strain, double radius) {
  return stiffness * strain / (1.0 - strain / 3.0) / radius;
}

TEST(ContactPressure, OfABandOnACylinderIsTensionByRadiusByBothWays) {
  for (const double radius : {0.06, 0.12, 0.2}) {
    for (const double strain : {0.03, 0.10}) {
      const Fabric fabric = MakeFabric(800.0);
      const Band band = MakeBand(radius, 0.1, strain, -strain / 3.0, 0.01);
      const double expected = BandPressure(fabric.stretch_stiffness, strain, radius);
      const auto strains = ComputeStrain(band.cloth, band.worn);
      const double laplace =
          MeanInside(band, LaplacePressure(band.cloth, band.worn, strains, fabric.stretch_stiffness), 0.025);
      const double contact =
          MeanInside(band, ContactForcePressure(band.cloth, band.worn, fabric, Eigen::Vector3d::Zero()), 0.025);
      EXPECT_NEAR(laplace, expected, 0.05 * expected) << "radius " << radius << ", strain " << strain;
      RecordProperty("laplace_by_expected", std::to_string(laplace / expected));
      RecordProperty("contact_by_expected", std::to_string(contact / expected));
      EXPECT_NEAR(contact, expected, 0.05 * expected) << "radius " << radius << ", strain " << strain;
    }
  }
}

// On a sphere both curvatures count: P = T / r + T / r with T = Y e / (1 - nu).
TEST(ContactPressure, OfASphericalCapIsTwiceTensionByRadius) {
  constexpr double kRadius = 0.15;
  constexpr double kStrain = 0.04;
  Band cap = MakeBand(kRadius, 0.1, 0.0, 0.0, 0.01);
  // The flat front panel, laid on a sphere by equal distance from the pole, and its rest shape shrunk evenly.
  for (size_t i = 0; i < cap.worn.size(); ++i) {
    const Eigen::Vector2d flat = cap.cloth.rest_positions[i].head<2>();
    const double distance = flat.norm();
    const double angle = distance / kRadius;
    const Eigen::Vector2d direction = distance > 0.0 ? Eigen::Vector2d(flat / distance) : Eigen::Vector2d(1.0, 0.0);
    cap.worn[i] =
        kRadius * Eigen::Vector3d(direction.x() * std::sin(angle), direction.y() * std::sin(angle), std::cos(angle));
    cap.cloth.rest_positions[i] /= 1.0 + kStrain;
  }
  cap.cloth.seams.clear();
  std::erase_if(cap.cloth.triangles,
                [&](const Eigen::Vector3i& t) { return cap.cloth.panel_of_particle[static_cast<size_t>(t[0])] != 0; });
  const auto strains = ComputeStrain(cap.cloth, cap.worn);
  const std::vector<double> pressures = LaplacePressure(cap.cloth, cap.worn, strains, 500.0);
  const double expected = 2.0 * 500.0 * kStrain * 1.5 / (1.0 + kStrain) / kRadius;
  double sum = 0.0;
  int count = 0;
  for (size_t i = 0; i < pressures.size(); ++i) {
    if (cap.cloth.panel_of_particle[i] != 0 || cap.cloth.rest_positions[i].norm() > 0.02) continue;
    sum += pressures[i];
    ++count;
  }
  ASSERT_GT(count, 5);
  EXPECT_NEAR(sum / count, expected, 0.05 * expected);
}

TEST(ContactPressure, OfASlackOrFlatClothIsNone) {
  const Band slack = MakeBand(0.15, 0.1, -0.05, 0.0, 0.01);
  const auto strains = ComputeStrain(slack.cloth, slack.worn);
  for (const double pressure : LaplacePressure(slack.cloth, slack.worn, strains, 800.0)) EXPECT_NEAR(pressure, 0, 1.0);
}

// The same law on what the solver itself finds: a band that is let go 10 % too narrow on a cylinder, without weight.
TEST(ContactPressure, OfABandThatTheSolverHasPutToRestIsTensionByRadius) {
  constexpr double kRadius = 0.10;
  constexpr double kOffset = 0.003;
  Band band = MakeBand(kRadius + kOffset, 0.08, 0.10, 0.0, 0.01);
  SerialExecutor executor;
  SignedDistanceFieldOptions field_options;
  field_options.pitch = 0.004;
  field_options.region = Eigen::AlignedBox3d(Eigen::Vector3d(-0.16, 0.9, -0.16), Eigen::Vector3d(0.16, 1.1, 0.16));
  auto field = SignedDistanceField::Build(MakeCylinder(kRadius), field_options, executor);
  ASSERT_TRUE(field.ok()) << field.status().message();
  DrapeOptions options;
  options.gravity.setZero();
  options.friction_coefficient = 0.0;
  options.contact_offset = kOffset;
  options.material.stretch_stiffness = 400.0;
  options.draping_substep_limit = 4000;
  auto drape = Drape(band.cloth, band.worn, *field, options, executor, {});
  ASSERT_TRUE(drape.ok()) << drape.status().message();
  Fabric fabric = MakeFabric(400.0);
  const auto strains = ComputeStrain(band.cloth, drape->positions);
  const double expected = BandPressure(400.0, 0.10, kRadius + kOffset);
  const double laplace = MeanInside(band, LaplacePressure(band.cloth, drape->positions, strains, 400.0), 0.02);
  const double contact =
      MeanInside(band, ContactForcePressure(band.cloth, drape->positions, fabric, Eigen::Vector3d::Zero()), 0.02);
  EXPECT_NEAR(laplace, expected, 0.05 * expected);
  EXPECT_NEAR(contact, expected, 0.05 * expected);
  RecordProperty("laplace_by_expected", std::to_string(laplace / expected));
  RecordProperty("contact_by_expected", std::to_string(contact / expected));
}

TEST(PressureBand, ChangesAtTheLimitsOfTheTable) {
  EXPECT_EQ(PressureBandOf(0.0), PressureBand::kNegligible);
  EXPECT_EQ(PressureBandOf(399.0), PressureBand::kNegligible);
  EXPECT_EQ(PressureBandOf(400.0), PressureBand::kComfortable);
  EXPECT_EQ(PressureBandOf(1300.0), PressureBand::kCritical);
  EXPECT_EQ(PressureBandOf(2330.0), PressureBand::kMedical);  // A waistband that fits well.
  EXPECT_EQ(PressureBandOf(3301.0), PressureBand::kHarmful);
}

}  // namespace
}  // namespace fitroom
