#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/check.h"
#include "shop_catalog/garment/garment_shape.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// Below the underarm on a dress; a shirt has its waist and hip at parts of its side (unit: centimetre).
constexpr double kDressWaist = 16.5;
constexpr double kDressHip = 36.5;
constexpr double kShirtWaistPart = 0.42;
constexpr double kShirtHipPart = 0.85;
constexpr double kChestBelowUnderarm = 2.5;  // Where a chest's width is measured (unit: centimetre).

bool IsDress(GarmentKind kind) { return kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece; }

double Cm(const std::vector<GarmentMeasure>& measures, const char* name) {
  const GarmentMeasure* measure = FindMeasure(measures, name);
  FR_CHECK(measure != nullptr);
  return 100.0 * measure->value;
}

// A neckline of that drop between the neck ends: steep at the ends, round at the bottom.
FlatCurve MakeNeckline(double half_width, double drop, double steepness) {
  FlatCurve right = {Vector2d(0.0, drop)};
  AppendCurve(right, Vector2d(0.56 * half_width, drop),
              Vector2d(half_width - 0.15 * half_width * (1.0 - steepness), drop * (1.0 - 0.62 * steepness)),
              Vector2d(half_width, 0.0));
  FlatCurve whole = MirrorReversed(right);
  Join(whole, right);
  return whole;
}

// Heights of waist and hip.
struct Levels {
  double underarm, waist, hip, hem;
};

Levels LevelsOf(GarmentKind kind, double underarm, double length) {
  if (IsDress(kind)) return {underarm, underarm + kDressWaist, underarm + kDressHip, length};
  const double side = length - underarm;
  return {underarm, underarm + kShirtWaistPart * side, underarm + kShirtHipPart * side, length};
}

// The sleeve hangs from the shoulder tip: short ones stand out, long ones lie along the body.
void LayOutSleeve(const std::vector<GarmentMeasure>& measures, const Vector2d& tip, GarmentShape& shape) {
  const bool is_long = shape.kind == GarmentKind::kLongSleeve;
  shape.sleeve_axis = is_long ? Vector2d(0.6, 0.8) : Vector2d(0.839, 0.545);
  const Vector2d inwards(-shape.sleeve_axis.y(), shape.sleeve_axis.x());
  const Vector2d top = tip + Cm(measures, "sleeve_length") * shape.sleeve_axis;
  // The end is cut a little aslant.
  const Vector2d across = (0.997 * inwards + 0.078 * shape.sleeve_axis).normalized();
  shape.sleeve_end = {top};
  AppendArc(shape.sleeve_end, top + Cm(measures, "sleeve_opening") * across, 0.3);
}

void PlacePoints(const Levels& levels, GarmentShape& shape) {
  const Vector2d neck_end = shape.front_neckline.back();
  const Vector2d tip = shape.armhole.front();
  // Told apart from the neck end on the way round even of long sleeves.
  const double off = std::max(1.5, 0.007 * CurveLength(shape.outline));
  const Vector2d at_neck = neck_end + off * (tip - neck_end).normalized();
  std::map<std::string, Vector2d> points;
  // The wearer's left is on a front's right.
  const auto set = [&](const std::string& left_name, const Vector2d& on_right) {
    points[left_name] = on_right;
    points[TwinPointName(shape.kind, left_name)] = MirrorX(on_right);
  };
  set("P2", neck_end);
  set("e1", at_neck);
  if (IsDress(shape.kind)) {
    set("e2", tip);
    set("hem_quarter_L", AtPart(shape.hem, 0.75));
  } else {
    set("e2", 0.5 * (at_neck + tip));
    set("e3", tip);
  }
  if (shape.kind == GarmentKind::kOnePiece) {
    set("armhole_L", AtPart(shape.armhole, 0.5));
    set("skirt_L", AtHeight(shape.side, 0.5 * (levels.hip + levels.hem)));
  } else {
    set(IsDress(shape.kind) ? "sleeve_top_L" : "e4", shape.sleeve_end.front());
    set("sleeve_bottom_L", shape.sleeve_end.back());
  }
  set("underarm_L", shape.side.front());
  set("waist_L", AtHeight(shape.side, levels.waist));
  set("hip_L", AtHeight(shape.side, levels.hip));
  set("hem_L", shape.side.back());
  points["hem_centre"] = AtPart(shape.hem, 0.5);
  points["neck_drop"] = shape.front_neckline[shape.front_neckline.size() / 2];
  for (const std::string& name : OutlinePointNames(shape.kind)) shape.points.emplace_back(name, points.at(name));
}

}  // namespace

GarmentShape MakeTorsoShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  const double chest = Cm(measures, "chest_width");
  const double width = chest / 48.0;  // Against a T-shirt of 48 cm chest, from which the proportions are taken.
  const double neck = 0.5 * Cm(measures, "neck_width");
  GarmentShape shape;
  shape.kind = kind;
  shape.length = Cm(measures, "front_length");
  const double half_shoulder = std::max(0.5 * Cm(measures, "shoulder_width"), neck + 4.0);
  const Vector2d neck_end(neck, 0.0), tip(half_shoulder, 0.37 * (half_shoulder - neck));
  const Levels levels = LevelsOf(kind, tip.y() + 20.0 * (0.4 + 0.6 * width), shape.length);
  const Vector2d underarm(0.5 * chest, levels.underarm);

  const bool is_dress = IsDress(kind);
  shape.front_neckline = MakeNeckline(neck, (is_dress ? 11.5 : 9.0) + 0.6 * width, 1.0);
  shape.back_neckline = MakeNeckline(neck, is_dress ? 3.0 : 2.2, 0.2);
  shape.side = Profile({underarm, Vector2d(0.5 * chest, levels.underarm + kChestBelowUnderarm),
                        Vector2d(0.5 * Cm(measures, "waist_width"), levels.waist),
                        Vector2d(0.5 * Cm(measures, "hip_width"), levels.hip),
                        Vector2d(0.5 * Cm(measures, "hem_width"), levels.hem)});
  shape.hem = {MirrorX(shape.side.back())};
  AppendArc(shape.hem, shape.side.back(), is_dress ? -1.4 : -0.5);

  FlatCurve half = {neck_end};
  AppendArc(half, tip, is_dress ? 0.0 : -0.25);
  shape.armhole = {tip};
  if (kind == GarmentKind::kOnePiece) {
    AppendCurve(shape.armhole, Vector2d(tip.x() - 1.4, tip.y() + 8.5), Vector2d(tip.x() - 0.6, underarm.y() - 1.2),
                underarm);
    Join(half, shape.armhole);
  } else {
    AppendCurve(shape.armhole, Vector2d(tip.x() - 1.6, tip.y() + 7.0), Vector2d(tip.x() - 1.2, underarm.y() - 5.0),
                underarm);
    LayOutSleeve(measures, tip, shape);
    AppendArc(half, shape.sleeve_end.front(), kind == GarmentKind::kLongSleeve ? 0.9 : 0.5);
    Join(half, shape.sleeve_end);
    AppendArc(half, underarm, 0.25);
  }
  Join(half, shape.side);
  shape.outline = shape.back_neckline;
  Join(shape.outline, half);
  Join(shape.outline, Reversed(shape.hem));
  Join(shape.outline, MirrorReversed(half));
  shape.outline.pop_back();
  PlacePoints(levels, shape);
  return shape;
}

std::vector<std::pair<std::string, Vector2d>> PointsOnShape(const GarmentShape& shape, GarmentSide side) {
  std::vector<std::pair<std::string, Vector2d>> points = shape.points;
  if (side == GarmentSide::kFront) return points;
  for (auto& [name, place] : points) {
    place = MirrorX(place);
    if (name == "neck_drop") place = shape.back_neckline[shape.back_neckline.size() / 2];
  }
  return points;
}

GarmentShape MakeGarmentShape(GarmentKind kind, const std::vector<GarmentMeasure>& measures) {
  if (kind == GarmentKind::kSkirt) return MakeSkirtShape(measures);
  if (HasLegs(kind)) return MakeTrouserShape(kind, measures);
  return MakeTorsoShape(kind, measures);
}

}  // namespace fitroom::shop_catalog
