#include "shop_catalog/garment/tshirt_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "common/base/check.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

Status CheckRange(const char* option, double value, double least, double most) {
  // Written so that it also fails for NaN.
  if (value >= least - 1e-9 && value <= most + 1e-9) return {};
  std::array<char, 120> text;
  std::snprintf(text.data(), text.size(), "%s %.6g is out of range: give %g to %g cm", option, 100 * value, 100 * least,
                100 * most);
  return InvalidArgument("MEASURE_OUT_OF_RANGE", text.data());
}

// Appends a cubic Bezier curve without its first point.
void AppendCurve(FlatCurve& curve, const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  constexpr int kSteps = 32;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps, s = 1.0 - t;
    curve.push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
  }
}

// Appends a curve that leaves the straight line by `bulge` to its left, seen in its direction (y down).
void AppendArc(FlatCurve& curve, const Vector2d& end, double bulge) {
  const Vector2d start = curve.back();
  const Vector2d along = end - start;
  const Vector2d left = Vector2d(along.y(), -along.x()).normalized() * (bulge * 4.0 / 3.0);
  AppendCurve(curve, start, start + along / 3.0 + left, start + along * (2.0 / 3.0) + left, end);
}

FlatCurve Mirrored(const FlatCurve& curve) {
  FlatCurve mirrored(curve.rbegin(), curve.rend());
  for (Vector2d& point : mirrored) point.x() = -point.x();
  return mirrored;
}

// A neckline of that drop between the neck ends: steep at the ends, round at the bottom.
FlatCurve MakeNeckline(double half_width, double drop, double steepness) {
  FlatCurve right = {Vector2d(0.0, drop)};
  AppendCurve(right, Vector2d(0.0, drop), Vector2d(0.56 * half_width, drop),
              Vector2d(half_width - 0.15 * half_width * (1.0 - steepness), drop * (1.0 - 0.62 * steepness)),
              Vector2d(half_width, 0.0));
  FlatCurve whole = Mirrored(right);
  whole.insert(whole.end(), right.begin() + 1, right.end());
  return whole;
}

// Returns the point where the curve is nearest to `height`.
Vector2d AtHeight(const FlatCurve& curve, double height) {
  return *std::min_element(curve.begin(), curve.end(), [height](const Vector2d& a, const Vector2d& b) {
    return std::abs(a.y() - height) < std::abs(b.y() - height);
  });
}

Vector2d MirrorX(const Vector2d& point) { return {-point.x(), point.y()}; }

}  // namespace

Status ValidateTShirtMeasures(const TShirtMeasures& measures) {
  FR_RETURN_IF_ERROR(CheckRange("--length-cm", measures.length, 0.45, 0.95));
  FR_RETURN_IF_ERROR(CheckRange("--chest-cm", measures.chest, 0.34, 0.80));
  FR_RETURN_IF_ERROR(CheckRange("--sleeve-cm", measures.sleeve, 0.10, 0.32));
  return {};
}

TShirtShape MakeTShirtShape(const TShirtMeasures& measures) {
  // Proportions of a regular-fit T-shirt of 48 cm chest and 68 cm length.
  const double length = 100.0 * measures.length;
  const double half_chest = 50.0 * measures.chest;
  const double width = half_chest / 24.0;
  const double neck = 8.0 + 1.1 * width;
  const Vector2d neck_end(neck, 0.0);
  const Vector2d tip(20.6 * (0.35 + 0.65 * width), 4.3);
  const Vector2d underarm(half_chest, tip.y() + 20.0 * (0.4 + 0.6 * width));
  const Vector2d sleeve_axis(0.839, 0.545);
  const Vector2d sleeve_top = tip + 100.0 * measures.sleeve * sleeve_axis;
  const Vector2d sleeve_bottom = sleeve_top + 16.4 * (0.5 + 0.5 * width) * Vector2d(-0.47, 0.883);
  const Vector2d hem_corner(half_chest + 0.2, length);

  TShirtShape shape;
  shape.sleeve_axis = sleeve_axis;
  shape.front_neckline = MakeNeckline(neck, 9.0 + 0.6 * width, 1.0);
  shape.back_neckline = MakeNeckline(neck, 2.2, 0.2);
  shape.armhole = {tip};
  AppendCurve(shape.armhole, tip, Vector2d(tip.x() - 1.6, tip.y() + 7.0), Vector2d(tip.x() - 1.2, underarm.y() - 5.0),
              underarm);
  shape.sleeve_end = {sleeve_top};
  AppendArc(shape.sleeve_end, sleeve_bottom, 0.3);
  FlatCurve half = {neck_end};
  AppendArc(half, tip, -0.25);
  AppendArc(half, sleeve_top, 0.5);
  half.insert(half.end(), shape.sleeve_end.begin() + 1, shape.sleeve_end.end());
  AppendArc(half, underarm, 0.25);
  AppendArc(half, hem_corner, -0.7);
  shape.hem = {MirrorX(hem_corner)};
  AppendArc(shape.hem, Vector2d(hem_corner), -0.5);

  shape.outline = shape.back_neckline;
  shape.outline.insert(shape.outline.end(), half.begin() + 1, half.end());
  shape.outline.insert(shape.outline.end(), shape.hem.rbegin() + 1, shape.hem.rend());
  const FlatCurve left = Mirrored(half);
  shape.outline.insert(shape.outline.end(), left.begin() + 1, left.end() - 1);
  return shape;
}

std::vector<std::pair<std::string, Vector2d>> PointsOnShape(const TShirtShape& shape, GarmentSide side) {
  const double length = shape.hem.back().y();
  const Vector2d neck_end = shape.front_neckline.back();
  const Vector2d tip = shape.armhole.front(), underarm = shape.armhole.back();
  // The side seam: the outline's points between underarm and hem on the right.
  FlatCurve side_seam;
  const double tolerance = 2.0;
  for (const Vector2d& point : shape.outline) {
    if (std::abs(point.x() - underarm.x()) < tolerance && point.y() > underarm.y()) side_seam.push_back(point);
  }
  FR_CHECK(!side_seam.empty());
  const auto on_side = [&](double part) { return AtHeight(side_seam, underarm.y() + part * (length - underarm.y())); };
  const Vector2d at_neck = neck_end + 0.022 * length * (tip - neck_end).normalized();

  // Names of the right of the image, then what they are on the left: on a front the wearer's left is on the right.
  std::map<std::string, Vector2d> points;
  const bool is_front = side == GarmentSide::kFront;
  const auto set = [&](const char* left_name, const char* right_name, const Vector2d& on_right) {
    points[left_name] = is_front ? on_right : MirrorX(on_right);
    points[right_name] = is_front ? MirrorX(on_right) : on_right;
  };
  set("P2", "P1", neck_end);
  set("e1", "e5", at_neck);
  set("e2", "e6", 0.5 * (at_neck + tip));
  set("e3", "e7", tip);
  set("e4", "e8", shape.sleeve_end.front());
  set("sleeve_bottom_L", "sleeve_bottom_R", shape.sleeve_end.back());
  set("underarm_L", "underarm_R", underarm);
  set("waist_L", "waist_R", on_side(0.42));
  set("hip_L", "hip_R", on_side(0.85));
  set("hem_L", "hem_R", shape.hem.back());
  points["hem_centre"] = shape.hem[shape.hem.size() / 2];
  const FlatCurve& neckline = is_front ? shape.front_neckline : shape.back_neckline;
  points["neck_drop"] = neckline[neckline.size() / 2];
  std::vector<std::pair<std::string, Vector2d>> ordered;
  for (const std::string& name : OutlinePointNames(GarmentKind::kTShirt)) ordered.emplace_back(name, points.at(name));
  return ordered;
}

}  // namespace fitroom::shop_catalog
