#include "shop_catalog/garment/top_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "common/base/check.h"
#include "shop_catalog/garment/outline.h"

namespace fitroom::shop_catalog {
namespace {

// Parts of the way from underarm to hem, along the garment's axis. On a T-shirt of 68 cm the underarm lies 24 cm below
// the shoulder's highest point, a body's waist about 42 cm and its hips about 62 cm.
constexpr double kWaistPart = 0.42;
constexpr double kHipPart = 0.85;
constexpr double kLeastOfPerimeter = 0.007;  // That far at least, so that the two are told apart on the way round.
constexpr double kShoulderAtNeck = 0.022;    // From the neck end along the shoulder, part of the height: about 1.5 cm.

// One side of the garment as the image shows it, left or right, with the garment's own axes.
class Half {
 public:
  Half(const SampledOutline& outline, const TopCorners& corners, bool image_left)
      : outline_(outline), corners_(corners), image_left_(image_left) {
    const Eigen::Vector2d right(std::cos(corners.tilt), std::sin(corners.tilt));
    outward_ = image_left ? Eigen::Vector2d(-right) : right;
    down_ = Eigen::Vector2d(-right.y(), right.x());
    middle_ = 0.25 * (corners.pixel[kNeckLeft] + corners.pixel[kNeckRight] + corners.pixel[kHemLeft] +
                      corners.pixel[kHemRight]);
  }

  TopCorner Corner(TopCorner of_left) const {
    return image_left_ ? of_left : static_cast<TopCorner>(kTopCornerCount - 1 - of_left);
  }
  const Eigen::Vector2d& Pixel(TopCorner of_left) const { return corners_.pixel[Corner(of_left)]; }
  double Confidence(TopCorner of_left) const { return corners_.confidence[Corner(of_left)]; }
  double Out(const Eigen::Vector2d& p) const { return (p - middle_).dot(outward_); }
  double Down(const Eigen::Vector2d& p) const { return (p - middle_).dot(down_); }

  // Returns the sample between two corners (given as on the left) that minimises a cost.
  int Best(TopCorner a, TopCorner b, const std::function<double(int)>& cost) const {
    int first = outline_.IndexNear(Pixel(a));
    int last = outline_.IndexNear(Pixel(b));
    if (!image_left_) std::swap(first, last);
    if (last < first) last += outline_.count();
    int best = first;
    double best_cost = cost(first);
    for (int i = first + 1; i <= last; ++i) {
      const double value = cost(i);
      if (value < best_cost) {
        best_cost = value;
        best = i;
      }
    }
    return best;
  }

  // From the neck end along the shoulder by an arc length.
  Eigen::Vector2d FromNeck(double arc_length) const {
    const int steps = static_cast<int>(std::lround(arc_length / outline_.step()));
    const int neck = outline_.IndexNear(Pixel(kNeckLeft));
    return outline_.at(image_left_ ? neck - steps : neck + steps);
  }

  // The shoulder tip: the outline's bend above the armhole, looked for near where the armhole seam usually ends.
  OutlinePoint ShoulderTip(const std::string& name, double armhole_part) const {
    const double expected = armhole_part * Out(Pixel(kUnderarmLeft));
    const double spread = 0.05 * corners_.height;
    const int arm = std::max(2, static_cast<int>(std::lround(0.05 * corners_.height / outline_.step())));
    // Never at the neck: a shoulder is at least 4 cm long.
    const double least = Out(Pixel(kNeckLeft)) + 0.06 * corners_.height;
    const int best = Best(kSleeveTopLeft, kNeckLeft, [&](int i) {
      if (Out(outline_.at(i)) < least) return 1e9;
      const double off = (Out(outline_.at(i)) - expected) / spread;
      return off * off - 3.0 * outline_.TurnAt(i, arm);
    });
    const double bend = std::clamp(outline_.TurnAt(best, arm) / 0.35, 0.0, 1.0);
    return {name, outline_.at(best), 0.4 + 0.5 * bend};
  }

  OutlinePoint OnSide(const std::string& name, double part) const {
    const double target = (1.0 - part) * Down(Pixel(kUnderarmLeft)) + part * Down(Pixel(kHemLeft));
    const int best = Best(kHemLeft, kUnderarmLeft, [&](int i) { return std::abs(Down(outline_.at(i)) - target); });
    return {name, outline_.at(best), 0.9 * std::min(Confidence(kUnderarmLeft), Confidence(kHemLeft))};
  }

  // The sample halfway along the shoulder between two points on it.
  OutlinePoint Halfway(const std::string& name, const OutlinePoint& a, const OutlinePoint& b) const {
    int first = outline_.IndexNear(a.pixel);
    int last = outline_.IndexNear(b.pixel);
    if (image_left_) std::swap(first, last);
    if (last < first) last += outline_.count();
    return {name, outline_.at((first + last) / 2), std::min(a.confidence, b.confidence)};
  }

 private:
  const SampledOutline& outline_;
  const TopCorners& corners_;
  bool image_left_;
  Eigen::Vector2d outward_;
  Eigen::Vector2d down_;
  Eigen::Vector2d middle_;
};

// The wearer's right is on the image's left on a front view, the wearer's left on a back view.
bool ImageLeftIsWearersLeft(GarmentSide side) { return side == GarmentSide::kBack; }

// Names of the corners on one side of the wearer, by their place on the image's left: hem, underarm, sleeve bottom,
// sleeve top, neck.
std::array<std::string, 5> CornerNames(bool wearers_left) {
  if (wearers_left) return {"hem_L", "underarm_L", "sleeve_bottom_L", "e4", "P2"};
  return {"hem_R", "underarm_R", "sleeve_bottom_R", "e8", "P1"};
}

}  // namespace

Polygon JoinNeckline(const Polygon& silhouette, const TopCorners& corners, const Neckline& neckline) {
  const OutlinePlace from = NearestPlace(silhouette, corners.pixel[kNeckRight]);
  const OutlinePlace to = NearestPlace(silhouette, corners.pixel[kNeckLeft]);
  Polygon joined;
  const size_t n = silhouette.size();
  // Corners nearer to the neckline's ends than this would make slivers.
  const double least_gap = 0.25 * Perimeter(silhouette) / static_cast<double>(n);
  for (size_t i = (from.edge + 1) % n; i != (to.edge + 1) % n; i = (i + 1) % n) {
    const Eigen::Vector2d& p = silhouette[i];
    if ((p - from.pixel).norm() > least_gap && (p - to.pixel).norm() > least_gap) joined.push_back(p);
  }
  joined.insert(joined.end(), neckline.curve.begin(), neckline.curve.end());
  if (joined.size() < 16 || FindCrossing(joined)) return {};
  return joined;
}

std::vector<OutlinePoint> PlaceTopPoints(const Polygon& outline, const TopCorners& corners, const Neckline& neckline,
                                         GarmentSide side, double armhole_part) {
  const SampledOutline fine(outline, std::max(0.5, 0.002 * corners.height));
  std::map<std::string, OutlinePoint> points;
  const auto add = [&](OutlinePoint point) { points[point.name] = std::move(point); };
  for (const bool image_left : {true, false}) {
    const bool wearers_left = image_left == ImageLeftIsWearersLeft(side);
    const Half half(fine, corners, image_left);
    const std::array<std::string, 5> names = CornerNames(wearers_left);
    for (size_t i = 0; i < names.size(); ++i) {
      const auto corner = static_cast<TopCorner>(i);
      add({names[i], half.Pixel(corner), half.Confidence(corner)});
    }
    const std::string suffix = wearers_left ? "_L" : "_R";
    const OutlinePoint at_neck = {
        wearers_left ? "e1" : "e5",
        half.FromNeck(std::max(kShoulderAtNeck * corners.height, kLeastOfPerimeter * fine.length())),
        half.Confidence(kNeckLeft)};
    const OutlinePoint tip = half.ShoulderTip(wearers_left ? "e3" : "e7", armhole_part);
    add(half.Halfway(wearers_left ? "e2" : "e6", at_neck, tip));
    add(at_neck);
    add(tip);
    add(half.OnSide("waist" + suffix, kWaistPart));
    add(half.OnSide("hip" + suffix, kHipPart));
  }

  // Hem centre: halfway between the hem corners, on the hem.
  const Eigen::Vector2d hem = corners.pixel[kHemLeft] - corners.pixel[kHemRight];
  int index = fine.IndexNear(corners.pixel[kHemRight]);
  int last = fine.IndexNear(corners.pixel[kHemLeft]);
  if (last < index) last += fine.count();
  int best = index;
  double best_off = 1e18;
  for (; index <= last; ++index) {
    const double part = (fine.at(index) - corners.pixel[kHemRight]).dot(hem) / hem.squaredNorm();
    if (std::abs(part - 0.5) < best_off) {
      best_off = std::abs(part - 0.5);
      best = index;
    }
  }
  add({"hem_centre", fine.at(best), 0.95 * std::min(corners.confidence[kHemLeft], corners.confidence[kHemRight])});

  // Neck drop: the neckline's lowest point, seen from the line between the neck ends; ends of a flat stretch are equal,
  // so the place nearest to the middle is taken among those within 2 % of the lowest.
  const Eigen::Vector2d across = corners.pixel[kNeckRight] - corners.pixel[kNeckLeft];
  const Eigen::Vector2d downward = Eigen::Vector2d(-across.y(), across.x()).normalized();
  double depth = -1e18;
  for (const Eigen::Vector2d& p : neckline.curve) depth = std::max(depth, (p - corners.pixel[kNeckLeft]).dot(downward));
  Eigen::Vector2d drop = neckline.curve[neckline.curve.size() / 2];
  double best_distance = 1e18;
  for (const Eigen::Vector2d& p : neckline.curve) {
    if ((p - corners.pixel[kNeckLeft]).dot(downward) < depth - 0.02 * across.norm()) continue;
    const double off = std::abs((p - corners.pixel[kNeckLeft]).dot(across) / across.squaredNorm() - 0.5);
    if (off < best_distance) {
      best_distance = off;
      drop = p;
    }
  }
  add({"neck_drop", drop, neckline.confidence});

  std::vector<OutlinePoint> ordered;
  for (const std::string& name : OutlinePointNames(GarmentKind::kTShirt)) {
    FR_CHECK(points.contains(name));
    OutlinePoint point = points.at(name);
    point.pixel = NearestPlace(outline, point.pixel).pixel;
    ordered.push_back(std::move(point));
  }
  return ordered;
}

TopCorners CornersOfPoints(const std::vector<OutlinePoint>& points, GarmentSide side) {
  TopCorners corners;
  for (const bool image_left : {true, false}) {
    const std::array<std::string, 5> names = CornerNames(image_left == ImageLeftIsWearersLeft(side));
    for (size_t i = 0; i < names.size(); ++i) {
      const size_t corner = image_left ? i : kTopCornerCount - 1 - i;
      for (const OutlinePoint& point : points) {
        if (point.name != names[i]) continue;
        corners.pixel[corner] = point.pixel;
        corners.confidence[corner] = point.confidence;
      }
    }
  }
  const Eigen::Vector2d neck = 0.5 * (corners.pixel[kNeckLeft] + corners.pixel[kNeckRight]);
  const Eigen::Vector2d hem = 0.5 * (corners.pixel[kHemLeft] + corners.pixel[kHemRight]);
  corners.tilt = std::atan2(neck.x() - hem.x(), hem.y() - neck.y());
  corners.height = (hem - neck).norm();
  return corners;
}

double LengthInPixels(const TopCorners& corners) {
  const Eigen::Vector2d down(-std::sin(corners.tilt), std::cos(corners.tilt));
  const Eigen::Vector2d left = corners.pixel[kHemLeft] - corners.pixel[kNeckLeft];
  const Eigen::Vector2d right = corners.pixel[kHemRight] - corners.pixel[kNeckRight];
  return 0.5 * (left.dot(down) + right.dot(down));
}

}  // namespace fitroom::shop_catalog
