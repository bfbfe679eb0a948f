#include "tests/fit_client/panels/drawn_kinds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace fitroom::testing {
namespace {

using Curve = std::function<Eigen::Vector2d(double)>;  // From t = 0 to 1.
using Transform = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

struct Stroke {
  Curve curve;
  std::vector<std::pair<double, std::string>> at;  // Named points by t.
};
using Half = std::vector<Stroke>;  // The left half from the upper opening's middle to the lower one's or the crotch.

Curve Line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return [a, b](double t) -> Eigen::Vector2d { return (1.0 - t) * a + t * b; };
}

// The quadratic Bezier curve.
Curve Bow(const Eigen::Vector2d& a, const Eigen::Vector2d& handle, const Eigen::Vector2d& b) {
  return
      [=](double t) -> Eigen::Vector2d { return (1.0 - t) * (1.0 - t) * a + 2.0 * t * (1.0 - t) * handle + t * t * b; };
}

// Flat from a waist's or hem's middle out to its end, lower or higher in the middle by `dip`: a parabola.
Curve Dip(double half_width, double y, double dip) {
  return [=](double t) -> Eigen::Vector2d { return {t * half_width, y - dip * (1.0 - t * t)}; };
}

Curve Reversed(const Curve& curve) {
  return [curve](double t) { return curve(1.0 - t); };
}

// Lays both halves on a table and looks at them.
GarmentView Photograph(GarmentKind kind, const Half& left_half, const Half& right_half, const Transform& lay_left,
                       const Transform& lay_right, GarmentSide side, const DrawnView& how) {
  const bool front = side == GarmentSide::kFront;
  const double tilt = how.tilt_deg * std::numbers::pi / 180.0;
  GarmentView view;
  view.side = side;
  view.metre_per_pixel = 1.0 / how.pixels_per_metre;
  view.image_width = view.image_height = static_cast<int>(1.5 * how.pixels_per_metre);
  const auto pixel_of = [&](const Eigen::Vector2d& flat, double wave) -> Eigen::Vector2d {
    Eigen::Vector2d p = flat;
    p.x() += how.sway * std::sin(5.0 * p.y()) + how.crumple * std::sin(wave);
    p.y() += how.crumple * std::cos(1.3 * wave);
    const Eigen::Vector2d seen(front ? p.x() : -p.x(), -p.y() - 0.5);
    const Eigen::Vector2d turned(std::cos(tilt) * seen.x() - std::sin(tilt) * seen.y(),
                                 std::sin(tilt) * seen.x() + std::cos(tilt) * seen.y());
    return how.pixels_per_metre * (turned + Eigen::Vector2d(0.75, 0.75));
  };

  std::map<std::string, Eigen::Vector2d> places;
  std::vector<Eigen::Vector2d> left, right;
  double arc = 0.0;
  for (size_t s = 0; s < left_half.size(); ++s) {
    const Stroke& stroke = left_half[s];
    double length = 0.0;
    for (int i = 0; i < 64; ++i) length += (stroke.curve((i + 1) / 64.0) - stroke.curve(i / 64.0)).norm();
    std::vector<double> steps;
    const int count = std::max(2, static_cast<int>(std::ceil(length * how.pixels_per_metre / 1.5)));
    for (int i = 0; i < count; ++i) steps.push_back(static_cast<double>(i) / count);
    for (const auto& [t, name] : stroke.at) steps.push_back(t);
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    for (const double t : steps) {
      const double wave = 2.0 * std::numbers::pi * (arc + t * length) / 0.06;
      const Eigen::Vector2d on_left = lay_left(stroke.curve(t));
      const Eigen::Vector2d on_right = lay_right(right_half[s].curve(t));
      left.push_back(pixel_of(on_left, wave));
      right.push_back(pixel_of({-on_right.x(), on_right.y()}, wave + 2.0));
      for (const auto& [named_t, name] : stroke.at) {
        if (named_t != t) continue;
        places[name] = left.back();
        const std::string twin = TwinPointName(kind, name);
        if (twin != name) places[twin] = right.back();
      }
    }
    arc += length;
  }
  std::vector<Eigen::Vector2d> outline = left;
  outline.insert(outline.end(), right.rbegin() + 1, right.rend() - 1);
  if (!front) std::reverse(outline.begin(), outline.end());
  view.outline = outline;
  for (const std::string& name : OutlinePointNames(kind)) view.points.push_back({name, places.at(name), 1.0});
  return view;
}

Eigen::Vector2d Same(const Eigen::Vector2d& p) { return p; }

constexpr double kSkirtHip = 0.20, kTrouserHip = 0.18;  // Below the waist (unit: metre).

Half HalfSkirt(const DrawnSkirt& s, double dip, bool left) {
  const double hem_y = -s.length + (left ? 0.0 : s.right_hem_lift);
  const Eigen::Vector2d waist(s.half_waist, 0.0), hip(s.half_hip, -kSkirtHip), hem(s.half_hem, hem_y);
  const Eigen::Vector2d handle = hip - (hem - hip) * (0.5 * kSkirtHip / (hip.y() - hem.y()));
  Half half = {{Dip(s.half_waist, 0.0, dip), {{0.0, "waist_centre"}, {0.5, "waist_quarter_L"}}},
               {Bow(waist, handle, hip), {{0.0, "e1"}, {1.0, "hip_L"}}},
               {Line(hip, hem), {{1.0, "e2"}}},
               {Reversed(Dip(s.half_hem, hem_y, s.hem_sag)), {{0.5, "hem_quarter_L"}, {1.0, "hem_centre"}}}};
  if (s.right_hem_lift > 0.0) half[3].curve = Line(hem, {0.0, -s.length + 0.5 * s.right_hem_lift});
  if (s.slit_depth > 0.0) {
    half[3].at.pop_back();
    half.push_back({Line({0.005, hem_y}, {0.0, hem_y + s.slit_depth}), {{1.0, "hem_centre"}}});
    half[3].curve = Line(hem, {0.005, hem_y});
  }
  for (int i = 1; i <= 5; ++i) half[2].at.emplace_back(i / 6.0, "side_" + std::to_string(i) + "_L");
  return half;
}

Half HalfTrousers(const DrawnTrousers& s, double dip) {
  const double hem_y = -s.length;
  const Eigen::Vector2d waist(s.half_waist, 0.0), hip(s.half_hip, -kTrouserHip), crotch(0.0, -s.crotch);
  const Eigen::Vector2d outer(s.outer_hem, hem_y), inner(s.inner_hem, hem_y);
  const Eigen::Vector2d handle = hip - (outer - hip) * (0.5 * kTrouserHip / (hip.y() - outer.y()));
  const double level_t = (s.crotch - kTrouserHip) / (-hem_y - kTrouserHip);
  const auto below_crotch = [&](double share) { return level_t + share * (1.0 - level_t); };
  return {{Dip(s.half_waist, 0.0, dip), {{0.0, "waist_centre"}}},
          {Bow(waist, handle, hip), {{0.0, "e1"}, {1.0, "hip_L"}}},
          {Line(hip, outer),
           {{level_t, "crotch_level_L"},
            {below_crotch(0.25), "thigh_outer_L"},
            {below_crotch(0.5), "knee_outer_L"},
            {1.0, "e2"}}},
          {Line(outer, inner), {{0.5, "hem_mid_L"}, {1.0, "hem_inner_L"}}},
          {Line(inner, crotch), {{0.5, "knee_inner_L"}, {0.75, "thigh_inner_L"}, {1.0, "crotch"}}}};
}

Half HalfDress(const DrawnDress& s, bool front) {
  const double drop = front ? s.front_drop : s.back_drop;
  const Curve neckline = [=](double t) -> Eigen::Vector2d {
    if (front && s.v_neck) return {t * s.half_neck, (t - 1.0) * drop};
    const double angle = 0.5 * std::numbers::pi * t;
    return {s.half_neck * std::sin(angle), -drop * std::cos(angle)};
  };
  const Eigen::Vector2d neck(s.half_neck, 0.0), waist(s.half_waist, -0.42), hip(s.half_hip, -0.62);
  const Eigen::Vector2d hem(s.half_hem, -s.length);
  const Eigen::Vector2d handle = hip - (hem - hip) * (0.1 / (hip.y() - hem.y()));
  const double armhole = front ? s.front_armhole : s.back_armhole;
  const Eigen::Vector2d armhole_handle(2.0 * armhole - 0.5 * (s.shoulder_tip.x() + s.underarm.x()), -0.2);
  const char* half_way = s.sleeved ? "" : "skirt_L";
  Half half = {{neckline, {{0.0, "neck_drop"}, {1.0, "P2"}}}, {Line(neck, s.shoulder_tip), {{0.1, "e1"}, {1.0, "e2"}}}};
  if (s.sleeved) {
    half.push_back({Line(s.shoulder_tip, s.sleeve_top), {{1.0, "sleeve_top_L"}}});
    half.push_back({Line(s.sleeve_top, s.sleeve_bottom), {{1.0, "sleeve_bottom_L"}}});
    half.push_back({Line(s.sleeve_bottom, s.underarm), {{1.0, "underarm_L"}}});
  } else {
    half.push_back({Bow(s.shoulder_tip, armhole_handle, s.underarm), {{0.5, "armhole_L"}, {1.0, "underarm_L"}}});
  }
  half.push_back({Bow(s.underarm, {s.half_waist, -0.34}, waist), {{1.0, "waist_L"}}});
  half.push_back({Bow(waist, handle, hip), {{1.0, "hip_L"}}});
  half.push_back({Line(hip, hem), {{0.5, half_way}, {1.0, "hem_L"}}});
  half.push_back({Line(hem, {0.0, hem.y()}), {{0.5, "hem_quarter_L"}, {1.0, "hem_centre"}}});
  return half;
}

template <typename Drawn>
Garment Both(GarmentKind kind, const Drawn& drawn, const DrawnView& front, const DrawnView& back) {
  Garment garment;
  garment.id = "drawn";
  garment.kind = kind;
  garment.length = drawn.length;
  garment.front = DrawView(drawn, GarmentSide::kFront, front);
  garment.back = DrawView(drawn, GarmentSide::kBack, back);
  return garment;
}

}  // namespace

GarmentView DrawView(const DrawnSkirt& skirt, GarmentSide side, const DrawnView& view) {
  const double dip = side == GarmentSide::kFront ? skirt.front_dip : skirt.back_dip;
  DrawnSkirt right = skirt;
  right.half_hip *= skirt.right_hip_share;
  right.half_hem *= skirt.right_hip_share;
  return Photograph(GarmentKind::kSkirt, HalfSkirt(skirt, dip, true), HalfSkirt(right, dip, false), Same, Same, side,
                    view);
}

GarmentView DrawView(const DrawnTrousers& trousers, GarmentSide side, const DrawnView& view, double leg_turn_deg) {
  const double dip = side == GarmentSide::kFront ? trousers.front_dip : trousers.back_dip;
  const Half half = HalfTrousers(trousers, dip);
  // Each leg is turned about the middle of its upper end, smoothly over 25 cm.
  const auto turn = [&](double degrees) -> Transform {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Eigen::Vector2d pivot(0.5 * trousers.half_hip, -trousers.crotch);
    return [=](const Eigen::Vector2d& p) -> Eigen::Vector2d {
      const double t = std::clamp((pivot.y() - p.y()) / 0.25, 0.0, 1.0);
      const double a = angle * t * t * (3.0 - 2.0 * t);
      const Eigen::Vector2d arm = p - pivot;
      return pivot + Eigen::Vector2d(std::cos(a) * arm.x() - std::sin(a) * arm.y(),
                                     std::sin(a) * arm.x() + std::cos(a) * arm.y());
    };
  };
  return Photograph(GarmentKind::kPants, half, half, turn(leg_turn_deg - view.sleeve_turn_deg),
                    turn(leg_turn_deg + view.sleeve_turn_deg), side, view);
}

GarmentView DrawView(const DrawnDress& dress, GarmentSide side, const DrawnView& view) {
  const Half half = HalfDress(dress, side == GarmentSide::kFront);
  return Photograph(dress.sleeved ? GarmentKind::kSleevedOnePiece : GarmentKind::kOnePiece, half, half, Same, Same,
                    side, view);
}

Garment DrawGarment(const DrawnSkirt& skirt, const DrawnView& front, const DrawnView& back) {
  return Both(GarmentKind::kSkirt, skirt, front, back);
}

Garment DrawGarment(const DrawnTrousers& trousers, const DrawnView& front, const DrawnView& back) {
  return Both(GarmentKind::kPants, trousers, front, back);
}

Garment DrawGarment(const DrawnDress& dress, const DrawnView& front, const DrawnView& back) {
  return Both(dress.sleeved ? GarmentKind::kSleevedOnePiece : GarmentKind::kOnePiece, dress, front, back);
}

Garment DrawKind(GarmentKind kind, const DrawnView& front, const DrawnView& back) {
  Garment garment;
  if (kind == GarmentKind::kSkirt) {
    garment = DrawGarment(DrawnSkirt(), front, back);
  } else if (kind == GarmentKind::kPants) {
    garment = DrawGarment(DrawnTrousers(), front, back);
  } else if (kind == GarmentKind::kShorts) {
    DrawnTrousers shorts;
    shorts.length = 0.45;
    shorts.inner_hem = 0.03;
    shorts.outer_hem = 0.29;
    garment = DrawGarment(shorts, front, back);
  } else if (kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece) {
    DrawnDress dress;
    dress.sleeved = kind == GarmentKind::kSleevedOnePiece;
    garment = DrawGarment(dress, front, back);
  } else {
    DrawnTShirt shirt;
    if (kind == GarmentKind::kLongSleeve) {
      shirt.sleeve_top = {0.62, -0.42};
      shirt.sleeve_bottom = {0.55, -0.50};
    }
    garment = DrawGarment(shirt, front, back);
  }
  garment.kind = kind;
  return garment;
}

}  // namespace fitroom::testing
