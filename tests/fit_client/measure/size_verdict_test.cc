#include "fit_client/fit/measure/size_verdict.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit_client/fit/measure/ease_bands.h"

namespace fitroom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ZoneFit MakeZone(FitZone zone, double body, double garment) {
  ZoneFit fit;
  fit.zone = zone;
  fit.measured = true;
  fit.body_girth = body;
  fit.garment_girth = garment;
  return fit;
}

VerdictInput Trousers(double waist_ease, double hip_ease, double thigh_ease, const char* fabric = "woven") {
  VerdictInput input;
  input.size = "M";
  input.kind = GarmentKind::kPants;
  input.fabric = *FindFabric(fabric);
  input.zones = {MakeZone(FitZone::kWaist, 0.70, 0.70 + waist_ease), MakeZone(FitZone::kHip, 0.96, 0.96 + hip_ease),
                 MakeZone(FitZone::kThigh, 0.56, 0.56 + thigh_ease)};
  return input;
}

TEST(SizeVerdict, UncertaintyIsTheRootOfTheSquares) {
  EXPECT_NEAR(kFitUncertainty, std::sqrt(0.010 * 0.010 + 0.009 * 0.009 + 0.005 * 0.005), 5e-6);
}

TEST(SizeVerdict, SaysWhatAShopperUnderstands) {
  SizeVerdict verdict = JudgeSize(Trousers(0.02, 0.06, 0.05));
  EXPECT_EQ(verdict.verdict, FitVerdict::kGood);
  EXPECT_FALSE(verdict.has_deciding_zone);

  verdict = JudgeSize(Trousers(0.02, 0.031, 0.05));
  EXPECT_EQ(verdict.verdict, FitVerdict::kTight);
  EXPECT_EQ(verdict.deciding_zone, FitZone::kHip);
  EXPECT_EQ(verdict.reason, "tight at the hip: 2 cm less than the 5 cm a woven needs");

  // 0.96 m of hip in 0.8564 m of cloth that ends at 10 %: 18 mm are missing.
  verdict = JudgeSize(Trousers(0.02, (0.96 - 0.018) / 1.10 - 0.96, 0.05));
  EXPECT_EQ(verdict.verdict, FitVerdict::kDoesNotFit);
  EXPECT_EQ(verdict.reason, "does not close by 18 mm at the hip");

  VerdictInput wide = Trousers(0.06, 0.06, 0.05);
  wide.facts.is_belted = true;
  verdict = JudgeSize(wide);
  EXPECT_EQ(verdict.verdict, FitVerdict::kLoose);
  EXPECT_EQ(verdict.reason, "waist 6 cm too wide, belted");

  VerdictInput low = Trousers(0.02, 0.06, 0.05);
  low.facts.rise_short = 0.024;
  verdict = JudgeSize(low);
  EXPECT_EQ(verdict.verdict, FitVerdict::kTight);
  EXPECT_EQ(verdict.reason, "rise short by 24 mm");

  VerdictInput open = Trousers(0.02, 0.06, 0.05);
  open.facts.open_gap = 0.018;
  EXPECT_EQ(JudgeSize(open).reason, "does not close by 18 mm at the hip");
  open.facts.open_seam = "left side seam";
  open.facts.open_length = 0.12;
  EXPECT_EQ(JudgeSize(open).reason, "does not close by 18 mm at the hip (left side seam, open over 12 cm)");
  EXPECT_EQ(JudgeSize(open).verdict, FitVerdict::kDoesNotFit);
}

// Wovens: stretched by 2 to 5 % snug, 5 to 10 % tight, above 10 % they cannot be worn. A knit that declares s is tight
// at s/2 and ends at s.
TEST(SizeVerdict, KnowsWhatAFabricGives) {
  for (const Fabric& fabric : FabricPresets()) {
    VerdictInput input;
    input.kind = GarmentKind::kTShirt;
    input.fabric = fabric;
    const auto verdict_at = [&](double strain) {
      input.zones = {MakeZone(FitZone::kBust, 0.9, 0.9 / (1.0 + strain))};
      return JudgeSize(input).verdict;
    };
    EXPECT_EQ(verdict_at(1.01 * fabric.limit_strain()), FitVerdict::kDoesNotFit) << fabric.name;
    EXPECT_EQ(verdict_at(0.99 * fabric.limit_strain()), FitVerdict::kTight) << fabric.name;
    EXPECT_EQ(verdict_at(1.01 * fabric.tight_strain()), FitVerdict::kTight) << fabric.name;
    if (!fabric.is_knit) {
      EXPECT_NEAR(fabric.tight_strain(), 0.05, 1e-12);
      EXPECT_NEAR(fabric.limit_strain(), 0.10, 1e-12);
    }
  }
  // Jersey that is as wide as the body is worn close, a woven of that width is tight.
  VerdictInput input;
  input.zones = {MakeZone(FitZone::kBust, 0.9, 0.9)};
  input.fabric = *FindFabric("jersey");
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kGood);
  input.fabric = *FindFabric("woven");
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kTight);
}

TEST(SizeVerdict, IsRefusedWhereADecidingDimensionIsUnknown) {
  VerdictInput input = Trousers(0.02, 0.06, 0.05);
  input.zones[2].provenance = Provenance::kUnknown;
  input.unknown = {"front rise"};
  SizeVerdict verdict = JudgeSize(input);
  EXPECT_EQ(verdict.verdict, FitVerdict::kUndecided);
  EXPECT_THAT(verdict.unknown, ElementsAre("thigh", "front rise"));
  EXPECT_THAT(verdict.reason, HasSubstr("not known: thigh, front rise"));
  // What does not go over the hips does not need the thigh to be known.
  input.zones[1].garment_girth = 0.80;
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kDoesNotFit);
  // A knee decides nothing, so that it may be unknown.
  input = Trousers(0.02, 0.06, 0.05);
  input.zones.push_back(MakeZone(FitZone::kKnee, 0.36, 0.0));
  input.zones.back().provenance = Provenance::kUnknown;
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kGood);
}

TEST(SizeVerdict, TheRiseOfFoldedTrousersIsUnknown) {
  EXPECT_THAT(UnknownDimensions(GarmentKind::kPants, {{"hip_width", 0.5}}), ElementsAre("front rise", "back rise"));
  EXPECT_THAT(UnknownDimensions(GarmentKind::kShorts,
                                {{"front_rise", 0.27, Provenance::kStated}, {"back_rise", 0.0, Provenance::kUnknown}}),
              ElementsAre("back rise"));
  EXPECT_TRUE(UnknownDimensions(GarmentKind::kSkirt, {}).empty());
  EXPECT_EQ(ZoneProvenance(GarmentKind::kPants, FitZone::kThigh, {}), Provenance::kUnknown);
  EXPECT_EQ(ZoneProvenance(GarmentKind::kPants, FitZone::kHip, {}), Provenance::kMeasured);
  EXPECT_EQ(ZoneProvenance(GarmentKind::kPants, FitZone::kThigh, {{"thigh_width", 0.3, Provenance::kRuled}}),
            Provenance::kRuled);
}

TEST(SizeVerdict, NearALimitIsACloseCall) {
  EXPECT_TRUE(JudgeSize(Trousers(0.03, 0.060, 0.05)).is_close);   // 9 mm above what the hip needs.
  EXPECT_FALSE(JudgeSize(Trousers(0.03, 0.070, 0.05)).is_close);  // 19 mm.
}

int Tightness(FitVerdict verdict) {
  switch (verdict) {
    case FitVerdict::kDoesNotFit:
      return 3;
    case FitVerdict::kTight:
      return 2;
    case FitVerdict::kGood:
      return 1;
    default:
      return 0;
  }
}

// Over what is worn below, a garment has to go round both: a woven without stretching, a knit by as much as round a
// body.
TEST(SizeVerdict, WhatIsWornBelowNeedsRoomToo) {
  VerdictInput input = Trousers(0.02, 0.06, 0.05);
  for (const double layer : {0.0, 0.02, 0.059}) {
    input.zones[1].layered_girth = 0.96 + layer;
    EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kGood) << layer;
  }
  input.zones[1].layered_girth = 0.96 + 0.09;
  SizeVerdict verdict = JudgeSize(input);
  EXPECT_EQ(verdict.verdict, FitVerdict::kTight);
  EXPECT_EQ(verdict.deciding_zone, FitZone::kHip);
  EXPECT_NEAR(verdict.shortfall, 0.03, 1e-12);
  EXPECT_EQ(verdict.reason, "tight at the hip: 3 cm narrower than the body with what is worn below");
  // Tight round the body by more than round the layers: the body's word stands.
  input = Trousers(0.02, -0.02, 0.05);
  const SizeVerdict bare = JudgeSize(input);
  input.zones[1].layered_girth = 0.96 + 0.01;
  EXPECT_EQ(JudgeSize(input).reason, bare.reason);
  // What cannot be put on stays so, whatever is worn below.
  input = Trousers(0.02, (0.96 - 0.018) / 1.10 - 0.96, 0.05);
  input.zones[1].layered_girth = 1.2;
  EXPECT_EQ(JudgeSize(input).verdict, FitVerdict::kDoesNotFit);

  VerdictInput shirt;
  shirt.kind = GarmentKind::kTShirt;
  shirt.fabric = *FindFabric("jersey");
  shirt.zones = {MakeZone(FitZone::kBust, 0.90, 0.96)};
  const double least = EaseBandOf(shirt.kind, shirt.fabric, FitZone::kBust, 1.0)->least;  // Part of the girth.
  ASSERT_LT(least, 0.0);
  shirt.zones[0].layered_girth = 0.96 / (1.0 + least) - 0.001;
  EXPECT_EQ(JudgeSize(shirt).verdict, FitVerdict::kGood);
  shirt.zones[0].layered_girth = 0.96 / (1.0 + least) + 0.001;
  EXPECT_EQ(JudgeSize(shirt).verdict, FitVerdict::kTight);
}

TEST(SizeVerdict, ALargerGarmentIsNeverTighter) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    VerdictInput input;
    input.kind = static_cast<GarmentKind>(trial % kGarmentKindCount);
    input.fabric = FabricPresets()[static_cast<size_t>(trial / 7) % FabricPresets().size()];
    std::vector<double> bodies;
    std::vector<double> garments;
    std::vector<double> intended;
    for (const FitZone zone : ZonesOf(input.kind)) {
      bodies.push_back(0.5 + 0.6 * unit(random));
      garments.push_back(bodies.back() * (0.75 + 0.3 * unit(random)));
      intended.push_back(garments.back() - 0.1 * unit(random));
      input.zones.push_back(MakeZone(zone, bodies.back(), garments.back()));
      if (trial % 3 == 0) input.zones.back().layered_girth = bodies.back() + 0.1 * unit(random);
    }
    const bool has_chart = trial % 2 == 0;
    int last = 4;
    for (int size = 0; size < 12; ++size) {
      input.intended.clear();
      for (size_t z = 0; z < bodies.size(); ++z) {
        input.zones[z].garment_girth = garments[z];
        if (has_chart) input.intended.push_back({input.zones[z].zone, intended[z], 0.02});
        const double grade = 0.04 * unit(random);
        garments[z] += grade;
        intended[z] += grade;
      }
      const int tightness = Tightness(JudgeSize(input).verdict);
      EXPECT_LE(tightness, last) << "trial " << trial << ", size " << size;
      last = tightness;
    }
  }
}

// Body girths of women, sizes 6 to 24 (EN 13402-3).
constexpr double kBust[] = {0.80, 0.84, 0.88, 0.92, 0.96, 1.00, 1.04, 1.10, 1.16, 1.22};
constexpr double kWaist[] = {0.64, 0.68, 0.72, 0.76, 0.80, 0.84, 0.88, 0.94, 1.00, 1.06};
constexpr double kHip[] = {0.88, 0.92, 0.96, 1.00, 1.04, 1.08, 1.12, 1.18, 1.24, 1.32};
constexpr size_t kSizeCount = 10;

SizeChart MakeChart() {
  SizeChart chart;
  for (size_t i = 0; i < kSizeCount; ++i) {
    GarmentSize size;
    size.name = std::to_string(6 + 2 * i);
    size.body = {{"bust", kBust[i]}, {"waist", kWaist[i]}, {"hip", kHip[i]}};
    chart.sizes.push_back(size);
  }
  return chart;
}

// Between sizes the other girths go with the primary one.
double Interpolated(const double* table, double position) {
  const auto i = static_cast<size_t>(std::min(position, kSizeCount - 1.001));
  return table[i] + (position - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

struct Population {
  int right = 0;
  int between = 0;
  int count = 0;
};

// Bodies of every size and in between, measures with the error that they are known to have (14 mm is twice sigma).
// Right: the size whose intended primary girth is nearest to the true one, or named as one of two.
Population Choose(GarmentKind kind, const Fabric& fabric, bool with_chart, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 0.5 * kFitUncertainty);
  const SizeChart chart = MakeChart();
  const double* primary = PrimaryZone(kind) == FitZone::kBust ? kBust : kHip;
  Population population;
  for (double position = 0.0; position < kSizeCount - 1.0; position += 0.013) {
    const double girths[3] = {Interpolated(kBust, position), Interpolated(kWaist, position),
                              Interpolated(kHip, position)};
    const double true_girth = PrimaryZone(kind) == FitZone::kBust ? girths[0] : girths[2];
    size_t truth = 0;
    for (size_t i = 0; i < kSizeCount; ++i) {
      if (std::abs(primary[i] - true_girth) < std::abs(primary[truth] - true_girth)) truth = i;
    }
    std::vector<SizeVerdict> verdicts;
    const double scan_error[3] = {error(random), error(random), error(random)};
    for (size_t i = 0; i < kSizeCount; ++i) {
      VerdictInput input;
      input.kind = kind;
      input.fabric = fabric;
      input.size = chart.sizes[i].name;
      if (with_chart) input.intended = IntendedGirths(chart, i);
      const double bodies[3] = {kBust[i], kWaist[i], kHip[i]};
      const FitZone zones[3] = {FitZone::kBust, FitZone::kWaist, FitZone::kHip};
      for (int z = IsBottom(kind) ? 1 : 0; z < 3; ++z) {
        const double target = EaseBandOf(kind, fabric, zones[z], bodies[z])->target;
        input.zones.push_back(MakeZone(zones[z], girths[z] + scan_error[z], bodies[z] + target));
      }
      verdicts.push_back(JudgeSize(input));
    }
    const SizeRecommendation chosen = Recommend(verdicts);
    ++population.count;
    if (!chosen.between.empty()) ++population.between;
    if (chosen.found && (chosen.size == chart.sizes[truth].name || chosen.between == chart.sizes[truth].name)) {
      ++population.right;
    }
  }
  return population;
}

TEST(SizeRecommendation, IsRightOnGradedSetsWithKnownTruth) {
  unsigned seed = 1;
  for (const GarmentKind kind :
       {GarmentKind::kTShirt, GarmentKind::kOnePiece, GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts}) {
    for (const Fabric& fabric : FabricPresets()) {
      for (const bool with_chart : {true, false}) {
        const Population population = Choose(kind, fabric, with_chart, seed++);
        const double right = static_cast<double>(population.right) / population.count;
        RecordProperty(std::string(GarmentKindName(kind)) + "_" + fabric.name + (with_chart ? "_chart" : ""),
                       std::to_string(right));
        EXPECT_GE(right, 0.95) << GarmentKindName(kind) << ", " << fabric.name << ", chart " << with_chart;
        // "Between" is for the border only: 7 mm on either side of it, in steps of 4 cm and more, and noise.
        EXPECT_LT(population.between, 0.45 * population.count);
      }
    }
  }
}

SizeVerdict Verdict(const char* size, FitVerdict verdict, double offset) {
  SizeVerdict result;
  result.size = size;
  result.verdict = verdict;
  result.has_primary = true;
  result.primary_offset = offset;
  result.reason = "because";
  result.shortfall = verdict == FitVerdict::kTight ? 0.04 : 0.0;
  return result;
}

TEST(SizeRecommendation, SaysBetweenOnlyWhereTwoSizesAreCloserThanTheMeasures) {
  const SizeVerdict s = Verdict("S", FitVerdict::kTight, 0.061);
  EXPECT_EQ(
      Recommend(std::vector{s, Verdict("M", FitVerdict::kGood, 0.018), Verdict("L", FitVerdict::kGood, -0.022)}).text,
      "between M and L");
  EXPECT_EQ(
      Recommend(std::vector{s, Verdict("M", FitVerdict::kGood, 0.010), Verdict("L", FitVerdict::kGood, -0.030)}).text,
      "M");
  // A size that lacks four centimetres somewhere is no alternative, and the nearest is passed over where it does not
  // fit elsewhere.
  EXPECT_EQ(
      Recommend(std::vector{s, Verdict("M", FitVerdict::kTight, -0.018), Verdict("L", FitVerdict::kGood, -0.058)}).size,
      "L");
}

TEST(SizeRecommendation, SaysWhenNothingFits) {
  const SizeRecommendation none =
      Recommend(std::vector{Verdict("S", FitVerdict::kDoesNotFit, 0.2), Verdict("M", FitVerdict::kDoesNotFit, 0.16)});
  EXPECT_FALSE(none.found);
  EXPECT_THAT(none.text, HasSubstr("no size fits"));
  EXPECT_FALSE(Recommend({}).found);
}

TEST(EaseBands, HoldTheFiguresOfTheTrade) {
  const Fabric& woven = *FindFabric("woven");
  EXPECT_NEAR(EaseBandOf(GarmentKind::kPants, woven, FitZone::kHip, 0.96)->least, 0.051, 1e-12);
  EXPECT_NEAR(EaseBandOf(GarmentKind::kPants, woven, FitZone::kWaist, 0.70)->least, 0.013, 1e-12);
  EXPECT_NEAR(EaseBandOf(GarmentKind::kOnePiece, woven, FitZone::kWaist, 0.70)->least, 0.019, 1e-12);
  EXPECT_NEAR(EaseBandOf(GarmentKind::kPants, woven, FitZone::kThigh, 0.56)->least, 0.025, 1e-12);
  EXPECT_FALSE(EaseBandOf(GarmentKind::kSkirt, woven, FitZone::kThigh, 0.56));
  const Fabric& jersey = *FindFabric("jersey");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, 0.25, 1.0), "oversized");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, 0.12, 1.0), "relaxed");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, 0.07, 1.0), "loose");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, 0.02, 1.0), "fitted");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, -0.05, 1.0), "very fitted");
  EXPECT_EQ(EaseClassName(jersey, FitZone::kBust, -0.15, 1.0), "compression");
  EXPECT_EQ(EaseClassName(woven, FitZone::kBust, 0.07, 1.0), "close");
  EXPECT_EQ(EaseClassName(woven, FitZone::kBust, 0.3, 1.0), "very loose");
}

}  // namespace
}  // namespace fitroom
