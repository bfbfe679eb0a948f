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

constexpr int kRayCount = 61;     // Over the half circle: 3 degrees apart.
constexpr int kRadiusCount = 72;  // Places along a ray.
// Radii are parts of half the distance between the neck ends.
constexpr double kMaxRadius = 2.1;    // Deep V-necks reach about 2.
constexpr double kLeastBelow = 0.2;   // An edge nearer to the silhouette than this is the collar's seam.
constexpr double kUsualDepth = 0.85;  // Of a crew neck.
constexpr double kUsualDepthSpread = 0.35;
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

  Eigen::Vector2d PixelAt(double angle, double radius) const {
    return origin + radius * (std::cos(angle) * right + std::sin(angle) * down);
  }
  double Unit() const { return right.norm(); }
};

// Ray k points from the image's left (k = 0) over down to the right.
double AngleOf(int k) { return std::numbers::pi * (1.0 - static_cast<double>(k) / (kRayCount - 1)); }
double RadiusOf(int r) { return 0.15 + (kMaxRadius - 0.15) * r / (kRadiusCount - 1); }

cv::Vec3f ColourAt(const cv::Mat& lab, const Eigen::Vector2d& pixel) {
  const int x = std::clamp(static_cast<int>(pixel.x()), 0, lab.cols - 1);
  const int y = std::clamp(static_cast<int>(pixel.y()), 0, lab.rows - 1);
  return lab.at<cv::Vec3f>(y, x);
}

// How strongly the colour changes outwards across each place of each ray, for one kind of edge; negative is none.
using EdgeTable = std::vector<std::array<double, kRadiusCount>>;

enum class EdgeKind { kLighterBelow, kDarkerBelow, kAnyColour };

EdgeTable MeasureEdges(const cv::Mat& lab, const NeckFrame& frame, EdgeKind kind, double offset) {
  EdgeTable table(kRayCount);
  for (int k = 0; k < kRayCount; ++k) {
    for (int r = 0; r < kRadiusCount; ++r) {
      const cv::Vec3f outer = ColourAt(lab, frame.PixelAt(AngleOf(k), RadiusOf(r) + offset));
      const cv::Vec3f inner = ColourAt(lab, frame.PixelAt(AngleOf(k), RadiusOf(r) - offset));
      const cv::Vec3f change = outer - inner;
      double strength = static_cast<double>(change[0]);
      if (kind == EdgeKind::kDarkerBelow) strength = -strength;
      if (kind == EdgeKind::kAnyColour) strength = std::sqrt(static_cast<double>(change.dot(change))) - 4.0;
      table[static_cast<size_t>(k)][static_cast<size_t>(r)] = std::clamp(strength, -5.0, 25.0);
    }
  }
  return table;
}

struct Path {
  std::array<double, kRayCount> radius{};
  double score = -1e9;     // Mean strength with priors.
  double strength = -1e9;  // Mean strength alone (unit: Lab).
  double coverage = 0.0;   // Part of the rays on which the edge is visible.
};

// Finds the best smooth path over all rays: dynamic programming with at most two steps of radius between rays.
Path FindPath(const EdgeTable& table, const std::array<double, kRayCount>& least_radius) {
  std::vector<std::array<double, kRadiusCount>> score(kRayCount);
  std::vector<std::array<int, kRadiusCount>> from(kRayCount);
  for (int k = 0; k < kRayCount; ++k) {
    const auto ray = static_cast<size_t>(k);
    const double sine = std::sin(AngleOf(k));
    for (int r = 0; r < kRadiusCount; ++r) {
      const auto place = static_cast<size_t>(r);
      const double radius = RadiusOf(r);
      // At the neck ends the curve is at radius 1; in the middle at the usual depth, give or take.
      const double expected = 1.0 + (kUsualDepth - 1.0) * sine;
      const double spread = 0.08 + (kUsualDepthSpread - 0.08) * sine;
      const double off = (radius - expected) / spread;
      double own = table[ray][place] * sine - 1.2 * off * off;
      if (radius < least_radius[ray]) own -= 50.0;
      from[ray][place] = r;
      if (k == 0) {
        score[ray][place] = own;
        continue;
      }
      double best = -1e18;
      for (int step = -3; step <= 3; ++step) {
        if (r + step < 0 || r + step >= kRadiusCount) continue;
        const double value = score[ray - 1][static_cast<size_t>(r + step)] - 0.5 * step * step;
        if (value > best) {
          best = value;
          from[ray][place] = r + step;
        }
      }
      score[ray][place] = best + own;
    }
  }
  Path path;
  int r = static_cast<int>(std::max_element(score.back().begin(), score.back().end()) - score.back().begin());
  path.score = score.back()[static_cast<size_t>(r)] / kRayCount;
  path.strength = 0.0;
  double weight = 0.0;
  for (int k = kRayCount - 1; k >= 0; --k) {
    const auto ray = static_cast<size_t>(k);
    const double sine = std::sin(AngleOf(k));
    const double strength = table[ray][static_cast<size_t>(r)];
    path.radius[ray] = RadiusOf(r);
    path.strength += sine * strength;
    path.coverage += strength > 1.5 ? sine : 0.0;
    weight += sine;
    r = from[ray][static_cast<size_t>(r)];
  }
  path.strength /= weight;
  path.coverage /= weight;
  return path;
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

Polygon CurveOf(const Path& path, const NeckFrame& frame, const TopCorners& corners) {
  Polygon curve;
  curve.push_back(corners.pixel[kNeckLeft]);
  for (int k = 3; k < kRayCount - 3; k += 2) {
    double sum = 0.0;
    for (int near = k - 2; near <= k + 2; ++near) sum += path.radius[static_cast<size_t>(near)];
    double radius = sum / 5.0;
    // Run into the neck ends: the rays there graze the edge and see little of it.
    const double trust = std::clamp(std::sin(AngleOf(k)) / 0.45, 0.0, 1.0);
    radius = trust * radius + (1.0 - trust);
    curve.push_back(frame.PixelAt(AngleOf(k), radius));
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
  cv::GaussianBlur(lab(around), smooth, cv::Size(0, 0), std::max(0.6, 0.02 * frame.Unit()));
  NeckFrame local = frame;
  local.origin -= Eigen::Vector2d(around.x, around.y);

  Path best;
  for (const EdgeKind kind : {EdgeKind::kLighterBelow, EdgeKind::kDarkerBelow, EdgeKind::kAnyColour}) {
    const Path path = FindPath(MeasureEdges(smooth, local, kind, 0.055), least_radius);
    if (path.score > best.score) best = path;
  }
  if (best.strength > 2.0 && best.coverage > 0.6) {
    Neckline found;
    found.source = Neckline::Source::kCollarEdge;
    found.curve = CurveOf(best, frame, corners);
    found.confidence = std::clamp(0.35 + 0.08 * best.strength + 0.5 * (best.coverage - 0.6), 0.0, 0.95);
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
