#include "fit_client/fit/panels/sleeve_weights.h"

#include <algorithm>
#include <string>

#include "common/base/check.h"
#include "fit_client/fit/panels/outline_layout.h"

namespace fitroom::panels {
namespace {

constexpr double kBlendWidth = 0.06;  // (unit: metre)

}  // namespace

SleeveWeight::SleeveWeight(const PanelPattern& panel, GarmentKind kind, bool left) {
  if (!HasSleeves(kind)) return;
  const std::string tip_name = ShoulderTipName(kind, left);
  const Eigen::Vector2d* tip = FindPatternPoint(panel, tip_name);
  const Eigen::Vector2d* underarm = FindPatternPoint(panel, left ? "underarm_L" : "underarm_R");
  const OutlineSection* shoulder = FindSection(panel, left ? "shoulder_L" : "shoulder_R");
  const OutlineSection* end = FindSection(panel, left ? "sleeve_end_L" : "sleeve_end_R");
  const OutlineSection* underside = FindSection(panel, left ? "underside_L" : "underside_R");
  FR_CHECK(tip && underarm && shoulder && end && underside);
  shoulder_tip_ = *tip;
  underarm_ = *underarm;
  // Counter-clockwise the sleeve runs underarm, end bottom, end top, tip on the left; tip, top, bottom, underarm right.
  std::ptrdiff_t tip_index = 0;
  for (const SectionKnot& knot : shoulder->knots) {
    if (knot.name == tip_name) tip_index = knot.index;
  }
  const auto append = [&](auto from, auto to) { sleeve_.insert(sleeve_.end(), from, to); };
  if (left) {
    append(underside->points.begin(), underside->points.end());
    append(end->points.begin() + 1, end->points.end());
    append(shoulder->points.begin() + 1, shoulder->points.begin() + tip_index + 1);
  } else {
    append(shoulder->points.begin() + tip_index, shoulder->points.end());
    append(end->points.begin() + 1, end->points.end());
    append(underside->points.begin() + 1, underside->points.end());
  }
  for (const Eigen::Vector2d& p : sleeve_) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
}

double SleeveWeight::At(const Eigen::Vector2d& point) const {
  // Also a kind without sleeves: its box is empty.
  if ((point.array() < low_.array() - kBlendWidth).any() || (point.array() > high_.array() + kBlendWidth).any()) {
    return 0.0;
  }
  const double distance = DistanceToSegment(point, shoulder_tip_, underarm_);
  // The outline itself may lie a rounding error outside the sleeve: only near the armhole does the sign matter there.
  const double inside = PolygonContains(sleeve_, point) || DistanceToChain(point, sleeve_) < 1e-6 ? 1.0 : -1.0;
  const double t = std::clamp(0.5 + inside * distance / kBlendWidth, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace fitroom::panels
