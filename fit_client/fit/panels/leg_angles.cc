#include "fit_client/fit/panels/leg_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/base/check.h"

namespace fitroom::panels {
namespace {

// Over this share of the leg's length the turn grows from nothing to its full angle.
constexpr double kBlendShare = 0.35;
// How far the inseam stands away from the middle, at least (share of the depth below the crotch).
constexpr double kLeastParting = 0.03;
// The same where no turn reaches (share of the depth below the crotch).
constexpr double kLeastGap = 0.01;
// Where less than this share of the turn arrives, a closed leg cannot be opened by turning it.
constexpr double kLeastWeight = 0.3;

// Which sections make a leg. Seen from the front, the wearer's left one:
//
//     crotch ---- crotch_level     The sections run hem, outseam upwards to the waist and inseam downwards on the left,
//    inseam |      | outseam       the other way on the right.
//    inner  |______| outer
//             hem
struct Leg {
  size_t outseam = 0, hem = 0, inseam = 0;
  size_t level_knot = 0;  // "crotch_level" on the outseam.
  double outwards = 1.0;  // Sign of x on the leg's side.
};

Leg FindLeg(const std::vector<SectionLayout>& layout, bool left) {
  Leg leg;
  leg.outwards = left ? 1.0 : -1.0;
  const std::string side = left ? "_L" : "_R";
  for (size_t s = 0; s < layout.size(); ++s) {
    if (layout[s].name == "outseam" + side) leg.outseam = s;
    if (layout[s].name == "leg_hem" + side) leg.hem = s;
    if (layout[s].name == "inseam" + side) leg.inseam = s;
  }
  const std::vector<std::string>& knots = layout[leg.outseam].knots;
  const auto level = std::find(knots.begin(), knots.end(), "crotch_level" + side);
  FR_CHECK(level != knots.end());
  leg.level_knot = static_cast<size_t>(level - knots.begin());
  return leg;
}

struct LegAxis {
  Eigen::Vector2d pivot;  // The middle of the leg's upper end.
  Eigen::Vector2d foot;   // The middle between the hem's corners.

  // How far the leg points outwards from straight down (unit: radian).
  double Angle(double outwards) const {
    const Eigen::Vector2d along = foot - pivot;
    return std::atan2(outwards * along.x(), -along.y());
  }
};

LegAxis AxisOf(const ViewSamples& view, const KnotIndices& knots, const Leg& leg) {
  const Polyline& hem = view.points[leg.hem];
  const Polyline& inseam = view.points[leg.inseam];
  const size_t level = static_cast<size_t>(knots[leg.outseam][leg.level_knot]);
  const Eigen::Vector2d crotch = leg.outwards > 0.0 ? inseam.front() : inseam.back();
  return {0.5 * (view.points[leg.outseam][level] + crotch), 0.5 * (hem.front() + hem.back())};
}

// The share of the turn that a point gets.
double TurnWeight(const LegAxis& axis, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = axis.foot - axis.pivot;
  const double t = std::clamp(along.dot(point - axis.pivot) / (kBlendShare * along.squaredNorm()), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Turns the leg outwards by an angle. The corners, which two sections share, are moved by the same rule in both.
void TurnLeg(const Leg& leg, const LegAxis& axis, double angle, size_t level_sample, ViewSamples& view) {
  const auto turn = [&](Eigen::Vector2d& p) {
    const double a = leg.outwards * angle * TurnWeight(axis, p);
    const Eigen::Vector2d arm = p - axis.pivot;
    p = axis.pivot +
        Eigen::Vector2d(std::cos(a) * arm.x() - std::sin(a) * arm.y(), std::sin(a) * arm.x() + std::cos(a) * arm.y());
  };
  for (Eigen::Vector2d& p : view.points[leg.hem]) turn(p);
  for (Eigen::Vector2d& p : view.points[leg.inseam]) turn(p);
  Polyline& outseam = view.points[leg.outseam];
  const size_t first = leg.outwards > 0.0 ? 0 : level_sample;
  const size_t last = leg.outwards > 0.0 ? level_sample : outseam.size() - 1;
  for (size_t i = first; i <= last; ++i) turn(outseam[i]);
}

// The angle by which a leg that points outwards by `angle` would have to be turned further for the legs to part.
double MissingAngle(const ViewSamples& view, const KnotIndices& knots, const Leg& leg, double middle) {
  const LegAxis axis = AxisOf(view, knots, leg);
  const Polyline& inseam = view.points[leg.inseam];
  const double crotch_y = (leg.outwards > 0.0 ? inseam.front() : inseam.back()).y();
  double missing = 0.0;
  for (const Eigen::Vector2d& p : inseam) {
    const double depth = crotch_y - p.y();
    const double weight = TurnWeight(axis, p);
    if (depth <= 0.0 || weight < kLeastWeight) continue;
    const double outwards = leg.outwards * (p.x() - middle);
    missing = std::max(missing, (kLeastParting * depth - outwards) / (weight * depth));
  }
  return missing;
}

}  // namespace

double MeanTrouserLength(const std::vector<SectionLayout>& layout, const std::vector<const ViewSamples*>& views) {
  double mean = 0.0;
  for (const bool left : {true, false}) {
    const Leg leg = FindLeg(layout, left);
    for (const ViewSamples* view : views) {
      const Polyline& outseam = view->points[leg.outseam];
      const double drop = outseam.back().y() - outseam.front().y();
      mean += (left ? drop : -drop) / (2.0 * static_cast<double>(views.size()));
    }
  }
  return mean;
}

void TurnLegsAlike(const std::vector<SectionLayout>& layout, const KnotIndices& knots,
                   const std::vector<ViewSamples*>& views) {
  const std::array<Leg, 2> legs = {FindLeg(layout, true), FindLeg(layout, false)};
  double mean = 0.0;
  for (const ViewSamples* view : views) {
    for (const Leg& leg : legs) mean += AxisOf(*view, knots, leg).Angle(leg.outwards);
  }
  mean /= 2.0 * static_cast<double>(views.size());
  const auto turn_all = [&](auto angle_of) {
    for (ViewSamples* view : views) {
      for (const Leg& leg : legs) {
        const LegAxis axis = AxisOf(*view, knots, leg);
        const size_t level = static_cast<size_t>(knots[leg.outseam][leg.level_knot]);
        TurnLeg(leg, axis, angle_of(axis.Angle(leg.outwards)), level, *view);
      }
    }
  };
  turn_all([&](double angle) { return mean - angle; });

  double missing = 0.0;
  for (const ViewSamples* view : views) {
    const double middle = view->points[legs[0].inseam].front().x();
    for (const Leg& leg : legs) {
      missing += MissingAngle(*view, knots, leg, middle) / (2.0 * static_cast<double>(views.size()));
    }
  }
  if (missing > 0.0) turn_all([&](double) { return missing; });
  for (ViewSamples* view : views) CentreOnSeams(layout, *view);
}

void PartInseams(const std::vector<SectionLayout>& layout, std::vector<Polyline>& sections) {
  for (const bool left : {true, false}) {
    const Leg leg = FindLeg(layout, left);
    Polyline& inseam = sections[leg.inseam];
    const Eigen::Vector2d crotch = left ? inseam.front() : inseam.back();
    for (Eigen::Vector2d& p : inseam) {
      const double least = kLeastGap * std::max(0.0, crotch.y() - p.y());
      if (leg.outwards * (p.x() - crotch.x()) < least) p.x() = crotch.x() + leg.outwards * least;
    }
  }
}

}  // namespace fitroom::panels
