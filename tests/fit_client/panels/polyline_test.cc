#include "fit_client/fit/panels/polyline.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom::panels {
namespace {

TEST(ResampleChain, StepsEquallyAlongTheArcAndKeepsTheEnds) {
  const Polyline corner = {{0, 0}, {3, 0}, {3, 4}};
  const Polyline samples = ResampleChain(corner, 7);
  ASSERT_EQ(samples.size(), 8u);
  EXPECT_EQ(samples.front(), corner.front());
  EXPECT_EQ(samples.back(), corner.back());
  EXPECT_NEAR((samples[2] - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((samples[5] - Eigen::Vector2d(3, 2)).norm(), 0.0, 1e-12);
}

TEST(SmoothSamples, LeavesAStraightLineAndRemovesAWave) {
  Polyline line, wave;
  for (int i = 0; i <= 100; ++i) {
    line.emplace_back(i, 2.0 * i);
    wave.emplace_back(i, std::sin(2.0 * M_PI * i / 5.0));
  }
  const Polyline smooth_line = SmoothSamples(line, 4.0);
  for (size_t i = 0; i < line.size(); ++i) EXPECT_NEAR((smooth_line[i] - line[i]).norm(), 0.0, 1e-9);
  // A Gaussian of sigma s damps a wave of length w by exp(-2 (pi s / w)^2): here to 3e-6.
  for (const Eigen::Vector2d& p : SmoothSamples(wave, 4.0)) EXPECT_NEAR(p.y(), 0.0, 1e-3);
}

TEST(FitBezier, ReproducesAPolynomialOfItsDegree) {
  Polyline points;
  std::vector<double> parameters;
  for (int i = 0; i <= 20; ++i) {
    const double t = i / 20.0;
    parameters.push_back(t);
    points.emplace_back(t, 1.0 - 2.0 * t + 5.0 * t * t * t);
  }
  const Polyline exact = FitBezier(points, parameters, 3);
  for (size_t i = 0; i < points.size(); ++i) EXPECT_NEAR((exact[i] - points[i]).norm(), 0.0, 1e-12);
  EXPECT_GT((FitBezier(points, parameters, 2)[5] - points[5]).norm(), 1e-3);
}

TEST(FitBezier, FallsBackToTheChordForTwoPoints) {
  const Polyline chord = {{0, 0}, {1, 2}};
  EXPECT_EQ(FitBezier(chord, std::vector<double>{0.0, 1.0}, 5), chord);
}

TEST(IsSimplePolygon, TellsAnEightFromASquare) {
  EXPECT_TRUE(IsSimplePolygon(Polyline{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_FALSE(IsSimplePolygon(Polyline{{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(IsSimplePolygon(Polyline{{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}));  // Touches its own side.
}

TEST(PolygonContains, AgreesWithTheFormulaOfADisc) {
  Polyline disc;
  for (int i = 0; i < 720; ++i) disc.emplace_back(std::cos(M_PI * i / 360.0), std::sin(M_PI * i / 360.0));
  for (double r : {0.0, 0.5, 0.99, 1.01, 2.0}) {
    for (double angle : {0.1, 1.7, 3.0, 4.4, 6.0}) {
      EXPECT_EQ(PolygonContains(disc, {r * std::cos(angle), r * std::sin(angle)}), r < 1.0) << r << " " << angle;
    }
  }
}

}  // namespace
}  // namespace fitroom::panels
