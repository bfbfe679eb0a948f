#include <algorithm>
#include <cmath>

#include "fit_client/fit/grading/grade_moves.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/view_samples.h"

namespace fitroom::grading {
namespace {

// A moved point of a section: the number of its sample and its displacement.
struct Node {
  int index = 0;
  Eigen::Vector2d move = Eigen::Vector2d::Zero();
};

std::vector<Node> NodesOf(const OutlineSection& section, const GradeMoves& moves,
                          const std::map<std::string, Eigen::Vector2d>& own) {
  std::vector<Node> nodes;
  for (const SectionKnot& knot : section.knots) {
    auto found = own.find(knot.name);
    if (found == own.end()) {
      found = moves.shared.find(knot.name);
      if (found == moves.shared.end()) continue;
    }
    // Two points may share a sample; a corner wins over its neighbour.
    const bool same = !nodes.empty() && nodes.back().index == knot.index;
    if (!same) nodes.push_back({knot.index, found->second});
    if (same && static_cast<size_t>(knot.index) + 1 == section.points.size()) nodes.back().move = found->second;
  }
  return nodes;
}

// Slopes at the nodes by the harmonic mean of Fritsch and Butland: 0 at an extreme, so that nothing overshoots; at the
// ends those of the intervals.
std::vector<double> Slopes(const std::vector<Node>& nodes, int axis) {
  const size_t count = nodes.size();
  std::vector<double> secants(count - 1), slopes(count);
  for (size_t i = 0; i + 1 < count; ++i) {
    secants[i] = (nodes[i + 1].move[axis] - nodes[i].move[axis]) / (nodes[i + 1].index - nodes[i].index);
  }
  slopes.front() = secants.front();
  slopes.back() = secants.back();
  for (size_t i = 1; i + 1 < count; ++i) {
    const double before = secants[i - 1], after = secants[i];
    if (before * after > 0.0) slopes[i] = 2.0 * before * after / (before + after);
  }
  return slopes;
}

void MoveSection(const std::vector<Node>& nodes, panels::Polyline& points) {
  if (nodes.empty()) return;
  if (nodes.size() == 1) {
    for (Eigen::Vector2d& p : points) p += nodes[0].move;
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const std::vector<double> slopes = Slopes(nodes, axis);
    for (size_t n = 0; n + 1 < nodes.size(); ++n) {
      const int first = nodes[n].index, last = nodes[n + 1].index;
      const double span = last - first;
      const double a = nodes[n].move[axis], b = nodes[n + 1].move[axis];
      for (int i = n == 0 ? first : first + 1; i <= last; ++i) {
        const double t = (i - first) / span, s = 1.0 - t;
        // Cubic Hermite; at t = 0 and 1 exactly a and b.
        points[static_cast<size_t>(i)][axis] += a * s * s * (1.0 + 2.0 * t) + b * t * t * (1.0 + 2.0 * s) +
                                                span * t * s * (slopes[n] * s - slopes[n + 1] * t);
      }
    }
  }
}

std::string TwinSection(const std::string& name) {
  std::string twin = name;
  if (name.ends_with("_L")) twin.back() = 'R';
  if (name.ends_with("_R")) twin.back() = 'L';
  return twin;
}

// The twin of each section where it is its exact mirror image, -1 elsewhere.
std::vector<int> ExactTwins(const PanelPattern& panel) {
  std::vector<int> twins(panel.sections.size(), -1);
  for (size_t s = 0; s < panel.sections.size(); ++s) {
    const std::string name = TwinSection(panel.sections[s].name);
    for (size_t t = 0; t < panel.sections.size(); ++t) {
      if (panel.sections[t].name == name && panels::Mirrored(panel.sections[t].points) == panel.sections[s].points) {
        twins[s] = static_cast<int>(t);
      }
    }
  }
  return twins;
}

void MovePanel(const GradeMoves& moves, const std::map<std::string, Eigen::Vector2d>& own, PanelPattern& panel) {
  const std::vector<int> twins = ExactTwins(panel);
  for (OutlineSection& section : panel.sections) MoveSection(NodesOf(section, moves, own), section.points);
  for (size_t s = 0; s < panel.sections.size(); ++s) {
    if (twins[s] < 0) continue;
    const size_t twin = static_cast<size_t>(twins[s]);
    panels::Polyline& points = panel.sections[s].points;
    const panels::Polyline mirrored = panels::Mirrored(panel.sections[twin].points);
    if (twin < s) points = mirrored;
    if (twin != s) continue;
    for (size_t i = 0; i < points.size(); ++i) points[i] = 0.5 * (points[i] + mirrored[i]);
  }
}

}  // namespace

GarmentPattern ApplyMoves(const GarmentPattern& pattern, const GradeMoves& moves) {
  GarmentPattern moved = pattern;
  MovePanel(moves, moves.front_only, moved.front);
  MovePanel(moves, moves.back_only, moved.back);
  return moved;
}

}  // namespace fitroom::grading
