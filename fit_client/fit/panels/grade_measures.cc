#include "fit_client/fit/panels/grade_measures.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {
namespace {

const Eigen::Vector2d& At(const PanelPattern& panel, const std::string& name) {
  const Eigen::Vector2d* point = FindPatternPoint(panel, name);
  FR_CHECK(point != nullptr);
  return *point;
}

double Distance(const PanelPattern& panel, const std::string& a, const std::string& b) {
  return (At(panel, a) - At(panel, b)).norm();
}

// The length of the section that runs through both points, between them.
double LengthAlong(const PanelPattern& panel, const std::string& a, const std::string& b) {
  for (const OutlineSection& section : panel.sections) {
    int from = -1, to = -1;
    for (const SectionKnot& knot : section.knots) {
      if (knot.name == a) from = knot.index;
      if (knot.name == b) to = knot.index;
    }
    if (from < 0 || to < 0) continue;
    if (from > to) std::swap(from, to);
    return ChainLength(
        std::span(section.points).subspan(static_cast<size_t>(from), static_cast<size_t>(to - from + 1)));
  }
  FR_CHECK(false);
  return 0.0;
}

// From the shoulder's highest point straight down to the hem.
double TopLength(const PanelPattern& panel) {
  Eigen::Vector2d highest = At(panel, "P2");
  for (const OutlineSection& section : panel.sections) {
    for (const Eigen::Vector2d& p : section.points) {
      if (p.y() > highest.y()) highest = p;
    }
  }
  const OutlineSection* hem = FindSection(panel, "hem");
  FR_CHECK(hem != nullptr);
  std::vector<double> across;
  for (const Eigen::Vector2d& p : hem->points)
    across.push_back(across.empty() ? p.x() : std::max(p.x(), across.back()));
  return highest.y() - InterpolateChain(hem->points, across, highest.x()).y();
}

void MeasureTop(const GarmentPattern& pattern, MeasureMap& measures) {
  const PanelPattern& front = pattern.front;
  measures["neck_width"] = Distance(front, "P1", "P2");
  measures["chest_width"] = Distance(front, "underarm_L", "underarm_R");
  measures["waist_width"] = Distance(front, "waist_L", "waist_R");
  measures["hip_width"] = Distance(front, "hip_L", "hip_R");
  measures["hem_width"] = Distance(front, "hem_L", "hem_R");
  measures["front_length"] = TopLength(front);
  measures["back_length"] = TopLength(pattern.back);
  const bool is_dress = pattern.kind == GarmentKind::kOnePiece || pattern.kind == GarmentKind::kSleevedOnePiece;
  const std::string tip_L = is_dress ? "e2" : "e3", tip_R = is_dress ? "e6" : "e7";
  measures["shoulder_width"] = Distance(front, tip_L, tip_R);
  if (!HasSleeves(pattern.kind)) return;
  const std::string end_L = is_dress ? "sleeve_top_L" : "e4", end_R = is_dress ? "sleeve_top_R" : "e8";
  measures["sleeve_length"] = 0.5 * (LengthAlong(front, tip_L, end_L) + LengthAlong(front, tip_R, end_R));
  measures["sleeve_opening"] =
      0.5 * (Distance(front, end_L, "sleeve_bottom_L") + Distance(front, end_R, "sleeve_bottom_R"));
}

void MeasureBottom(const GarmentPattern& pattern, MeasureMap& measures) {
  const PanelPattern& front = pattern.front;
  measures["waist_width"] = Distance(front, "e1", "e3");
  measures["hip_width"] = Distance(front, "hip_L", "hip_R");
  measures["length"] =
      0.5 * (At(front, "e1").y() + At(front, "e3").y()) - 0.5 * (At(front, "e2").y() + At(front, "e4").y());
  if (pattern.kind == GarmentKind::kSkirt) {
    measures["hem_width"] = Distance(front, "e2", "e4");
    return;
  }
  measures["thigh_width"] =
      0.5 * (Distance(front, "crotch", "crotch_level_L") + Distance(front, "crotch", "crotch_level_R"));
  measures["knee_width"] =
      0.5 * (Distance(front, "knee_outer_L", "knee_inner_L") + Distance(front, "knee_outer_R", "knee_inner_R"));
  measures["hem_width"] = 0.5 * (Distance(front, "e2", "hem_inner_L") + Distance(front, "e4", "hem_inner_R"));
  measures["inseam"] =
      0.5 * (LengthAlong(front, "crotch", "hem_inner_L") + LengthAlong(front, "crotch", "hem_inner_R"));
  measures["front_rise"] = Distance(front, "waist_centre", "crotch");
  measures["back_rise"] = Distance(pattern.back, "waist_centre", "crotch");
}

}  // namespace

MeasureMap MeasureByName(const GarmentPattern& pattern) {
  MeasureMap measures;
  if (IsBottom(pattern.kind)) {
    MeasureBottom(pattern, measures);
  } else {
    MeasureTop(pattern, measures);
  }
  return measures;
}

}  // namespace fitroom::panels
