#include "fit_client/fit/panels/closed_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fitroom::panels {
namespace {

constexpr size_t kMaxCandidates = 6;  // Places tried for one point.
constexpr int kNotchSamples = 500;    // Along a chain in which notches are looked for.

OutlinePosition PositionOnSegment(const ClosedOutline& outline, size_t i, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = outline.closed[i] - outline.closed[i - 1];
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - outline.closed[i - 1]).dot(along) / squared, 0.0, 1.0) : 0.0;
  return {outline.arcs[i - 1] + t * std::sqrt(squared), (point - outline.closed[i - 1] - t * along).norm()};
}

// The places nearest to a point that are at least half a tolerance apart along the outline, the nearest first.
std::vector<OutlinePosition> Candidates(const ClosedOutline& outline, const Eigen::Vector2d& point, double tolerance) {
  std::vector<OutlinePosition> near;
  for (size_t i = 1; i < outline.closed.size(); ++i) {
    const OutlinePosition position = PositionOnSegment(outline, i, point);
    if (position.distance <= tolerance) near.push_back(position);
  }
  std::sort(near.begin(), near.end(), [](const OutlinePosition& a, const OutlinePosition& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.arc < b.arc;
  });
  std::vector<OutlinePosition> candidates;
  for (const OutlinePosition& position : near) {
    if (candidates.size() == kMaxCandidates) break;
    const bool taken = std::any_of(candidates.begin(), candidates.end(), [&](const OutlinePosition& other) {
      const double apart = std::abs(position.arc - other.arc);
      return std::min(apart, outline.perimeter() - apart) < 0.5 * tolerance;
    });
    if (!taken) candidates.push_back(position);
  }
  return candidates;
}

struct Way {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<double> arcs;
};

// The best way round from a place of the first point.
Way BestWay(const std::vector<std::vector<OutlinePosition>>& candidates, const OutlinePosition& start,
            double perimeter) {
  std::vector<Way> ways = {{start.distance * start.distance, {start.arc}}};
  for (size_t k = 1; k < candidates.size(); ++k) {
    std::vector<Way> longer;
    for (const OutlinePosition& candidate : candidates[k]) {
      const double arc = candidate.arc < start.arc ? candidate.arc + perimeter : candidate.arc;
      const Way* best = nullptr;
      for (const Way& way : ways) {
        if (way.arcs.back() <= arc && (best == nullptr || way.cost < best->cost)) best = &way;
      }
      if (best == nullptr) continue;
      longer.push_back(*best);
      longer.back().cost += candidate.distance * candidate.distance;
      longer.back().arcs.push_back(arc);
    }
    ways = std::move(longer);
  }
  Way best;
  for (Way& way : ways) {
    if (way.cost < best.cost) best = std::move(way);
  }
  return best;
}

}  // namespace

ClosedOutline CloseOutline(const GarmentView& view) {
  ClosedOutline outline;
  for (const Eigen::Vector2d& p : view.outline) {
    if (outline.closed.empty() || (p - outline.closed.back()).norm() > 1e-9) outline.closed.push_back(p);
  }
  // Turning the y axis over makes clockwise on the screen counter-clockwise; the back is mirrored once more.
  const bool screen_clockwise = SignedArea(outline.closed) > 0.0;
  if (screen_clockwise == (view.side == GarmentSide::kFront)) {
    std::reverse(outline.closed.begin(), outline.closed.end());
  }
  outline.closed.push_back(outline.closed.front());
  outline.arcs = CumulativeLengths(outline.closed);
  return outline;
}

OutlinePosition NearestPosition(const ClosedOutline& outline, const Eigen::Vector2d& point) {
  OutlinePosition best;
  for (size_t i = 1; i < outline.closed.size(); ++i) {
    const OutlinePosition position = PositionOnSegment(outline, i, point);
    if (position.distance < best.distance) best = position;
  }
  return best;
}

Polyline CutChain(const ClosedOutline& outline, double from, double to) {
  const double perimeter = outline.perimeter();
  const auto at = [&](double arc) { return InterpolateChain(outline.closed, outline.arcs, std::fmod(arc, perimeter)); };
  Polyline chain = {at(from)};
  for (double lap : {0.0, perimeter}) {
    for (size_t i = 0; i + 1 < outline.closed.size(); ++i) {
      const double arc = outline.arcs[i] + lap;
      if (arc > from + 1e-9 && arc < to - 1e-9) chain.push_back(outline.closed[i]);
    }
  }
  chain.push_back(at(to));
  return chain;
}

std::optional<std::vector<double>> PlaceInOrder(const ClosedOutline& outline, const Polyline& points,
                                                double tolerance) {
  std::vector<std::vector<OutlinePosition>> candidates;
  for (const Eigen::Vector2d& point : points) {
    candidates.push_back(Candidates(outline, point, tolerance));
    if (candidates.back().empty()) return std::nullopt;
  }
  Way best;
  for (const OutlinePosition& start : candidates.front()) {
    Way way = BestWay(candidates, start, outline.perimeter());
    if (way.cost < best.cost) best = std::move(way);
  }
  if (best.arcs.empty()) return std::nullopt;
  return best.arcs;
}

void BridgeNotches(double mouth, double excess, Polyline& chain, std::vector<double>& knot_arcs) {
  const std::vector<double> arcs = CumulativeLengths(chain);
  const double length = arcs.back();
  if (length <= excess) return;
  const Polyline samples = ResampleChain(chain, kNotchSamples);
  const double step = length / kNotchSamples;
  Polyline bridged = {chain.front()};
  std::vector<double> moved = knot_arcs;
  double cut = 0.0;  // How much shorter the chain has become.
  size_t next_point = 1;
  for (size_t i = 0; i < samples.size();) {
    // The far side of a notch that begins here: the last sample near enough.
    size_t far = 0;
    for (size_t j = i + 1; j < samples.size(); ++j) {
      const double gap = (samples[j] - samples[i]).norm();
      if (gap <= mouth && static_cast<double>(j - i) * step - gap >= excess) far = j;
    }
    const double from = static_cast<double>(i) * step;
    for (; next_point + 1 < chain.size() && arcs[next_point] < from; ++next_point) bridged.push_back(chain[next_point]);
    if (far == 0) {
      ++i;
      continue;
    }
    const double to = static_cast<double>(far) * step;
    const double gap = (samples[far] - samples[i]).norm();
    bridged.push_back(samples[i]);
    if (far + 1 < samples.size()) bridged.push_back(samples[far]);
    while (next_point + 1 < chain.size() && arcs[next_point] <= to) ++next_point;
    for (size_t k = 0; k < knot_arcs.size(); ++k) {
      if (knot_arcs[k] >= to) {
        moved[k] -= to - from - gap;
      } else if (knot_arcs[k] > from) {
        moved[k] = from - cut + (knot_arcs[k] - from) / (to - from) * gap;
      }
    }
    cut += to - from - gap;
    i = far;
  }
  for (; next_point < chain.size(); ++next_point) bridged.push_back(chain[next_point]);
  if (cut == 0.0) return;
  chain = std::move(bridged);
  knot_arcs = std::move(moved);
}

}  // namespace fitroom::panels
