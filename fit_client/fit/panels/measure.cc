#include "fit_client/fit/panels/measure.h"

#include <algorithm>
#include <string>

#include "common/base/check.h"
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

double GirthBetween(const PanelPattern& panel, const std::string& point) {
  return 2.0 * (PointOf(panel, point + "_L") - PointOf(panel, point + "_R")).norm();
}

// The shoulder section's part from the shoulder tip to the sleeve's end.
panels::Polyline SleeveTop(const PanelPattern& panel, bool left) {
  const OutlineSection& shoulder = SectionOf(panel, left ? "shoulder_L" : "shoulder_R");
  std::ptrdiff_t tip = 0;
  for (const SectionKnot& knot : shoulder.knots) {
    if (knot.name == (left ? "e3" : "e7")) tip = knot.index;
  }
  const auto begin = shoulder.points.begin();
  return left ? panels::Polyline(begin, begin + tip + 1) : panels::Polyline(begin + tip, shoulder.points.end());
}

}  // namespace

double MeasureLength(const PanelPattern& panel) {
  const std::vector<Eigen::Vector2d> outline = JoinedPoints(panel);
  const auto lower = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); };
  const Eigen::Vector2d top = *std::max_element(outline.begin(), outline.end(), lower);
  const std::vector<Eigen::Vector2d>& hem = SectionOf(panel, "hem").points;
  std::vector<double> across;
  for (const Eigen::Vector2d& p : hem) across.push_back(across.empty() ? p.x() : std::max(p.x(), across.back()));
  return top.y() - panels::InterpolateChain(hem, across, top.x()).y();
}

GarmentMeasures MeasurePattern(const GarmentPattern& pattern) {
  const PanelPattern& front = pattern.front;
  GarmentMeasures measures;
  measures.length = 0.5 * (MeasureLength(pattern.front) + MeasureLength(pattern.back));
  measures.bust_girth = GirthBetween(front, "underarm");
  measures.waist_girth = GirthBetween(front, "waist");
  measures.hip_girth = GirthBetween(front, "hip");
  measures.hem_girth = GirthBetween(front, "hem");
  measures.shoulder_width = (PointOf(front, "e3") - PointOf(front, "e7")).norm();
  for (bool left : {true, false}) {
    const panels::Polyline top = SleeveTop(front, left);
    const Eigen::Vector2d& underarm = PointOf(front, left ? "underarm_L" : "underarm_R");
    measures.sleeve_length += 0.5 * panels::ChainLength(top);
    measures.upper_arm_girth += panels::DistanceToChain(underarm, top);
    measures.side_seam_length += 0.5 * panels::ChainLength(SectionOf(front, left ? "side_L" : "side_R").points);
  }
  for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
    measures.neck_opening += panels::ChainLength(SectionOf(*panel, "neck").points);
  }
  return measures;
}

}  // namespace fitroom
