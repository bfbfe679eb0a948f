#include "shop_catalog/garment/kind_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "common/base/check.h"
#include "shop_catalog/garment/outline.h"
#include "shop_catalog/garment/top_points.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

constexpr double kSkirtHip = 0.20;           // Below the waist (unit: metre).
constexpr double kTrouserHipPart = 2.0 / 3;  // Of the way from waist to crotch.
constexpr double kDressWaist = 0.165;        // Below the underarm, where a dress does not narrow (unit: metre).
constexpr double kDressWaistLeast = 0.10;    // (unit: metre)
constexpr double kDressWaistMost = 0.24;     // (unit: metre)
constexpr double kHipBelowWaist = 0.20;      // (unit: metre)

// The wearer's right is on the image's left of a front view.
bool IsWearersLeft(bool image_left, GarmentSide side) { return image_left == (side == GarmentSide::kBack); }

// A garment's outline with its own axes.
class Traced {
 public:
  Traced(const Polygon& outline, double height, const Vector2d& upper, const Vector2d& lower)
      : fine_(outline, std::max(0.5, 0.002 * height)), upper_(upper), down_((lower - upper).normalized()) {}

  double Down(const Vector2d& p) const { return (p - upper_).dot(down_); }
  const Vector2d& down() const { return down_; }

  // The samples from one place on the outline to another, clockwise.
  Polygon Section(const Vector2d& from, const Vector2d& to) const {
    const int first = fine_.IndexNear(from);
    int last = fine_.IndexNear(to);
    if (last < first) last += fine_.count();
    Polygon section;
    for (int i = first; i <= last; ++i) section.push_back(fine_.at(i));
    return section;
  }
  // The sample of a section nearest to a level.
  Vector2d AtLevel(const Polygon& section, double level) const {
    return *std::min_element(section.begin(), section.end(), [&](const Vector2d& a, const Vector2d& b) {
      return std::abs(Down(a) - level) < std::abs(Down(b) - level);
    });
  }
  // The sample of a section that lies at a part of the straight way between its ends.
  static Vector2d AtPart(const Polygon& section, double part) {
    const Vector2d chord = section.back() - section.front();
    const auto off = [&](const Vector2d& p) {
      return std::abs((p - section.front()).dot(chord) / std::max(1e-9, chord.squaredNorm()) - part);
    };
    return *std::min_element(section.begin(), section.end(),
                             [&](const Vector2d& a, const Vector2d& b) { return off(a) < off(b); });
  }

 private:
  SampledOutline fine_;
  Vector2d upper_;
  Vector2d down_;
};

class PointSet {
 public:
  PointSet(GarmentKind kind, GarmentSide side) : kind_(kind), side_(side) {}
  // Names are those of the wearer's left; `image_left` says where the point lies.
  void Add(const std::string& left_name, bool image_left, const Vector2d& pixel, double confidence) {
    const std::string name = IsWearersLeft(image_left, side_) ? left_name : TwinPointName(kind_, left_name);
    points_[name] = {name, pixel, confidence};
  }
  void AddMiddle(const std::string& name, const Vector2d& pixel, double confidence) {
    points_[name] = {name, pixel, confidence};
  }
  std::vector<OutlinePoint> InOrder(const Polygon& outline) const {
    std::vector<OutlinePoint> ordered;
    for (const std::string& name : OutlinePointNames(kind_)) {
      FR_CHECK(points_.contains(name));
      OutlinePoint point = points_.at(name);
      point.pixel = NearestPlace(outline, point.pixel).pixel;
      ordered.push_back(std::move(point));
    }
    return ordered;
  }

 private:
  GarmentKind kind_;
  GarmentSide side_;
  std::map<std::string, OutlinePoint> points_;
};

// Corners of a skirt, in the order of its template.
enum SkirtCorner { kSkirtWaistRight, kSkirtHemRight, kSkirtHemLeft, kSkirtWaistLeft };

std::vector<OutlinePoint> PlaceSkirtPoints(const Polygon& outline, const CornerMatch& match, GarmentSide side,
                                           double length) {
  const auto& pixel = match.pixel;
  const auto& sure = match.confidence;
  const Traced traced(outline, match.height, 0.5 * (pixel[kSkirtWaistLeft] + pixel[kSkirtWaistRight]),
                      0.5 * (pixel[kSkirtHemLeft] + pixel[kSkirtHemRight]));
  const double hem_level = 0.5 * (traced.Down(pixel[kSkirtHemLeft]) + traced.Down(pixel[kSkirtHemRight]));
  const double hip_level = std::min(kSkirtHip / length, 0.6) * hem_level;
  const Polygon waist = traced.Section(pixel[kSkirtWaistLeft], pixel[kSkirtWaistRight]);
  const Polygon hem = traced.Section(pixel[kSkirtHemRight], pixel[kSkirtHemLeft]);
  PointSet points(GarmentKind::kSkirt, side);
  points.AddMiddle("waist_centre", Traced::AtPart(waist, 0.5),
                   0.95 * std::min(sure[kSkirtWaistLeft], sure[kSkirtWaistRight]));
  points.AddMiddle("hem_centre", Traced::AtPart(hem, 0.5), 0.95 * std::min(sure[kSkirtHemLeft], sure[kSkirtHemRight]));
  for (const bool left : {true, false}) {
    const size_t upper = left ? kSkirtWaistLeft : kSkirtWaistRight, lower = left ? kSkirtHemLeft : kSkirtHemRight;
    points.Add("e1", left, pixel[upper], sure[upper]);
    points.Add("e2", left, pixel[lower], sure[lower]);
    points.Add("waist_quarter_L", left, Traced::AtPart(waist, left ? 0.25 : 0.75), 0.95 * sure[upper]);
    points.Add("hem_quarter_L", left, Traced::AtPart(hem, left ? 0.75 : 0.25), 0.95 * sure[lower]);
    const Polygon seam = left ? traced.Section(pixel[lower], pixel[upper]) : traced.Section(pixel[upper], pixel[lower]);
    const double confidence = 0.9 * std::min(sure[upper], sure[lower]);
    points.Add("hip_L", left, traced.AtLevel(seam, hip_level), confidence);
    const double end_level = traced.Down(pixel[lower]);
    for (int i = 1; i <= 5; ++i) {
      const double level = hip_level + i / 6.0 * (end_level - hip_level);
      points.Add("side_" + std::to_string(i) + "_L", left, traced.AtLevel(seam, level), confidence);
    }
  }
  return points.InOrder(outline);
}

// Corners of trousers, in the order of their template.
enum LegCorner { kLegWaistRight, kOuterRight, kInnerRight, kCrotch, kInnerLeft, kOuterLeft, kLegWaistLeft };

std::vector<OutlinePoint> PlaceLegPoints(GarmentKind kind, const Polygon& outline, const CornerMatch& match,
                                         GarmentSide side) {
  const auto& pixel = match.pixel;
  const auto& sure = match.confidence;
  const Traced traced(outline, match.height, 0.5 * (pixel[kLegWaistLeft] + pixel[kLegWaistRight]),
                      0.5 * (pixel[kOuterLeft] + pixel[kOuterRight]));
  const Polygon waist = traced.Section(pixel[kLegWaistLeft], pixel[kLegWaistRight]);
  const double crotch_level = traced.Down(pixel[kCrotch]);
  PointSet points(kind, side);
  points.AddMiddle("crotch", pixel[kCrotch], sure[kCrotch]);
  points.AddMiddle("waist_centre", Traced::AtPart(waist, 0.5),
                   0.95 * std::min(sure[kLegWaistLeft], sure[kLegWaistRight]));
  for (const bool left : {true, false}) {
    const size_t upper = left ? kLegWaistLeft : kLegWaistRight, outer = left ? kOuterLeft : kOuterRight,
                 inner = left ? kInnerLeft : kInnerRight;
    points.Add("e1", left, pixel[upper], sure[upper]);
    points.Add("e2", left, pixel[outer], sure[outer]);
    points.Add("hem_inner_L", left, pixel[inner], sure[inner]);
    const Polygon outseam =
        left ? traced.Section(pixel[outer], pixel[upper]) : traced.Section(pixel[upper], pixel[outer]);
    const Polygon inseam =
        left ? traced.Section(pixel[kCrotch], pixel[inner]) : traced.Section(pixel[inner], pixel[kCrotch]);
    const Polygon hem = left ? traced.Section(pixel[inner], pixel[outer]) : traced.Section(pixel[outer], pixel[inner]);
    points.Add("hem_mid_L", left, Traced::AtPart(hem, 0.5), 0.95 * std::min(sure[inner], sure[outer]));
    const double confidence = 0.9 * std::min({sure[upper], sure[outer], sure[kCrotch]});
    points.Add("hip_L", left, traced.AtLevel(outseam, kTrouserHipPart * crotch_level), confidence);
    points.Add("crotch_level_L", left, traced.AtLevel(outseam, crotch_level), confidence);
    const double hem_level = 0.5 * (traced.Down(pixel[inner]) + traced.Down(pixel[outer]));
    for (const auto& [name, part] : {std::pair("thigh", 0.25), std::pair("knee", 0.5)}) {
      const double level = crotch_level + part * (hem_level - crotch_level);
      points.Add(std::string(name) + "_outer_L", left, traced.AtLevel(outseam, level), confidence);
      points.Add(std::string(name) + "_inner_L", left, traced.AtLevel(inseam, level), confidence);
    }
  }
  return points.InOrder(outline);
}

// The level of a dress's waist: where it is narrowest, if it narrows.
double WaistLevel(const Traced& traced, const Polygon& left_side, const Polygon& right_side, double underarm,
                  double pixel_per_metre, double hem_level) {
  const auto width = [&](double level) {
    return (traced.AtLevel(left_side, level) - traced.AtLevel(right_side, level)).norm();
  };
  const double side = hem_level - underarm;
  const double usual = underarm + std::min(kDressWaist * pixel_per_metre, 0.4 * side);
  const double first = underarm + std::min(kDressWaistLeast * pixel_per_metre, 0.2 * side);
  const double last = underarm + std::min(kDressWaistMost * pixel_per_metre, 0.6 * side);
  double best = usual;
  for (int i = 0; i <= 24; ++i) {
    const double level = first + i / 24.0 * (last - first);
    if (width(level) < width(best)) best = level;
  }
  const bool narrows = width(best) < 0.97 * width(first) && width(best) < 0.97 * width(last);
  return narrows ? best : usual;
}

}  // namespace

std::vector<OutlinePoint> PlaceBottomPoints(GarmentKind kind, const Polygon& outline, const CornerMatch& match,
                                            GarmentSide side, double length) {
  if (kind == GarmentKind::kSkirt) return PlaceSkirtPoints(outline, match, side, length);
  return PlaceLegPoints(kind, outline, match, side);
}

std::vector<OutlinePoint> PlaceDressPoints(GarmentKind kind, const Polygon& outline, const TopCorners& corners,
                                           const Neckline& neckline, GarmentSide side, double length) {
  const auto& pixel = corners.pixel;
  const auto& sure = corners.confidence;
  const Traced traced(outline, corners.height, 0.5 * (pixel[kNeckLeft] + pixel[kNeckRight]),
                      0.5 * (pixel[kHemLeft] + pixel[kHemRight]));
  const double pixel_per_metre = LengthInPixels(corners) / length;
  const double underarm = 0.5 * (traced.Down(pixel[kUnderarmLeft]) + traced.Down(pixel[kUnderarmRight]));
  const double hem_level = 0.5 * (traced.Down(pixel[kHemLeft]) + traced.Down(pixel[kHemRight]));
  const Polygon left_side = traced.Section(pixel[kHemLeft], pixel[kUnderarmLeft]);
  const Polygon right_side = traced.Section(pixel[kUnderarmRight], pixel[kHemRight]);
  const double waist = WaistLevel(traced, left_side, right_side, underarm, pixel_per_metre, hem_level);
  const double hip = waist + std::min(kHipBelowWaist * pixel_per_metre, 0.6 * (hem_level - waist));
  const Polygon hem = traced.Section(pixel[kHemRight], pixel[kHemLeft]);

  // Neck ends, shoulder, hem centre and neck drop are those of a shirt.
  std::map<std::string, OutlinePoint> shirt;
  for (OutlinePoint& point : PlaceTopPoints(outline, corners, neckline, side, kDressArmhole))
    shirt[point.name] = std::move(point);
  PointSet points(kind, side);
  for (const char* name : {"hem_centre", "neck_drop"}) {
    points.AddMiddle(name, shirt[name].pixel, shirt[name].confidence);
  }
  const auto take = [&](const char* shirts, const char* ours, bool left) {
    const OutlinePoint& point =
        shirt[IsWearersLeft(left, side) ? std::string(shirts) : TwinPointName(GarmentKind::kTShirt, shirts)];
    points.Add(ours, left, point.pixel, point.confidence);
  };
  for (const bool left : {true, false}) {
    const auto at = [left](TopCorner of_left) -> size_t {
      return static_cast<size_t>(left ? of_left : kTopCornerCount - 1 - of_left);
    };
    for (const char* name : {"P2", "e1", "underarm_L", "hem_L"}) take(name, name, left);
    const Polygon& seam = left ? left_side : right_side;
    const double confidence = 0.9 * std::min(sure[at(kUnderarmLeft)], sure[at(kHemLeft)]);
    points.Add("waist_L", left, traced.AtLevel(seam, waist), confidence);
    points.Add("hip_L", left, traced.AtLevel(seam, hip), confidence);
    points.Add("hem_quarter_L", left, Traced::AtPart(hem, left ? 0.75 : 0.25), 0.95 * sure[at(kHemLeft)]);
    if (kind == GarmentKind::kOnePiece) {
      const Vector2d &tip = pixel[at(kSleeveTopLeft)], &under = pixel[at(kUnderarmLeft)];
      points.Add("e2", left, tip, sure[at(kSleeveTopLeft)]);
      const Polygon armhole = left ? traced.Section(under, tip) : traced.Section(tip, under);
      points.Add("armhole_L", left, armhole[armhole.size() / 2], 0.95 * sure[at(kUnderarmLeft)]);
      points.Add("skirt_L", left, traced.AtLevel(seam, 0.5 * (hip + hem_level)), confidence);
    } else {
      take("e3", "e2", left);
      take("e4", "sleeve_top_L", left);
      take("sleeve_bottom_L", "sleeve_bottom_L", left);
    }
  }
  return points.InOrder(outline);
}

std::vector<OutlinePoint> PlaceSideFoldedPoints(const Polygon& outline, const CornerMatch& match) {
  FR_CHECK(match.pixel.size() == 5);
  // Waist at the outseam, outer and inner hem, crotch, waist at the crotch seam.
  const auto& pixel = match.pixel;
  const Traced traced(outline, match.height, 0.5 * (pixel[0] + pixel[4]), 0.5 * (pixel[1] + pixel[2]));
  const double knee = 0.5 * (traced.Down(pixel[3]) + 0.5 * (traced.Down(pixel[1]) + traced.Down(pixel[2])));
  const double confidence = 0.9 * std::min({match.confidence[1], match.confidence[2], match.confidence[3]});
  std::map<std::string, OutlinePoint> points = {
      {"waist_side", {"waist_side", pixel[0], match.confidence[0]}},
      {"hem_outer", {"hem_outer", pixel[1], match.confidence[1]}},
      {"hem_inner", {"hem_inner", pixel[2], match.confidence[2]}},
      {"crotch", {"crotch", pixel[3], match.confidence[3]}},
      {"waist_centre", {"waist_centre", pixel[4], match.confidence[4]}},
      {"knee_outer", {"knee_outer", traced.AtLevel(traced.Section(pixel[0], pixel[1]), knee), confidence}},
      {"knee_inner", {"knee_inner", traced.AtLevel(traced.Section(pixel[2], pixel[3]), knee), confidence}}};
  std::vector<OutlinePoint> ordered;
  for (const std::string& name : SideFoldedPointNames()) {
    OutlinePoint point = points.at(name);
    point.pixel = NearestPlace(outline, point.pixel).pixel;
    ordered.push_back(std::move(point));
  }
  return ordered;
}

}  // namespace fitroom::shop_catalog
