#include "fit_client/fit/fork/fork_curves.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"

namespace fitroom::fork {
namespace {

constexpr double kCurveStart = 0.475;  // Of the hip's depth, above the crotch.
// The curve takes at least and at most this share of the way from waist to crotch, should the hip be marked oddly.
constexpr double kLeastCurve = 0.2, kMostCurve = 0.6;
constexpr double kStep = 0.005;  // Between points of a seam (unit: metre).
constexpr int kCurveSteps = 48;
constexpr double kLeastFullness = 0.35, kMostFullness = 0.75;
constexpr double kMostRaise = 0.06;  // (unit: metre)
constexpr int kBisections = 60;
// The inseam leaves the fork flatter than its chord: x of the tangent against the chord's.
constexpr double kFlare = 1.4;
constexpr double kMostDrop = 0.02;  // (unit: metre)

const Eigen::Vector2d& KnotOf(const OutlineSection& section, const std::string& name) {
  for (const SectionKnot& knot : section.knots) {
    if (knot.name.starts_with(name)) return section.points[static_cast<size_t>(knot.index)];
  }
  FR_CHECK(false);
  return section.points.front();
}

Eigen::Vector2d Bezier(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                       const Eigen::Vector2d& d, double t) {
  const double s = 1.0 - t;
  return s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
}

}  // namespace

CentreFrame FrameOf(const HalfPanel& half) {
  CentreFrame frame;
  frame.waist = half.waist.points.back();
  frame.crotch = half.inseam.points.front();
  const double side_waist = half.outseam.points.back().y(), hip = KnotOf(half.outseam, "hip").y();
  const double depth = frame.waist.y() - frame.crotch.y();
  const double height = std::min(kCurveStart * (side_waist - hip), hip - frame.crotch.y());
  frame.curve_height = std::clamp(height, kLeastCurve * depth, kMostCurve * depth);
  return frame;
}

panels::Polyline CentreSeam(const CentreFrame& frame, const CentreShape& shape) {
  const Eigen::Vector2d top = frame.waist + Eigen::Vector2d(0.0, shape.raise);
  const Eigen::Vector2d start = frame.crotch + Eigen::Vector2d(0.0, frame.curve_height);
  const Eigen::Vector2d tip = frame.crotch - Eigen::Vector2d(shape.extension, shape.drop);
  const int straight = std::max(2, static_cast<int>(std::lround((top - start).norm() / kStep)));
  panels::Polyline seam;
  for (int i = 0; i < straight; ++i) {
    const double t = static_cast<double>(i) / straight;
    seam.push_back((1.0 - t) * top + t * start);
  }
  const Eigen::Vector2d down(0.0, -shape.fullness * (frame.curve_height + shape.drop));
  const Eigen::Vector2d back(shape.fullness * shape.extension, 0.0);
  for (int i = 0; i < kCurveSteps; ++i) {
    seam.push_back(Bezier(start, start + down, tip + back, tip, static_cast<double>(i) / kCurveSteps));
  }
  seam.push_back(tip);
  return seam;
}

std::optional<CentreShape> ShapeForRise(const CentreFrame& frame, CentreShape shape, double rise) {
  const auto length = [&](double fullness) {
    CentreShape tried = shape;
    tried.fullness = fullness;
    tried.raise = 0.0;
    return panels::ChainLength(CentreSeam(frame, tried));
  };
  double low = kLeastFullness, high = kMostFullness;  // A fuller curve is longer.
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (length(middle) < rise ? low : high) = middle;
  }
  shape.fullness = 0.5 * (low + high);
  shape.raise = 0.0;
  // What fullness cannot do the straight part does.
  for (int i = 0; i < 4; ++i) shape.raise += rise - panels::ChainLength(CentreSeam(frame, shape));
  if (!(std::abs(shape.raise) <= kMostRaise)) return std::nullopt;
  return shape;
}

Inseam InseamFor(const HalfPanel& half, double extension, double mean_extension, double drop, double share,
                 bool at_hem) {
  const panels::Polyline& seen = half.inseam.points;
  const size_t last = seen.size() - 1;
  size_t join = last;
  for (const SectionKnot& knot : half.inseam.knots) {
    if (!at_hem && knot.name.starts_with("knee_inner")) join = static_cast<size_t>(knot.index);
  }
  const Eigen::Vector2d tip = seen.front() - Eigen::Vector2d(extension, drop);
  // Positive: this piece is narrower than the mean, its inseam lies further out.
  const double shift = share * (mean_extension - extension);
  const Eigen::Vector2d end = seen[join] + Eigen::Vector2d(shift, 0.0);
  const Eigen::Vector2d chord = seen[join] - (seen.front() - Eigen::Vector2d(mean_extension, 0.0));
  const size_t behind = join - std::min<size_t>(join, 3);
  const Eigen::Vector2d leave = chord.norm() * Eigen::Vector2d(kFlare * chord.x(), chord.y()).normalized();
  const Eigen::Vector2d arrive = chord.norm() * (seen[join] - seen[behind]).normalized();

  Inseam inseam;
  for (int i = 0; i < kCurveSteps; ++i) {
    const double t = static_cast<double>(i) / kCurveSteps;
    inseam.points.push_back(Bezier(tip, tip + leave / 3.0, end - arrive / 3.0, end, t));
  }
  const double leg = seen[join].y() - seen[last].y();
  for (size_t i = join; i <= last; ++i) {
    const double fade = at_hem ? 1.0 : (seen[i].y() - seen[last].y()) / leg;
    inseam.points.push_back(seen[i] + Eigen::Vector2d(shift * fade, 0.0));
  }
  inseam.shift = at_hem ? shift : 0.0;
  inseam.length = panels::ChainLength(inseam.points);
  return inseam;
}

std::optional<InseamShape> BalanceInseams(const HalfPanel& half, double front_extension, double back_extension,
                                          bool at_hem) {
  const double mean = 0.5 * (front_extension + back_extension);
  for (const double share : {0.4, 0.55, 0.7, 0.85, 1.0}) {
    const double front = InseamFor(half, front_extension, mean, 0.0, share, at_hem).length;
    const auto longer = [&](double drop) {
      return InseamFor(half, back_extension, mean, drop, share, at_hem).length - front;
    };
    double low = -kMostDrop, high = kMostDrop;  // A lower tip makes a shorter seam.
    if (longer(low) < 0.0 || longer(high) > 0.0) continue;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (low + high);
      (longer(middle) > 0.0 ? low : high) = middle;
    }
    return InseamShape{0.5 * (low + high), share};
  }
  return std::nullopt;
}

}  // namespace fitroom::fork
