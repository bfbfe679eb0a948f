#include "fit_client/fit/panels/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/base/check.h"
#include "fit_client/fit/panels/outline_layout.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom {
namespace {

const Eigen::Vector2d& PointOf(const PanelPattern& panel, const std::string& name) {
  const Eigen::Vector2d* point = FindPatternPoint(panel, name);
  FR_CHECK(point != nullptr);
  return *point;
}

const OutlineSection& SectionOf(const PanelPattern& panel, const std::string& name) {
  const OutlineSection* section = FindSection(panel, name);
  FR_CHECK(section != nullptr);
  return *section;
}

double Distance(const PanelPattern& panel, const std::string& a, const std::string& b) {
  return (PointOf(panel, a) - PointOf(panel, b)).norm();
}

// The mean of both sides of a distance between two points whose names end in _L and _R.
double MeanDistance(const PanelPattern& panel, const std::string& a, const std::string& b) {
  return 0.5 * (Distance(panel, a + "_L", b + "_L") + Distance(panel, a + "_R", b + "_R"));
}

double MeanLevel(const PanelPattern& panel, const std::string& name) {
  return 0.5 * (PointOf(panel, name + "_L").y() + PointOf(panel, name + "_R").y());
}

// The panel's width at a height: between the outermost crossings of the seams that run down its sides, sleeves apart.
// Seams are shared by both panels.
double WidthAtLevel(const GarmentPattern& pattern, double level) {
  double width = 0.0;
  const std::string seam = HasLegs(pattern.kind) ? "outseam" : "side";
  for (const bool left : {true, false}) {
    const std::vector<Eigen::Vector2d>& side = SectionOf(pattern.front, seam + (left ? "_L" : "_R")).points;
    double best = std::numeric_limits<double>::infinity(), reach = 0.0;
    for (size_t i = 1; i < side.size(); ++i) {
      const Eigen::Vector2d& a = side[i - 1];
      const Eigen::Vector2d& b = side[i];
      const double rise = b.y() - a.y();
      const double t = rise == 0.0 ? 0.0 : std::clamp((level - a.y()) / rise, 0.0, 1.0);
      const Eigen::Vector2d nearest = a + t * (b - a);
      if (std::abs(nearest.y() - level) >= best) continue;
      best = std::abs(nearest.y() - level);
      reach = nearest.x();
    }
    width += left ? reach : -reach;
  }
  return width;
}

// The shoulder section's part from the shoulder tip to the sleeve's end.
double SleeveTopLength(const GarmentPattern& pattern, bool left) {
  const OutlineSection& shoulder = SectionOf(pattern.front, left ? "shoulder_L" : "shoulder_R");
  const std::string tip_name = panels::ShoulderTipName(pattern.kind, left);
  std::ptrdiff_t tip = 0;
  for (const SectionKnot& knot : shoulder.knots) {
    if (knot.name == tip_name) tip = knot.index;
  }
  const auto begin = shoulder.points.begin();
  return panels::ChainLength(left ? panels::Polyline(begin, begin + tip + 1)
                                  : panels::Polyline(begin + tip, shoulder.points.end()));
}

double SleeveOpening(const PanelPattern& panel, bool left) {
  const std::vector<Eigen::Vector2d>& end = SectionOf(panel, left ? "sleeve_end_L" : "sleeve_end_R").points;
  return (end.front() - end.back()).norm();
}

double HemWidth(const GarmentPattern& pattern) {
  const PanelPattern& front = pattern.front;
  if (HasLegs(pattern.kind)) {
    return 0.5 * (Distance(front, "e2", "hem_inner_L") + Distance(front, "e4", "hem_inner_R"));
  }
  return IsBottom(pattern.kind) ? Distance(front, "e2", "e4") : Distance(front, "hem_L", "hem_R");
}

// From the highest point of the shoulders straight down to the hem.
double PanelLength(const PanelPattern& panel) {
  const auto lower = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); };
  const std::vector<Eigen::Vector2d>& left = SectionOf(panel, "shoulder_L").points;
  const std::vector<Eigen::Vector2d>& right = SectionOf(panel, "shoulder_R").points;
  const Eigen::Vector2d top = std::max(*std::max_element(left.begin(), left.end(), lower),
                                       *std::max_element(right.begin(), right.end(), lower), lower);
  const std::vector<Eigen::Vector2d>& hem = SectionOf(panel, "hem").points;
  std::vector<double> across;
  for (const Eigen::Vector2d& p : hem) across.push_back(across.empty() ? p.x() : std::max(p.x(), across.back()));
  return top.y() - panels::InterpolateChain(hem, across, top.x()).y();
}

double VisibleRise(const PanelPattern& panel) {
  return PointOf(panel, "waist_centre").y() - PointOf(panel, "crotch").y();
}

// Square to the leg, which may lie aslant.
double KneeWidth(const PanelPattern& panel, const std::string& side) {
  const Eigen::Vector2d top = 0.5 * (PointOf(panel, "crotch") + PointOf(panel, "crotch_level" + side));
  const Eigen::Vector2d along = (PointOf(panel, "hem_mid" + side) - top).normalized();
  const Eigen::Vector2d across = PointOf(panel, "knee_outer" + side) - PointOf(panel, "knee_inner" + side);
  return std::abs(across.x() * along.y() - across.y() * along.x());
}

double Measure(const GarmentPattern& pattern, const std::string& name) {
  const PanelPattern& front = pattern.front;
  const GarmentKind kind = pattern.kind;
  if (name == "shoulder_width") {
    return Distance(front, panels::ShoulderTipName(kind, true), panels::ShoulderTipName(kind, false));
  }
  if (name == "chest_width") return WidthAtLevel(pattern, MeanLevel(front, "underarm") - kChestBelowUnderarm);
  if (name == "waist_width")
    return IsBottom(kind) ? Distance(front, "e1", "e3") : WidthAtLevel(pattern, MeanLevel(front, "waist"));
  if (name == "hip_width") return WidthAtLevel(pattern, MeanLevel(front, "hip"));
  if (name == "hem_width") return HemWidth(pattern);
  if (name == "sleeve_length") return 0.5 * (SleeveTopLength(pattern, true) + SleeveTopLength(pattern, false));
  if (name == "sleeve_opening") return 0.5 * (SleeveOpening(front, true) + SleeveOpening(front, false));
  if (name == "neck_width") return Distance(front, "P1", "P2");
  if (name == "front_length") return PanelLength(pattern.front);
  if (name == "back_length") return PanelLength(pattern.back);
  if (name == "length") return MeasureLength(pattern);
  if (name == "thigh_width") return MeanDistance(front, "thigh_outer", "thigh_inner");
  if (name == "knee_width") return 0.5 * (KneeWidth(front, "_L") + KneeWidth(front, "_R"));
  if (name == "front_rise") return VisibleRise(pattern.front);
  if (name == "back_rise") return VisibleRise(pattern.back);
  FR_CHECK(name == "inseam");
  return 0.5 * (panels::ChainLength(SectionOf(front, "inseam_L").points) +
                panels::ChainLength(SectionOf(front, "inseam_R").points));
}

}  // namespace

double MeasureLength(const GarmentPattern& pattern) {
  const PanelPattern& front = pattern.front;
  const bool bottom = IsBottom(pattern.kind);
  const double left = PointOf(front, bottom ? "e1" : "P2").y() - PointOf(front, bottom ? "e2" : "hem_L").y();
  const double right = PointOf(front, bottom ? "e3" : "P1").y() - PointOf(front, bottom ? "e4" : "hem_R").y();
  return 0.5 * (left + right);
}

std::vector<GarmentMeasure> MeasurePattern(const GarmentPattern& pattern) {
  std::vector<GarmentMeasure> measures;
  for (const std::string& name : MeasureNames(pattern.kind)) {
    const bool hidden = name == "front_rise" || name == "back_rise" || name == "thigh_width";
    measures.push_back({name, Measure(pattern, name), hidden ? Provenance::kUnknown : Provenance::kMeasured});
  }
  return measures;
}

double MeasureValue(const std::vector<GarmentMeasure>& measures, std::string_view name) {
  const GarmentMeasure* measure = FindMeasure(measures, name);
  return measure == nullptr ? std::numeric_limits<double>::quiet_NaN() : measure->value;
}

}  // namespace fitroom
