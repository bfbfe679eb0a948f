#include "fit_client/fit/panels/view_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "fit_client/fit/panels/closed_outline.h"
#include "fit_client/fit/panels/outline_layout.h"

namespace fitroom::panels {
namespace {

constexpr size_t kMaxOutlinePoints = 1'000'000;
// How far a point may lie from the outline and be moved onto it, and how far inside it the middle of the neck or waist
// may lie and still count as on it (share of the garment's length).
constexpr double kMaxPointOffset = 0.04;
constexpr double kMiddleOnOutline = 0.012;
// How far two neighbouring points may stand in the wrong order and be taken as one place (share of the length): a hand
// that clicks P2 and e1 does that.
constexpr double kOrderSlack = 0.02;
// A slit in the hem: narrower than this where it opens, and at least this much of a detour (share of the length).
constexpr double kSlitMouth = 0.05;
constexpr double kSlitDetour = 0.08;
// Standard deviation of the smoothing that removes the stairs of a mask (unit: pixel); small enough to stay within the
// two pixels by which a texture reaches beyond its outline.
constexpr double kJitterSigma = 1.2;
// The same for crumples, when arc length is measured (share of the garment's length).
constexpr double kCrumpleSigma = 0.02;

const char* SideName(GarmentSide side) { return side == GarmentSide::kFront ? "front" : "back"; }

Status CheckView(const GarmentView& view, double length) {
  const std::string place = SideName(view.side);
  if (view.outline.size() < 16 || view.outline.size() > kMaxOutlinePoints) {
    return InvalidArgument("BAD_OUTLINE", place + " view: the outline has " + std::to_string(view.outline.size()) +
                                              " points; extract the garment again");
  }
  for (const Eigen::Vector2d& p : view.outline) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6) {
      return InvalidArgument("BAD_OUTLINE", place + " view: the outline has a point that is not in any image");
    }
  }
  if (view.image_width <= 0 || view.image_height <= 0) {
    return InvalidArgument("BAD_OUTLINE", place + " view: the size of the photograph is not stated");
  }
  if (!(view.metre_per_pixel > 1e-6 && view.metre_per_pixel < 0.1)) {
    return InvalidArgument("BAD_SCALE", place + " view: metre_per_pixel is missing or absurd; give the length");
  }
  if (!(length > 0.15 && length < 2.0)) {
    return InvalidArgument("BAD_SCALE", "the garment's length must lie between 0.15 and 2 m");
  }
  return Status();
}

// Half an ellipse from the neck's one end through the drop to its other end, cut at the drop.
std::vector<Polyline> NeckEllipse(const Eigen::Vector2d& from, const Eigen::Vector2d& drop, const Eigen::Vector2d& to) {
  constexpr int kSteps = 24;
  const Eigen::Vector2d middle = 0.5 * (from + to);
  std::vector<Polyline> halves(2);
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = 0.5 * std::numbers::pi * (half + static_cast<double>(i) / kSteps);
      const Eigen::Vector2d point = middle + std::cos(angle) * (from - middle) + std::sin(angle) * (drop - middle);
      halves[static_cast<size_t>(half)].push_back(point);
    }
  }
  halves[0].front() = from;
  halves[0].back() = halves[1].front() = drop;
  halves[1].back() = to;
  return halves;
}

// The front edge of a neck or waist of which the outline shows the back edge: half an ellipse through a neck's drop,
// straight from point to point along a waist.
std::vector<Polyline> BridgeOpening(const GarmentView& view, const SectionLayout& section, const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& to) {
  if (section.name == "neck") return NeckEllipse(from, FindPoint(view, "neck_drop")->pixel, to);
  std::vector<Polyline> chains;
  Eigen::Vector2d before = from;
  for (size_t k = 1; k < section.knots.size(); ++k) {
    const Eigen::Vector2d after = k + 1 == section.knots.size() ? to : FindPoint(view, section.knots[k])->pixel;
    chains.push_back({before, after});
    before = after;
  }
  return chains;
}

Status OutOfOrder(const GarmentView& view, const std::string& before, const std::string& after) {
  return InvalidArgument("POINTS_OUT_OF_ORDER",
                         std::string(SideName(view.side)) + " view: " + after + " does not follow " + before +
                             " on the outline; move it, or swap left and right (they are the wearer's)");
}

using PositionsByName = std::map<std::string, OutlinePosition>;

// Finds the place on the outline of each of the layout's points.
Result<PositionsByName> LocatePoints(const GarmentView& view, const std::vector<SectionLayout>& layout,
                                     const ClosedOutline& outline, double length_in_pixels) {
  PositionsByName positions;
  for (const SectionLayout& section : layout) {
    for (const std::string& name : section.knots) {
      const OutlinePoint* point = FindPoint(view, name);
      if (point == nullptr || !point->pixel.allFinite()) {
        return InvalidArgument("POINT_MISSING", std::string(SideName(view.side)) + " view: point " + name +
                                                    " is missing; give it in an annotation");
      }
      positions[name] = NearestPosition(outline, point->pixel);
      const bool may_lie_inside =
          &section == &layout[0] && name != section.knots.front() && name != section.knots.back();
      if (!may_lie_inside && positions[name].distance > kMaxPointOffset * length_in_pixels) {
        return InvalidArgument("POINT_OFF_OUTLINE", std::string(SideName(view.side)) + " view: point " + name +
                                                        " lies off the outline; move it onto the garment's edge");
      }
    }
  }
  return positions;
}

// The knots of a section; of a bridged one, the first, only its ends.
std::vector<std::string> KnotsOnOutline(const std::vector<SectionLayout>& layout, size_t section, bool bridged) {
  const std::vector<std::string>& knots = layout[section].knots;
  if (section == 0 && bridged) return {knots.front(), knots.back()};
  return knots;
}

// Moves the points to the places where they follow each other round the outline; false if there are none.
bool PutInOrder(const GarmentView& view, const std::vector<SectionLayout>& layout, const ClosedOutline& outline,
                bool bridged, double length_in_pixels, PositionsByName& positions) {
  std::vector<std::string> names;
  Polyline points;
  for (size_t s = 0; s < layout.size(); ++s) {
    const std::vector<std::string> knots = KnotsOnOutline(layout, s, bridged);
    names.insert(names.end(), knots.begin(), knots.end() - 1);
  }
  for (const std::string& name : names) points.push_back(FindPoint(view, name)->pixel);
  const std::optional<std::vector<double>> arcs = PlaceInOrder(outline, points, kMaxPointOffset * length_in_pixels);
  if (!arcs) return false;
  for (size_t i = 0; i < names.size(); ++i) positions[names[i]].arc = (*arcs)[i];
  return true;
}

// Cuts one section, from arc to arc, at its knots; of a hem slits are cut out first.
std::vector<Polyline> CutSection(const ClosedOutline& outline, const SectionLayout& section,
                                 const std::vector<double>& knot_arcs, double length_in_pixels) {
  std::vector<Polyline> chains;
  if (section.name != "hem") {
    for (size_t k = 1; k < knot_arcs.size(); ++k) chains.push_back(CutChain(outline, knot_arcs[k - 1], knot_arcs[k]));
    return chains;
  }
  Polyline whole = CutChain(outline, knot_arcs.front(), knot_arcs.back());
  std::vector<double> knots = knot_arcs;
  for (double& arc : knots) arc -= knot_arcs.front();
  BridgeNotches(kSlitMouth * length_in_pixels, kSlitDetour * length_in_pixels, whole, knots);
  const std::vector<double> arcs = CumulativeLengths(whole);
  knots.back() = arcs.back();
  for (size_t k = 1; k < knots.size(); ++k) {
    Polyline part = {InterpolateChain(whole, arcs, knots[k - 1])};
    for (size_t i = 0; i < whole.size(); ++i) {
      if (arcs[i] > knots[k - 1] + 1e-9 && arcs[i] < knots[k] - 1e-9) part.push_back(whole[i]);
    }
    part.push_back(InterpolateChain(whole, arcs, knots[k]));
    chains.push_back(std::move(part));
  }
  return chains;
}

// Cuts the outline at its points, which have been placed on it. `bridged`: the first section is not on the outline.
Result<ViewOutline> CutAtPoints(const GarmentView& view, const std::vector<SectionLayout>& layout,
                                const ClosedOutline& outline, const PositionsByName& positions, bool bridged,
                                double length_in_pixels) {
  ViewOutline split{view.side, view.image_width, view.image_height, view.metre_per_pixel, {}};
  const double perimeter = outline.perimeter();
  const double start = positions.at(layout[0].knots[0]).arc;
  double arc = start;  // Grows monotonically from the first corner round to it again.
  for (size_t s = 0; s < layout.size(); ++s) {
    const std::vector<std::string> knots = KnotsOnOutline(layout, s, bridged);
    std::vector<double> knot_arcs = {arc};
    for (size_t k = 1; k < knots.size(); ++k) {
      double next = positions.at(knots[k]).arc;
      while (next < arc - kOrderSlack * length_in_pixels) next += perimeter;
      next = std::max(next, arc);
      const bool last = s + 1 == layout.size() && k + 1 == knots.size();
      if (last) next = start + perimeter;
      if (next < arc || next > start + perimeter + 1e-9) return OutOfOrder(view, knots[k - 1], knots[k]);
      knot_arcs.push_back(next);
      arc = next;
    }
    std::vector<Polyline> chains = CutSection(outline, layout[s], knot_arcs, length_in_pixels);
    if (s == 0 && bridged) {
      chains = BridgeOpening(view, layout[0], chains.front().front(), chains.front().back());
    }
    split.chains.push_back(std::move(chains));
  }
  return split;
}

}  // namespace

Result<ViewOutline> SplitOutline(const GarmentView& view, GarmentKind kind, double length) {
  FR_RETURN_IF_ERROR(CheckView(view, length));
  const ClosedOutline outline = CloseOutline(view);
  const double length_in_pixels = length / view.metre_per_pixel;
  const std::vector<SectionLayout>& layout = OutlineLayout(kind);
  // Also keeps what follows bounded: a garment's outline is five to eight times as long as the garment.
  if (outline.perimeter() < 2.0 * length_in_pixels || outline.perimeter() > 40.0 * length_in_pixels) {
    return InvalidArgument("BAD_OUTLINE", std::string(SideName(view.side)) +
                                              " view: the outline's perimeter does not fit the garment's length; check "
                                              "the length, or extract the garment again");
  }

  FR_ASSIGN_OR_RETURN(PositionsByName positions, LocatePoints(view, layout, outline, length_in_pixels));
  const std::string& middle = layout[0].knots[layout[0].knots.size() / 2];
  const bool bridged = positions[middle].distance > kMiddleOnOutline * length_in_pixels;
  Result<ViewOutline> split = CutAtPoints(view, layout, outline, positions, bridged, length_in_pixels);
  if (split.ok() || !PutInOrder(view, layout, outline, bridged, length_in_pixels, positions)) return split;
  return CutAtPoints(view, layout, outline, positions, bridged, length_in_pixels);
}

Polyline SampleChain(const Polyline& chain, int count, double length_in_pixels) {
  const double length = ChainLength(chain);
  if (count == 0 || length <= 0.0) return Polyline(static_cast<size_t>(count) + 1, chain.front());
  const int fine_count = std::clamp(static_cast<int>(std::ceil(length / (0.5 * kJitterSigma))), 2 * count, 20'000);
  const double step = length / fine_count;
  const Polyline fine = ResampleChain(chain, fine_count);
  const Polyline smooth = SmoothSamples(fine, kJitterSigma / step);
  // The wide Gaussian runs on fewer samples; its arc length is then interpolated.
  const int coarse_count = std::max(8, static_cast<int>(std::ceil(length / (0.2 * kCrumpleSigma * length_in_pixels))));
  const Polyline coarse = ResampleChain(chain, coarse_count);
  const Polyline uncrumpled = SmoothSamples(coarse, kCrumpleSigma * length_in_pixels * coarse_count / length);
  const std::vector<double> arcs = CumulativeLengths(uncrumpled);
  Polyline samples;
  for (int i = 0; i <= count; ++i) {
    const double wanted = arcs.back() * i / count;
    const auto upper = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, wanted);
    const size_t next = static_cast<size_t>(upper - arcs.begin());
    const double span = arcs[next] - arcs[next - 1];
    const double inside = span > 0.0 ? std::clamp((wanted - arcs[next - 1]) / span, 0.0, 1.0) : 0.0;
    const double place = (static_cast<double>(next - 1) + inside) / coarse_count * fine_count;
    const size_t cell = std::min(static_cast<size_t>(place), static_cast<size_t>(fine_count - 1));
    const double fraction = place - static_cast<double>(cell);
    samples.push_back((1.0 - fraction) * smooth[cell] + fraction * smooth[cell + 1]);
  }
  samples.front() = chain.front();
  samples.back() = chain.back();
  return samples;
}

}  // namespace fitroom::panels
