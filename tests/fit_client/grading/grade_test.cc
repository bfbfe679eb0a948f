#include "fit_client/fit/grading/grade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/mesh_pattern.h"
#include "fit_client/fit/panels/reconcile.h"
#include "tests/fit_client/panels/drawn_kinds.h"

// Grading of drawings of all kinds. What it made is measured here a second way: by lines across the joined outline.

namespace fitroom {
namespace {

using testing::DrawKind;
using Measures = std::map<std::string, double>;

GarmentPattern Reconciled(GarmentKind kind) {
  Result<GarmentPattern> pattern = ReconcileViews(DrawKind(kind, {.tilt_deg = 2}, {.tilt_deg = -1}));
  if (!pattern.ok()) throw std::runtime_error(pattern.status().ToString());
  return std::move(pattern).value();
}

double Height(const PanelPattern& panel, const std::string& name) { return FindPatternPoint(panel, name)->y(); }

// Where the line at this height crosses the outline, from right to left of the wearer.
std::vector<double> Crossings(const PanelPattern& panel, double height) {
  const std::vector<Eigen::Vector2d> outline = JoinedPoints(panel);
  std::vector<double> crossings;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > height) == (b.y() > height)) continue;
    crossings.push_back(a.x() + (height - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

// The width at this height of what contains the x: the torso at 0, a leg beside it.
double WidthAt(const PanelPattern& panel, double height, double x) {
  const std::vector<double> crossings = Crossings(panel, height);
  for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i] <= x && x <= crossings[i + 1]) return crossings[i + 1] - crossings[i];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double Between(const PanelPattern& panel, const std::string& a, const std::string& b) {
  return (*FindPatternPoint(panel, a) - *FindPatternPoint(panel, b)).norm();
}

double Along(const PanelPattern& panel, const std::string& section, const std::string& from, const std::string& to) {
  const OutlineSection& chain = *FindSection(panel, section);
  const Eigen::Vector2d a = *FindPatternPoint(panel, from), b = *FindPatternPoint(panel, to);
  double length = 0.0;
  bool inside = false;
  for (size_t i = 0; i < chain.points.size(); ++i) {
    if (inside) length += (chain.points[i] - chain.points[i - 1]).norm();
    if (chain.points[i] == a || chain.points[i] == b) {
      if (inside) return length;
      inside = true;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double Highest(const PanelPattern& panel) {
  double top = -1e9;
  for (const Eigen::Vector2d& p : JoinedPoints(panel)) top = std::max(top, p.y());
  return top;
}

Measures MeasureTop(const GarmentPattern& pattern) {
  const PanelPattern& front = pattern.front;
  const bool dress = pattern.kind == GarmentKind::kOnePiece || pattern.kind == GarmentKind::kSleevedOnePiece;
  Measures measures;
  // A long sleeve hangs beside the torso, so that the torso is what contains the middle.
  const auto torso = [&](const std::string& point, double below) {
    return WidthAt(front, Height(front, point) - below, 0.0);
  };
  measures["chest_width"] = torso("underarm_L", 0.025);
  measures["waist_width"] = torso("waist_L", 0.0);
  measures["hip_width"] = torso("hip_L", 0.0);
  measures["hem_width"] = Between(front, "hem_L", "hem_R");
  measures["shoulder_width"] = Between(front, dress ? "e2" : "e3", dress ? "e6" : "e7");
  measures["neck_width"] = Between(front, "P1", "P2");
  if (HasSleeves(pattern.kind)) {
    measures["sleeve_length"] = Along(front, "shoulder_L", dress ? "e2" : "e3", dress ? "sleeve_top_L" : "e4");
    measures["sleeve_opening"] = Between(front, dress ? "sleeve_top_L" : "e4", "sleeve_bottom_L");
  }
  for (const bool is_front : {true, false}) {
    const PanelPattern& panel = is_front ? pattern.front : pattern.back;
    // The hem of the drawings is level but for 1 mm.
    measures[is_front ? "front_length" : "back_length"] = Highest(panel) - Height(panel, "hem_centre");
  }
  return measures;
}

Measures MeasureBottom(const GarmentPattern& pattern) {
  const PanelPattern& front = pattern.front;
  Measures measures;
  measures["waist_width"] = Between(front, "e1", "e3");
  measures["hip_width"] = WidthAt(front, Height(front, "hip_L"), 0.0);
  if (pattern.kind == GarmentKind::kSkirt) {
    measures["hem_width"] = Between(front, "e2", "e4");
    measures["length"] = 0.5 * (Height(front, "waist_centre") + Height(pattern.back, "waist_centre")) -
                         0.5 * (Height(front, "hem_centre") + Height(pattern.back, "hem_centre"));
    return measures;
  }
  measures["thigh_width"] = Between(front, "thigh_outer_L", "thigh_inner_L");
  measures["knee_width"] = Between(front, "knee_outer_R", "knee_inner_R");
  measures["hem_width"] = Between(front, "e2", "hem_inner_L");
  measures["inseam"] = Along(front, "inseam_L", "crotch", "hem_inner_L");
  measures["length"] =
      0.5 * (Height(front, "waist_centre") + Height(pattern.back, "waist_centre")) - Height(front, "hem_mid_L");
  return measures;
}

Measures MeasureAgain(const GarmentPattern& pattern) {
  return IsBottom(pattern.kind) ? MeasureBottom(pattern) : MeasureTop(pattern);
}

// What a size up adds, flat (unit: metre): usual grades of women's wear.
double Grade(const std::string& name) {
  static const Measures kGrades = {{"chest_width", 0.025},   {"waist_width", 0.025},    {"hip_width", 0.025},
                                   {"hem_width", 0.015},     {"shoulder_width", 0.012}, {"neck_width", 0.006},
                                   {"sleeve_length", 0.006}, {"sleeve_opening", 0.008}, {"front_length", 0.012},
                                   {"back_length", 0.012},   {"thigh_width", 0.015},    {"knee_width", 0.008},
                                   {"inseam", 0.004},        {"length", 0.014}};
  return kGrades.at(name);
}

// A chart's size: what the photographs measure, to the nearest 5 mm, as shops state it, and `steps` sizes up.
GarmentSize Size(const Measures& measured, int steps) {
  GarmentSize size;
  size.name = "size" + std::to_string(steps);
  for (const auto& [name, value] : measured) {
    size.measures.push_back({name, std::round(value * 200.0) / 200.0 + steps * Grade(name), Provenance::kStated});
  }
  return size;
}

double LargestMove(const GarmentPattern& a, const GarmentPattern& b) {
  double largest = 0.0;
  for (const bool front : {true, false}) {
    const std::vector<Eigen::Vector2d> p = JoinedPoints(front ? a.front : a.back);
    const std::vector<Eigen::Vector2d> q = JoinedPoints(front ? b.front : b.back);
    EXPECT_EQ(p.size(), q.size());
    for (size_t i = 0; i < p.size(); ++i) largest = std::max(largest, (p[i] - q[i]).norm());
  }
  return largest;
}

std::string KindName(const ::testing::TestParamInfo<GarmentKind>& info) {
  return std::string(GarmentKindName(info.param));
}

class GradeEveryKind : public ::testing::TestWithParam<GarmentKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, GradeEveryKind,
                         ::testing::Values(GarmentKind::kTShirt, GarmentKind::kLongSleeve, GarmentKind::kOnePiece,
                                           GarmentKind::kSkirt, GarmentKind::kPants, GarmentKind::kShorts,
                                           GarmentKind::kSleevedOnePiece),
                         KindName);

// From two sizes smaller to three larger every measure gains what the chart says, within 2 mm.
TEST_P(GradeEveryKind, MeetsTheChartMeasuredASecondWay) {
  const GarmentPattern photographed = Reconciled(GetParam());
  const Measures measured = MeasureAgain(photographed);
  for (const int steps : {-2, -1, 1, 2, 3}) {
    const Result<GarmentPattern> graded = GradePattern(photographed, Size(measured, 0), Size(measured, steps));
    ASSERT_TRUE(graded.ok()) << graded.status().ToString();
    const Measures after = MeasureAgain(*graded);
    for (const auto& [name, before] : measured) {
      EXPECT_NEAR(after.at(name), before + steps * Grade(name), 0.002) << name << " by " << steps;
    }
  }
}

TEST_P(GradeEveryKind, GradedToItselfIsUnchangedToTheBit) {
  const GarmentPattern photographed = Reconciled(GetParam());
  const GarmentSize size = Size(MeasureAgain(photographed), 0);
  const Result<GarmentPattern> graded = GradePattern(photographed, size, size);
  ASSERT_TRUE(graded.ok()) << graded.status().ToString();
  EXPECT_EQ(LargestMove(*graded, photographed), 0.0);
}

TEST_P(GradeEveryKind, ReturnsFromALargerSize) {
  const GarmentPattern photographed = Reconciled(GetParam());
  const Measures measured = MeasureAgain(photographed);
  const GarmentSize medium = Size(measured, 0);
  for (const int steps : {-2, 1, 3}) {
    const Result<GarmentPattern> other = GradePattern(photographed, medium, Size(measured, steps));
    ASSERT_TRUE(other.ok()) << other.status().ToString();
    EXPECT_GT(LargestMove(*other, photographed), 0.005);
    const Result<GarmentPattern> back = GradePattern(*other, Size(measured, steps), medium);
    ASSERT_TRUE(back.ok()) << back.status().ToString();
    EXPECT_LT(LargestMove(*back, photographed), 0.0005) << steps;
  }
}

TEST_P(GradeEveryKind, KeepsSeamsEqualSidesMirroredAndPixelsInPlace) {
  const GarmentPattern photographed = Reconciled(GetParam());
  const Measures measured = MeasureAgain(photographed);
  const Result<GarmentPattern> graded = GradePattern(photographed, Size(measured, 0), Size(measured, 2));
  ASSERT_TRUE(graded.ok());
  for (size_t s = 0; s < graded->front.sections.size(); ++s) {
    const OutlineSection& front = graded->front.sections[s];
    if (front.kind == SectionKind::kSeam) {
      EXPECT_EQ(front.points, graded->back.sections[s].points) << front.name;
    }
    EXPECT_EQ(front.pixels, photographed.front.sections[s].pixels);
    // Each section begins where the one before it ends.
    const size_t before = (s + graded->front.sections.size() - 1) % graded->front.sections.size();
    EXPECT_EQ(front.points.front(), graded->front.sections[before].points.back()) << front.name;
    if (!front.name.ends_with("_L")) continue;
    std::string twin_name = front.name;
    twin_name.back() = 'R';
    const OutlineSection& twin = *FindSection(graded->front, twin_name);
    ASSERT_EQ(twin.points.size(), front.points.size());
    for (size_t i = 0; i < front.points.size(); ++i) {
      const Eigen::Vector2d& p = twin.points[front.points.size() - 1 - i];
      EXPECT_EQ(front.points[i], Eigen::Vector2d(-p.x(), p.y())) << front.name;
    }
  }
  EXPECT_TRUE(MeshPattern(*graded, 0.01).ok());
}

// Only one girth and one length are stated, as many shops do: the rest follows.
TEST_P(GradeEveryKind, LetsTheRestFollowWhatIsGiven) {
  const GarmentPattern photographed = Reconciled(GetParam());
  const Measures measured = MeasureAgain(photographed);
  const std::string girth = IsBottom(GetParam()) ? "hip_width" : "chest_width";
  GarmentSize from{"M", {{girth, measured.at(girth), Provenance::kStated}}, {}};
  GarmentSize to{"L", {{girth, 1.1 * measured.at(girth), Provenance::kStated}}, {}};
  const Result<GradedPattern> graded = GradePatternInDetail(photographed, from, to);
  ASSERT_TRUE(graded.ok()) << graded.status().ToString();
  const Measures after = MeasureAgain(graded->pattern);
  EXPECT_NEAR(after.at("waist_width") / measured.at("waist_width"), 1.1, 1e-3);
  EXPECT_NEAR(after.at("hem_width") / measured.at("hem_width"), 1.1, 1e-3);
  const std::string length = IsBottom(GetParam()) ? "length" : "front_length";
  EXPECT_NEAR(after.at(length) / measured.at(length), std::sqrt(1.1), 5e-3);
  for (const GradedMeasure& measure : graded->measures) EXPECT_EQ(measure.given, measure.name == girth);
}

GarmentSize With(GarmentSize size, const std::string& name, double value) {
  for (GarmentMeasure& measure : size.measures) {
    if (measure.name == name) measure.value = value;
  }
  return size;
}

TEST(Grade, RefusesAbsurdChartsAndSaysWhy) {
  const GarmentPattern shirt = Reconciled(GarmentKind::kTShirt);
  const Measures measured = MeasureAgain(shirt);
  const GarmentSize from = Size(measured, 0), to = Size(measured, 1);
  const auto reason = [&](const GarmentSize& a, const GarmentSize& b) {
    const Status status = GradePattern(shirt, a, b).status();
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.message().find("chart"), std::string::npos) << status.ToString();
    return status.reason();
  };
  EXPECT_EQ(reason(from, With(to, "hem_width", 0.25 * 0.04)), "CHART_MEASURE_ABSURD");
  EXPECT_EQ(reason(from, With(to, "chest_width", 3.1 * measured.at("chest_width"))), "CHART_MEASURE_ABSURD");
  EXPECT_EQ(reason(from, With(to, "chest_width", std::nan(""))), "CHART_MEASURE_ABSURD");
  EXPECT_EQ(reason(from, With(to, "chest_width", -0.5)), "CHART_MEASURE_ABSURD");
  EXPECT_EQ(reason(from, With(to, "chest_width", 1e300)), "CHART_MEASURE_ABSURD");
  EXPECT_EQ(reason(With(from, "sleeve_length", 6.0 * measured.at("sleeve_length")), to),
            "CHART_CONTRADICTS_PHOTOGRAPHS");
  EXPECT_EQ(reason({"M", {}, {}}, to), "CHART_WITHOUT_COMMON_MEASURES");
  EXPECT_EQ(reason(from, {"L", {}, {}}), "CHART_WITHOUT_COMMON_MEASURES");

  // Shoulders far wider than the chest is deep and a length that leaves no room below the arms.
  GarmentSize short_and_wide = With(With(to, "front_length", 0.25), "back_length", 0.25);
  short_and_wide = With(short_and_wide, "chest_width", 1.2);
  const std::string short_reason = reason(from, short_and_wide);
  EXPECT_TRUE(short_reason == "CHART_INVERTS_OUTLINE" || short_reason == "CHART_CONTRADICTORY") << short_reason;
}

TEST(Grade, RefusesAHemThatNoFootGetsThrough) {
  const GarmentPattern trousers = Reconciled(GarmentKind::kPants);
  const Measures measured = MeasureAgain(trousers);
  // The legs of the drawing are wide: by steps down to 39 mm.
  GarmentPattern narrow = trousers;
  GarmentSize from = Size(measured, 0);
  const double hem = measured.at("hem_width");
  ASSERT_GT(hem, 0.1);
  Result<GarmentPattern> first = GradePattern(narrow, from, With(from, "hem_width", 0.09));
  ASSERT_TRUE(first.ok()) << first.status().ToString();
  from = With(from, "hem_width", 0.09);
  EXPECT_EQ(GradePattern(*first, from, With(from, "hem_width", 0.039)).status().reason(), "CHART_OPENING_TOO_NARROW");
}

// Length, inseam and rise are three measures of two lengths.
TEST(Grade, RefusesARiseThatLengthAndInseamLeaveNoRoomFor) {
  const GarmentPattern trousers = Reconciled(GarmentKind::kPants);
  const Measures measured = MeasureAgain(trousers);
  GarmentSize from = Size(measured, 0), to = Size(measured, 1);
  from.measures.push_back({"front_rise", 0.27, Provenance::kStated});
  to.measures.push_back({"front_rise", 0.28, Provenance::kStated});
  EXPECT_TRUE(GradePattern(trousers, from, to).ok());
  to = With(to, "front_rise", 0.36);
  const Status status = GradePattern(trousers, from, to).status();
  EXPECT_EQ(status.reason(), "CHART_CONTRADICTORY");
  EXPECT_NE(status.message().find("front_rise"), std::string::npos);
}

// Girths under the names of flat widths: the ratio is what counts.
TEST(Grade, TakesTheRatioWhereTheChartMeasuresSomethingElse) {
  const GarmentPattern shirt = Reconciled(GarmentKind::kTShirt);
  const double chest = MeasureAgain(shirt).at("chest_width");
  const GarmentSize from{"M", {{"chest_width", 2.0 * chest, Provenance::kStated}}, {}};
  const GarmentSize to{"L", {{"chest_width", 2.1 * chest, Provenance::kStated}}, {}};
  const Result<GarmentPattern> graded = GradePattern(shirt, from, to);
  ASSERT_TRUE(graded.ok()) << graded.status().ToString();
  EXPECT_NEAR(MeasureAgain(*graded).at("chest_width"), 1.05 * chest, 0.002);
}

}  // namespace
}  // namespace fitroom
