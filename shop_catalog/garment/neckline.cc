#include "shop_catalog/garment/neckline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {
namespace {

constexpr int kRayCount = 61;  // Over the half circle: 3 degrees apart.
// Radii are parts of half the distance between the neck ends.
constexpr double kMaxRadius = 2.1;    // Deep V-necks reach about 2.
constexpr double kLeastBelow = 0.25;  // An edge nearer to the silhouette than this is the collar's seam.
constexpr double kLeastDepth = 0.5;   // Boat necks are shallower; they are taken from the silhouette.
constexpr double kUsualDepth = 0.95;  // Of crew necks, seen on the external test photographs: 0.8 to 1.3.
constexpr double kUsualDepthSpread = 0.22;
constexpr double kUsualFullness = 1.75;
constexpr double kUsualFullnessSpread = 0.35;
constexpr double kPriorWeight = 0.6;              // Of one spread squared (unit: Lab).
constexpr double kLeastStrength = 1.5;            // Mean change of colour across a collar's edge (unit: Lab).
constexpr double kLeastCoverage = 0.6;            // Part of the arc along which it must show.
constexpr double kEstimatedDepthOfHeight = 0.10;  // Neck ends to front neckline, part of the garment's height.

// The frame of the neck: origin between the neck ends, one unit is half the distance between them.
struct NeckFrame {
  Eigen::Vector2d origin;
  Eigen::Vector2d right;  // (unit: pixel)
  Eigen::Vector2d down;   // (unit: pixel)

  explicit NeckFrame(const TopCorners& corners)
      : origin(0.5 * (corners.pixel[kNeckLeft] + corners.pixel[kNeckRight])),
        right(0.5 * (corners.pixel[kNeckRight] - corners.pixel[kNeckLeft])),
        down(-right.y(), right.x()) {}

  Eigen::Vector2d Pixel(const Eigen::Vector2d& place) const { return origin + place.x() * right + place.y() * down; }
  double Unit() const { return right.norm(); }
};

// Ray k points from the image's left (k = 0) over down to the right.
double AngleOf(int k) { return std::numbers::pi * (1.0 - static_cast<double>(k) / (kRayCount - 1)); }

cv::Vec3f ColourAt(const cv::Mat& lab, const Eigen::Vector2d& pixel) {
  const int x = std::clamp(static_cast<int>(pixel.x()), 0, lab.cols - 1);
  const int y = std::clamp(static_cast<int>(pixel.y()), 0, lab.rows - 1);
  return lab.at<cv::Vec3f>(y, x);
}

// Which change of colour makes the edge, going outwards from the visible inside of the back neck onto the front.
// A rolled edge often shows as nothing but a thin light line.
enum class EdgeKind { kLighterBelow, kDarkerBelow, kAnyColour, kLightLine };

// How strongly colours change across a place, along a direction that points outwards (unit: Lab).
double EdgeStrength(const cv::Mat& lab, const NeckFrame& frame, EdgeKind kind, const Eigen::Vector2d& place,
                    const Eigen::Vector2d& outward) {
  constexpr double kOffset = 0.055;  // To both sides (unit: half neck width).
  const cv::Vec3f change =
      ColourAt(lab, frame.Pixel(place + kOffset * outward)) - ColourAt(lab, frame.Pixel(place - kOffset * outward));
  double strength = static_cast<double>(change[0]);
  if (kind == EdgeKind::kDarkerBelow) strength = -strength;
  if (kind == EdgeKind::kAnyColour) strength = std::sqrt(static_cast<double>(change.dot(change))) - 4.0;
  return std::clamp(strength, -4.0, 9.0);
}

// A smooth neckline between the neck ends (-1, 0) and (1, 0): a half superellipse, from nearly a V (fullness 1.2) over
// an ellipse (2) to a round U (2.8), whose lowest point may lie off the middle.
struct Arc {
  double depth = kUsualDepth;
  double fullness = 2.0;
  double skew = 0.0;

  Eigen::Vector2d At(double angle) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double down = std::pow(s, 2.0 / fullness);
    return {std::copysign(std::pow(std::abs(c), 2.0 / fullness), c) + skew * down, depth * down};
  }
};

struct ArcFit {
  Arc arc;
  EdgeKind kind = EdgeKind::kLighterBelow;
  double score = -1e9;     // Mean strength with the prior on depth.
  double strength = -1e9;  // Mean strength alone (unit: Lab).
  double coverage = 0.0;   // Part of the arc along which the edge is visible.
};

ArcFit RateArc(const cv::Mat& lab, const NeckFrame& frame, const Arc& arc, EdgeKind kind,
               const std::array<double, kRayCount>& least_radius) {
  ArcFit fit;
  fit.arc = arc;
  fit.kind = kind;
  fit.strength = 0.0;
  int count = 0;
  for (int k = 4; k < kRayCount - 4; ++k) {
    const Eigen::Vector2d place = arc.At(AngleOf(k));
    const Eigen::Vector2d along = arc.At(AngleOf(k + 1)) - arc.At(AngleOf(k - 1));
    const double ray = (1.0 - std::atan2(place.y(), place.x()) / std::numbers::pi) * (kRayCount - 1);
    const auto nearest = static_cast<size_t>(std::clamp(std::lround(ray), 0L, static_cast<long>(kRayCount - 1)));
    ++count;
    if (place.norm() < least_radius[nearest]) {
      fit.strength -= 14.0;  // Above the silhouette, or on its collar: as bad as the best edge is good.
      continue;
    }
    // The curve goes left to right, so outwards (down) is on its right hand.
    const Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
    const double strength = EdgeStrength(lab, frame, kind, place, outward);
    fit.strength += strength;
    fit.coverage += strength > 1.0 ? 1.0 : 0.0;
  }
  fit.strength /= count;
  fit.coverage /= count;
  const double off_depth = (arc.depth - kUsualDepth) / kUsualDepthSpread;
  const double off_fullness = (arc.fullness - kUsualFullness) / kUsualFullnessSpread;
  fit.score = fit.strength * (0.3 + 0.7 * fit.coverage) -
              kPriorWeight * (off_depth * off_depth + off_fullness * off_fullness) - 4.0 * std::abs(arc.skew);
  return fit;
}

// A collar has two edges: the seam that joins it to the front runs outside its upper edge at the collar's width.
// Returns how clearly such a second line shows (unit: Lab). The back collar's seam and folds have no such companion.
double CompanionStrength(const cv::Mat& lab, const NeckFrame& frame, const Arc& arc) {
  double best = 0.0;
  for (const double width : {0.12, 0.15, 0.18, 0.21, 0.24}) {
    double sum = 0.0;
    int count = 0;
    for (int k = 6; k < kRayCount - 6; ++k) {
      const Eigen::Vector2d along = arc.At(AngleOf(k + 1)) - arc.At(AngleOf(k - 1));
      const Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
      sum += EdgeStrength(lab, frame, EdgeKind::kLighterBelow, arc.At(AngleOf(k)) + width * outward, outward);
      ++count;
    }
    best = std::max(best, std::abs(sum) / count);
  }
  return best;
}

// Tries all arcs and kinds of edge. Only arcs that are good by themselves are asked for their companion.
ArcFit FindArc(const cv::Mat& lab, const NeckFrame& frame, const std::array<double, kRayCount>& least_radius) {
  ArcFit best;
  for (const EdgeKind kind :
       {EdgeKind::kLighterBelow, EdgeKind::kDarkerBelow, EdgeKind::kAnyColour, EdgeKind::kLightLine}) {
    for (double depth = kLeastDepth; depth < kMaxRadius; depth += 0.04) {
      for (const double fullness : {1.2, 1.35, 1.5, 1.65, 1.8, 2.1, 2.4, 2.8}) {
        for (const double skew : {-0.16, -0.08, 0.0, 0.08, 0.16}) {
          ArcFit fit = RateArc(lab, frame, {depth, fullness, skew}, kind, least_radius);
          if (fit.score < best.score - 4.0 || fit.strength < 1.0) continue;
          fit.score += 0.6 * CompanionStrength(lab, frame, fit.arc);
          if (fit.score > best.score) best = fit;
        }
      }
    }
  }
  return best;
}

// Follows the edge closely: along each ray the place may leave the arc by a little, smoothly, where the edge is
// stronger (dynamic programming over the rays). Returns the radius along each ray.
std::array<double, kRayCount> FollowEdge(const cv::Mat& lab, const NeckFrame& frame, const ArcFit& fit) {
  constexpr int kSteps = 8;        // To both sides of the arc.
  constexpr double kStep = 0.015;  // (unit: half neck width)
  constexpr int kPlaces = 2 * kSteps + 1;
  std::vector<std::array<double, kPlaces>> score(kRayCount);
  std::vector<std::array<int, kPlaces>> from(kRayCount);
  for (int k = 0; k < kRayCount; ++k) {
    const auto ray = static_cast<size_t>(k);
    const Eigen::Vector2d place = fit.arc.At(AngleOf(k));
    const Eigen::Vector2d along =
        fit.arc.At(AngleOf(std::min(k + 1, kRayCount - 1))) - fit.arc.At(AngleOf(std::max(k - 1, 0)));
    const Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
    for (int p = 0; p < kPlaces; ++p) {
      const auto index = static_cast<size_t>(p);
      const int off = p - kSteps;
      score[ray][index] = EdgeStrength(lab, frame, fit.kind, place + off * kStep * outward, outward) - 0.03 * off * off;
      from[ray][index] = p;
      if (k == 0) continue;
      double best = -1e18;
      for (int last = std::max(0, p - 1); last <= std::min(kPlaces - 1, p + 1); ++last) {
        const double value = score[ray - 1][static_cast<size_t>(last)] - 1.0 * std::abs(last - p);
        if (value > best) {
          best = value;
          from[ray][index] = last;
        }
      }
      score[ray][index] += best;
    }
  }
  std::array<double, kRayCount> offset{};
  auto p = static_cast<int>(std::max_element(score.back().begin(), score.back().end()) - score.back().begin());
  for (int k = kRayCount - 1; k >= 0; --k) {
    offset[static_cast<size_t>(k)] = (p - kSteps) * kStep;
    p = from[static_cast<size_t>(k)][static_cast<size_t>(p)];
  }
  return offset;
}

// Distance from the neck's middle to the silhouette along each ray, in units of the frame; 0 where it lies above.
std::array<double, kRayCount> SilhouetteRadius(const Polygon& curve, const NeckFrame& frame) {
  std::array<double, kRayCount> radius{};
  const double squared_unit = frame.Unit() * frame.Unit();
  for (const Eigen::Vector2d& p : curve) {
    const double x = (p - frame.origin).dot(frame.right) / squared_unit;
    const double y = (p - frame.origin).dot(frame.down) / squared_unit;
    if (y <= 0) continue;
    const double angle = std::atan2(y, x);
    const long k = std::lround((1.0 - angle / std::numbers::pi) * (kRayCount - 1));
    for (long near = std::max(0L, k - 1); near <= std::min<long>(kRayCount - 1, k + 1); ++near) {
      radius[static_cast<size_t>(near)] = std::max(radius[static_cast<size_t>(near)], std::hypot(x, y));
    }
  }
  return radius;
}

Polygon CurveOf(const Arc& arc, const std::array<double, kRayCount>& offset, const NeckFrame& frame,
                const TopCorners& corners) {
  Polygon curve;
  curve.push_back(corners.pixel[kNeckLeft]);
  for (int k = 3; k < kRayCount - 3; k += 2) {
    double sum = 0.0;
    for (int near = k - 2; near <= k + 2; ++near) sum += offset[static_cast<size_t>(near)];
    // Run into the neck ends: the edge grazes the shoulder there and is seen badly.
    const double trust = std::clamp(std::sin(AngleOf(k)) / 0.45, 0.0, 1.0);
    const Eigen::Vector2d along = arc.At(AngleOf(k + 1)) - arc.At(AngleOf(k - 1));
    const Eigen::Vector2d outward = Eigen::Vector2d(-along.y(), along.x()).normalized();
    curve.push_back(frame.Pixel(arc.At(AngleOf(k)) + trust * sum / 5.0 * outward));
  }
  curve.push_back(corners.pixel[kNeckRight]);
  return curve;
}

}  // namespace

Polygon NecklineThrough(const Eigen::Vector2d& left, const Eigen::Vector2d& lowest, const Eigen::Vector2d& right) {
  const Eigen::Vector2d middle = 0.5 * (left + right);
  const Eigen::Vector2d half = 0.5 * (right - left);
  const Eigen::Vector2d drop = lowest - middle;
  Polygon curve = {left};
  constexpr int kPieces = 24;
  for (int i = 1; i < kPieces; ++i) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(i) / kPieces);
    curve.push_back(middle + std::cos(angle) * half + std::sin(angle) * drop);
  }
  curve.push_back(right);
  return curve;
}

Neckline SilhouetteNeckline(const Polygon& outline, const TopCorners& corners) {
  Neckline neckline;
  const SampledOutline fine(outline, std::max(0.5, 0.003 * corners.height));
  const int left = fine.IndexNear(corners.pixel[kNeckLeft]);
  int right = fine.IndexNear(corners.pixel[kNeckRight]);
  if (right < left) right += fine.count();
  neckline.curve.push_back(corners.pixel[kNeckLeft]);
  for (int i = left + 1; i < right; ++i) neckline.curve.push_back(fine.at(i));
  neckline.curve.push_back(corners.pixel[kNeckRight]);
  neckline.confidence = 0.9;
  return neckline;
}

Neckline FindFrontNeckline(const cv::Mat& lab, const Polygon& outline, const TopCorners& corners) {
  const NeckFrame frame(corners);
  Neckline silhouette = SilhouetteNeckline(outline, corners);
  const std::array<double, kRayCount> edge_radius = SilhouetteRadius(silhouette.curve, frame);
  const double silhouette_depth =
      *std::max_element(edge_radius.begin() + kRayCount / 3, edge_radius.end() - kRayCount / 3);
  std::array<double, kRayCount> least_radius{};
  for (int k = 0; k < kRayCount; ++k) {
    const auto ray = static_cast<size_t>(k);
    least_radius[ray] = std::max(0.35 * std::sin(AngleOf(k)), edge_radius[ray] + kLeastBelow * std::sin(AngleOf(k)));
  }

  // Only the neck's surroundings are looked at.
  cv::Mat smooth;
  const int reach = static_cast<int>(2.6 * frame.Unit());
  const cv::Rect around = cv::Rect(static_cast<int>(frame.origin.x()) - reach,
                                   static_cast<int>(frame.origin.y()) - reach, 2 * reach, 2 * reach) &
                          cv::Rect(0, 0, lab.cols, lab.rows);
  cv::GaussianBlur(lab(around), smooth, cv::Size(0, 0), std::max(0.6, 0.012 * frame.Unit()));
  NeckFrame local = frame;
  local.origin -= Eigen::Vector2d(around.x, around.y);

  const ArcFit best = FindArc(smooth, local, least_radius);
  if (best.strength > kLeastStrength && best.coverage > kLeastCoverage) {
    Neckline found;
    found.source = Neckline::Source::kCollarEdge;
    found.curve = CurveOf(best.arc, FollowEdge(smooth, local, best), frame, corners);
    found.confidence =
        std::clamp(0.45 + 0.08 * (best.strength - kLeastStrength) + 0.8 * (best.coverage - kLeastCoverage), 0.0, 0.95);
    return found;
  }
  if (silhouette_depth > 0.3) {
    silhouette.confidence = 0.6;
    return silhouette;
  }
  Neckline estimated;
  estimated.source = Neckline::Source::kEstimated;
  const Eigen::Vector2d lowest = frame.origin + kEstimatedDepthOfHeight * corners.height * frame.down.normalized();
  estimated.curve = NecklineThrough(corners.pixel[kNeckLeft], lowest, corners.pixel[kNeckRight]);
  estimated.confidence = 0.3;
  return estimated;
}

}  // namespace fitroom::shop_catalog
