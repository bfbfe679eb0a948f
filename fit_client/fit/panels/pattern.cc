#include "fit_client/fit/panels/pattern.h"

namespace fitroom {
namespace {

std::vector<Eigen::Vector2d> Join(const PanelPattern& panel, std::vector<Eigen::Vector2d> OutlineSection::*chain) {
  std::vector<Eigen::Vector2d> joined;
  for (const OutlineSection& section : panel.sections) {
    const std::vector<Eigen::Vector2d>& points = section.*chain;
    if (!points.empty()) joined.insert(joined.end(), points.begin(), points.end() - 1);
  }
  return joined;
}

}  // namespace

std::vector<Eigen::Vector2d> JoinedPoints(const PanelPattern& panel) { return Join(panel, &OutlineSection::points); }

std::vector<Eigen::Vector2d> JoinedPixels(const PanelPattern& panel) { return Join(panel, &OutlineSection::pixels); }

const OutlineSection* FindSection(const PanelPattern& panel, std::string_view name) {
  for (const OutlineSection& section : panel.sections) {
    if (section.name == name) return &section;
  }
  return nullptr;
}

const Eigen::Vector2d* FindPatternPoint(const PanelPattern& panel, std::string_view name) {
  for (const OutlineSection& section : panel.sections) {
    for (const SectionKnot& knot : section.knots) {
      if (knot.name == name) return &section.points[static_cast<size_t>(knot.index)];
    }
  }
  return nullptr;
}

}  // namespace fitroom
