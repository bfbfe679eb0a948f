#include "fit_client/fit/panels/reconcile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "fit_client/fit/panels/leg_angles.h"
#include "fit_client/fit/panels/measure.h"
#include "fit_client/fit/panels/outline_layout.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/sleeve_lengths.h"
#include "fit_client/fit/panels/view_outline.h"
#include "fit_client/fit/panels/view_samples.h"

namespace fitroom {
namespace {

using panels::KnotIndices;
using panels::Polyline;
using panels::SectionLayout;
using panels::ViewOutline;
using panels::ViewSamples;

// Largest disagreement between a view's scale and the length that tilt and hem explain.
constexpr double kMaxScaleError = 0.15;
// A length of one side that differs from the other's by this share in both photographs, in the same direction, is
// meant.
// Short lengths differ by more for no reason: the difference must also be this long (unit: metre).
constexpr double kAsymmetry = 0.15;
constexpr double kAsymmetryLength = 0.03;
// Hems of front and back that differ by more than this are meant to; by more than twice this if one bends upwards and
// the other downwards (unit: metre).
constexpr double kOwnHem = 0.03;
constexpr double kLeastOpening = 0.04;  // Flat width; a child's arm (unit: metre).
// The back neck of a garment shown from the front only (share of the front's depth; at most, unit: metre).
constexpr double kShallowNeckShare = 0.3;
constexpr double kShallowNeckMax = 0.025;

// The front's photograph as if it showed the back: the wearer's left and right change places.
GarmentView AsBack(GarmentKind kind, const GarmentView& front) {
  GarmentView back = front;
  back.side = GarmentSide::kBack;
  for (OutlinePoint& point : back.points) point.name = TwinPointName(kind, point.name);
  return back;
}

Polyline Mean(const Polyline& a, const Polyline& b) {
  Polyline mean(a.size());
  for (size_t i = 0; i < a.size(); ++i) mean[i] = 0.5 * (a[i] + b[i]);
  return mean;
}

// Says whether some length of the left side differs from the right's by more than `kAsymmetry` in every view alike.
// Lengths along the outline do not change when a sleeve is laid at another angle; positions do.
bool IsAsymmetric(const std::vector<SectionLayout>& layout, const std::vector<const ViewSamples*>& views) {
  for (size_t s = 0; s < layout.size(); ++s) {
    const size_t mirror = static_cast<size_t>(layout[s].mirror);
    if (mirror <= s) continue;
    bool all_longer = true, all_shorter = true;
    for (const ViewSamples* view : views) {
      const double own = panels::ChainLength(view->points[s]);
      const double other = panels::ChainLength(view->points[mirror]);
      const double least = std::max(kAsymmetry * 0.5 * (own + other), kAsymmetryLength);
      all_longer = all_longer && own - other > least;
      all_shorter = all_shorter && other - own > least;
    }
    if (all_longer || all_shorter) return true;
  }
  return false;
}

// The seams and sleeve ends of the one garment; left and right averaged unless `asymmetric`.
std::vector<Polyline> AverageShared(const std::vector<SectionLayout>& layout, const ViewSamples& front,
                                    const ViewSamples& back, bool asymmetric) {
  std::vector<Polyline> shared(layout.size());
  for (size_t s = 0; s < layout.size(); ++s) {
    if (!layout[s].own_per_panel) shared[s] = Mean(front.points[s], back.points[s]);
  }
  if (asymmetric) return shared;
  for (size_t s = 0; s < layout.size(); ++s) {
    const size_t mirror = static_cast<size_t>(layout[s].mirror);
    if (mirror <= s || layout[s].own_per_panel) continue;
    shared[s] = Mean(shared[s], panels::Mirrored(shared[mirror]));
    shared[mirror] = panels::Mirrored(shared[s]);
  }
  return shared;
}

// Says whether a chain comes to a point at a sample, as a V-neck does at its drop: it turns by more than 60 degrees
// between a tenth of its length before and after. A round neck turns by a fifth of 180 degrees there.
bool IsPointed(const Polyline& points, size_t sample) {
  const size_t reach = std::max<size_t>(1, points.size() / 10);
  if (sample < reach || sample + reach >= points.size()) return false;
  const Eigen::Vector2d before = points[sample] - points[sample - reach];
  const Eigen::Vector2d after = points[sample + reach] - points[sample];
  return before.dot(after) < 0.5 * before.norm() * after.norm();
}

Polyline FitByArc(const Polyline& points, int degree, int held) {
  std::vector<double> parameters = panels::CumulativeLengths(points);
  const double length = parameters.back();
  if (length <= 0.0) return points;
  for (double& t : parameters) t /= length;
  return panels::FitBezier(points, parameters, degree, held);
}

// Replaces a section by its smooth curve, or, where it comes to a point in its middle, by two.
void Smooth(const SectionLayout& section, const std::vector<int>& knots, Polyline& points) {
  const size_t middle = static_cast<size_t>(knots[knots.size() / 2]);
  if (section.name == "neck" && IsPointed(points, middle)) {
    const auto tip = points.begin() + static_cast<std::ptrdiff_t>(middle);
    const Polyline first = FitByArc(Polyline(points.begin(), tip + 1), section.degree / 2, -1);
    const Polyline second = FitByArc(Polyline(tip, points.end()), section.degree / 2, -1);
    points = first;
    points.insert(points.end(), second.begin() + 1, second.end());
    return;
  }
  const int held = section.held_knot < 0 ? -1 : knots[static_cast<size_t>(section.held_knot)];
  points = FitByArc(points, section.degree, held);
}

// A view's own section (neck, waist, armhole, hem) between the corners that the shared sections gave it. `mirror` is
// the section on the view's other side; its own for a section across the middle.
Polyline OwnSection(const SectionLayout& section, const std::vector<int>& knots, const Polyline& seen,
                    const Polyline& mirror, const Eigen::Vector2d& first, const Eigen::Vector2d& last,
                    bool asymmetric) {
  Polyline points = asymmetric ? seen : Mean(seen, panels::Mirrored(mirror));
  panels::MoveEnds(points, first, last);
  Smooth(section, knots, points);
  return points;
}

// Gives both panels the mean hem where they differ little: one photograph's hem hangs where the other's is pushed up,
// and a fold or the other panel's hem peeps out below. A hem that is cut lower behind differs by more, and does not
// bend upwards in front.
void ShareHem(size_t hem, GarmentPattern& pattern) {
  Polyline& front = pattern.front.sections[hem].points;
  Polyline& back = pattern.back.sections[hem].points;
  double difference = 0.0, front_sag = 0.0, back_sag = 0.0;
  for (size_t i = 0; i < front.size(); ++i) {
    difference = std::max(difference, (front[i] - back[i]).norm());
    front_sag += front.front().y() - front[i].y();
    back_sag += back.front().y() - back[i].y();
  }
  if (difference > (front_sag * back_sag < 0.0 ? 2.0 : 1.0) * kOwnHem) return;
  front = Mean(front, back);
  back = front;
}

// Makes a back of a front's upper edge: a neck becomes shallow, half an ellipse between its ends; of a waist's dip a
// share remains.
void MakeShallow(GarmentKind kind, const std::vector<int>& knots, Polyline& neck) {
  const Eigen::Vector2d middle = 0.5 * (neck.front() + neck.back());
  if (IsBottom(kind)) {
    for (Eigen::Vector2d& p : neck) p.y() = middle.y() + kShallowNeckShare * (p.y() - middle.y());
    return;
  }
  const int drop_index = knots[knots.size() / 2];
  const Eigen::Vector2d half = neck.front() - middle;
  const double depth = middle.y() - neck[static_cast<size_t>(drop_index)].y();
  const Eigen::Vector2d drop(0.0, -std::min(kShallowNeckShare * depth, kShallowNeckMax));
  const double count = static_cast<double>(neck.size() - 1);
  for (size_t i = 1; i + 1 < neck.size(); ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / count;
    neck[i] = middle + std::cos(angle) * half + std::sin(angle) * drop;
  }
}

PanelPattern MakePanel(const std::vector<SectionLayout>& layout, const KnotIndices& knots, const ViewOutline& view,
                       const ViewSamples& samples, const std::vector<Polyline>& sections) {
  PanelPattern panel{view.side, view.image_width, view.image_height, {}};
  for (size_t s = 0; s < layout.size(); ++s) {
    OutlineSection section{layout[s].name, layout[s].kind, sections[s], samples.pixels[s], {}};
    for (size_t k = 0; k < layout[s].knots.size(); ++k) {
      section.knots.push_back({layout[s].knots[k], knots[s][k]});
    }
    panel.sections.push_back(std::move(section));
  }
  return panel;
}

// Moves the middle of the neck's or waist's ends to the origin and scales the whole from the length that it was drawn
// with to the garment's.
Status Normalise(double length, double drawn_length, GarmentPattern& pattern) {
  const double scale = length / drawn_length;
  if (!(std::abs(scale - 1.0) < kMaxScaleError)) {
    return InvalidArgument("SCALE_CONTRADICTS_LENGTH",
                           "the photographs' scale makes the garment " + std::to_string(drawn_length * 100.0) +
                               " cm long, but its length is given as " + std::to_string(length * 100.0) +
                               " cm; check the length and the points on hem and shoulders");
  }
  const OutlineSection& upper_opening = pattern.front.sections.front();
  const Eigen::Vector2d origin = 0.5 * (upper_opening.points.front() + upper_opening.points.back());
  for (PanelPattern* panel : {&pattern.front, &pattern.back}) {
    for (OutlineSection& section : panel->sections) {
      for (Eigen::Vector2d& p : section.points) p = scale * (p - origin);
    }
  }
  return Status();
}

// A neck, sleeve or hem that no one gets through means that two points were taken for each other.
Status CheckOpenings(const PanelPattern& panel) {
  for (const OutlineSection& section : panel.sections) {
    if (section.kind != SectionKind::kOpening) continue;
    const double width = (section.points.back() - section.points.front()).norm();
    if (width >= kLeastOpening) continue;
    return InvalidArgument("OPENING_TOO_NARROW",
                           "the opening from " + section.knots.front().name + " to " + section.knots.back().name +
                               " is only " + std::to_string(width * 1000.0) + " mm wide; check these two points");
  }
  return Status();
}

}  // namespace

Result<GarmentPattern> ReconcileViews(const Garment& garment) {
  const std::vector<SectionLayout>& layout = panels::OutlineLayout(garment.kind);
  FR_ASSIGN_OR_RETURN(const ViewOutline front_outline,
                      panels::SplitOutline(garment.front, garment.kind, garment.length));
  FR_ASSIGN_OR_RETURN(const ViewOutline back_outline,
                      panels::SplitOutline(garment.back ? *garment.back : AsBack(garment.kind, garment.front),
                                           garment.kind, garment.length));
  const KnotIndices knots = panels::ChooseKnotIndices(layout, {&front_outline, &back_outline});
  ViewSamples front = panels::SampleUpright(layout, knots, front_outline, garment.length);
  ViewSamples back = panels::SampleUpright(layout, knots, back_outline, garment.length);
  double seen_length = 0.0;
  if (HasLegs(garment.kind)) {
    seen_length = panels::MeanTrouserLength(layout, {&front, &back});
    panels::TurnLegsAlike(layout, knots, {&front, &back});
  }

  GarmentPattern pattern;
  pattern.kind = garment.kind;
  pattern.asymmetric_by_design = IsAsymmetric(layout, {&front, &back});
  const bool asymmetric = pattern.asymmetric_by_design;
  if (asymmetric) {
    panels::LevelUpperOpening(front);
    panels::LevelUpperOpening(back);
  }
  std::vector<Polyline> shared = AverageShared(layout, front, back, asymmetric);
  if (HasSleeves(garment.kind)) panels::KeepSleeveLengths(layout, knots, {&front, &back}, asymmetric, shared);
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].own_per_panel) continue;
    Smooth(layout[s], knots[s], shared[s]);
    const size_t mirror = static_cast<size_t>(layout[s].mirror);
    if (!asymmetric && mirror < s) shared[s] = panels::Mirrored(shared[mirror]);
  }
  if (HasLegs(garment.kind)) panels::PartInseams(layout, shared);

  for (auto [samples, outline, panel] :
       {std::tuple(&front, &front_outline, &pattern.front), std::tuple(&back, &back_outline, &pattern.back)}) {
    std::vector<Polyline> sections = shared;
    for (size_t s = 0; s < layout.size(); ++s) {
      if (!layout[s].own_per_panel) continue;
      const Eigen::Vector2d& first = shared[(s + layout.size() - 1) % layout.size()].back();
      const Eigen::Vector2d& last = shared[(s + 1) % layout.size()].front();
      const size_t mirror = static_cast<size_t>(layout[s].mirror);
      if (!asymmetric && mirror < s) {
        sections[s] = panels::Mirrored(sections[mirror]);
        continue;
      }
      sections[s] =
          OwnSection(layout[s], knots[s], samples->points[s], samples->points[mirror], first, last, asymmetric);
      if (!asymmetric && mirror == s) sections[s] = Mean(sections[s], panels::Mirrored(sections[s]));
      if (s == 0 && samples == &back && !garment.back) MakeShallow(garment.kind, knots[s], sections[s]);
    }
    *panel = MakePanel(layout, knots, *outline, *samples, sections);
  }
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].name == "hem") ShareHem(s, pattern);
  }
  FR_RETURN_IF_ERROR(Normalise(garment.length, HasLegs(garment.kind) ? seen_length : MeasureLength(pattern), pattern));
  for (const PanelPattern* panel : {&pattern.front, &pattern.back}) {
    FR_RETURN_IF_ERROR(CheckOpenings(*panel));
    const std::vector<Eigen::Vector2d> outline = JoinedPoints(*panel);
    if (panels::SignedArea(outline) <= 0.0 || !panels::IsSimplePolygon(outline)) {
      return InvalidArgument("OUTLINE_NOT_A_GARMENT",
                             "the outline of the garment crosses itself; check the points of both photographs");
    }
  }
  return pattern;
}

}  // namespace fitroom
