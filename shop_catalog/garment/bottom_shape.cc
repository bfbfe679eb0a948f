#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/check.h"
#include "shop_catalog/garment/fork_draft.h"
#include "shop_catalog/garment/garment_shape.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

constexpr double kSkirtHip = 20.0;           // Below the waist (unit: centimetre).
constexpr double kTrouserHipPart = 2.0 / 3;  // Of the crotch depth.
constexpr double kWaistDip = 0.8;            // The waist's edge is lowest in the middle (unit: centimetre).

double Cm(const std::vector<GarmentMeasure>& measures, const char* name) {
  const GarmentMeasure* measure = FindMeasure(measures, name);
  FR_CHECK(measure != nullptr);
  return 100.0 * measure->value;
}

class PointList {
 public:
  explicit PointList(GarmentKind kind) : kind_(kind) {}
  // Sets a point of the wearer's left, which is on a front's right, and its twin.
  void Set(const std::string& left_name, const Vector2d& on_right) {
    points_[left_name] = on_right;
    points_[TwinPointName(kind_, left_name)] = MirrorX(on_right);
  }
  void SetMiddle(const std::string& name, const Vector2d& place) { points_[name] = place; }
  std::vector<std::pair<std::string, Vector2d>> InOrder() const {
    std::vector<std::pair<std::string, Vector2d>> ordered;
    for (const std::string& name : OutlinePointNames(kind_)) ordered.emplace_back(name, points_.at(name));
    return ordered;
  }

 private:
  GarmentKind kind_;
  std::map<std::string, Vector2d> points_;
};

FlatCurve MakeWaist(double half_width) {
  FlatCurve waist = {Vector2d(-half_width, 0.0)};
  AppendArc(waist, Vector2d(half_width, 0.0), -kWaistDip);
  return waist;
}

}  // namespace

GarmentShape MakeSkirtShape(const std::vector<GarmentMeasure>& measures) {
  GarmentShape shape;
  shape.kind = GarmentKind::kSkirt;
  shape.length = Cm(measures, "length");
  const Vector2d waist(0.5 * Cm(measures, "waist_width"), 0.0), hem(0.5 * Cm(measures, "hem_width"), shape.length);
  const double hip_height = std::min(kSkirtHip, 0.6 * shape.length);
  shape.waist = MakeWaist(waist.x());
  shape.side = Profile({waist, Vector2d(0.5 * Cm(measures, "hip_width"), hip_height), hem});
  shape.hem = {MirrorX(hem)};
  AppendArc(shape.hem, hem, -1.6);
  shape.outline = shape.waist;
  Join(shape.outline, shape.side);
  Join(shape.outline, Reversed(shape.hem));
  Join(shape.outline, MirrorReversed(shape.side));
  shape.outline.pop_back();

  PointList points(shape.kind);
  points.Set("e1", waist);
  points.Set("e2", hem);
  points.Set("waist_quarter_L", AtPart(shape.waist, 0.75));
  points.Set("hip_L", AtHeight(shape.side, hip_height));
  for (int i = 1; i <= 5; ++i) {
    points.Set("side_" + std::to_string(i) + "_L",
               AtHeight(shape.side, hip_height + i / 6.0 * (shape.length - hip_height)));
  }
  points.Set("hem_quarter_L", AtPart(shape.hem, 0.75));
  points.SetMiddle("waist_centre", AtPart(shape.waist, 0.5));
  points.SetMiddle("hem_centre", AtPart(shape.hem, 0.5));
  shape.points = points.InOrder();
  return shape;
}

GarmentShape MakeTrouserShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  GarmentShape shape;
  shape.kind = kind;
  shape.length = Cm(measures, "length");
  const double inseam = Cm(measures, "inseam"), depth = std::max(shape.length - inseam, 0.15 * shape.length);
  const double half_hip = 0.5 * Cm(measures, "hip_width");
  const bool is_short = kind == GarmentKind::kShorts;
  const auto down_the_leg = [&](double part) { return depth + part * (shape.length - depth); };
  // Legs lie a little apart, so that their inseams are seen from the crotch down.
  const Vector2d crotch(0.0, depth);
  const Vector2d inner_knee(is_short ? 1.6 : 5.4, down_the_leg(0.5)), inner_hem(is_short ? 3.0 : 9.6, shape.length);
  const Vector2d waist(0.5 * Cm(measures, "waist_width"), 0.0);
  const Vector2d outer_hem(inner_hem.x() + Cm(measures, "hem_width"), shape.length);
  shape.waist = MakeWaist(waist.x());
  // Folding hides the fork: at the crotch's height a leg of trousers shows half the hip's width. Shorts lie wider, in a
  // line from hip to hem.
  std::vector<Vector2d> side = {waist, Vector2d(half_hip, kTrouserHipPart * depth)};
  if (!is_short) side.emplace_back(half_hip + 0.05, depth);
  side.emplace_back(inner_knee.x() + Cm(measures, "knee_width"), inner_knee.y());
  side.push_back(outer_hem);
  shape.side = Profile(side);
  shape.inseam = {crotch};
  AppendCurve(shape.inseam, crotch + Vector2d(0.5, 0.1), crotch + Vector2d(0.7, 1.0), crotch + Vector2d(0.9, 2.6));
  Join(shape.inseam, Profile({shape.inseam.back(), inner_knee, inner_hem}));
  shape.hem = {inner_hem};
  AppendArc(shape.hem, outer_hem, -0.3);

  FlatCurve half = shape.side;
  Join(half, Reversed(shape.hem));
  Join(half, Reversed(shape.inseam));
  shape.outline = shape.waist;
  Join(shape.outline, half);
  Join(shape.outline, MirrorReversed(half));
  shape.outline.pop_back();

  PointList points(kind);
  points.Set("e1", waist);
  points.Set("e2", outer_hem);
  points.Set("hip_L", AtHeight(shape.side, kTrouserHipPart * depth));
  points.Set("crotch_level_L", AtHeight(shape.side, depth));
  points.Set("thigh_outer_L", AtHeight(shape.side, down_the_leg(0.25)));
  points.Set("thigh_inner_L", AtHeight(shape.inseam, down_the_leg(0.25)));
  points.Set("knee_outer_L", AtHeight(shape.side, down_the_leg(0.5)));
  points.Set("knee_inner_L", inner_knee);
  points.Set("hem_inner_L", inner_hem);
  points.Set("hem_mid_L", AtPart(shape.hem, 0.5));
  points.SetMiddle("waist_centre", AtPart(shape.waist, 0.5));
  points.SetMiddle("crotch", crotch);
  shape.points = points.InOrder();
  return shape;
}

GarmentShape MakeSideFoldedShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  GarmentShape shape;
  shape.kind = kind;
  shape.length = Cm(measures, "length");
  const double depth = std::max(shape.length - Cm(measures, "inseam"), 0.15 * shape.length);
  const double half_waist = 0.5 * Cm(measures, "waist_width"), half_hip = 0.5 * Cm(measures, "hip_width");
  const double thigh = Cm(measures, "thigh_width"), extension = std::max(thigh - half_hip, 0.5);
  const double knee_height = 0.5 * (depth + shape.length);
  // x = 0 is the fork line, where the crotch seam comes down from the waist; the outseam is on the right. The waist is
  // taken in at the outseam.
  const Vector2d waist_centre(0.0, 0.0), waist_side(half_waist, 0.0), crotch(-extension, depth);
  const double knee = Cm(measures, "knee_width"), hem = Cm(measures, "hem_width");
  // A long leg hangs from the middle of its thigh; a short one keeps its outseam straight.
  const bool is_short = kind == GarmentKind::kShorts;
  const auto middle_of = [&](double width) { return is_short ? half_hip - 0.5 * width : 0.5 * (half_hip - extension); };
  const Vector2d knee_inner(middle_of(knee) - 0.5 * knee, knee_height), knee_outer(knee_inner.x() + knee, knee_height);
  const Vector2d hem_inner(middle_of(hem) - 0.5 * hem, shape.length), hem_outer(hem_inner.x() + hem, shape.length);
  shape.armhole = CrotchCurve(depth, extension);
  shape.waist = {waist_centre};
  AppendLine(shape.waist, waist_side);
  shape.side = Profile(
      {waist_side, Vector2d(half_hip, kTrouserHipPart * depth), Vector2d(half_hip, depth), knee_outer, hem_outer});
  shape.inseam = Profile({crotch, knee_inner, hem_inner});
  shape.hem = {hem_inner};
  AppendArc(shape.hem, hem_outer, -0.3);
  shape.outline = shape.waist;
  Join(shape.outline, shape.side);
  Join(shape.outline, Reversed(shape.hem));
  Join(shape.outline, Reversed(shape.inseam));
  Join(shape.outline, Reversed(shape.armhole));
  shape.outline.pop_back();
  shape.points = {
      {"waist_centre", waist_centre}, {"waist_side", waist_side}, {"knee_outer", knee_outer}, {"hem_outer", hem_outer},
      {"hem_inner", hem_inner},       {"knee_inner", knee_inner}, {"crotch", crotch}};
  return shape;
}

}  // namespace fitroom::shop_catalog
