#include "tests/fit_client/panels/drawn_tshirt.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace fitroom::testing {
namespace {

using Curve = std::function<Eigen::Vector2d(double)>;  // From t = 0 to 1.

struct Stroke {
  Curve curve;
  double length = 0.0;                             // About (unit: metre).
  std::vector<std::pair<double, std::string>> at;  // Named points by t.
};

Curve Line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return [a, b](double t) -> Eigen::Vector2d { return (1.0 - t) * a + t * b; };
}

// The left half from the neck's middle to the hem's middle.
std::vector<Stroke> LeftHalf(const DrawnTShirt& s, double drop) {
  const Eigen::Vector2d neck(s.half_neck, 0.0), hem(s.half_hem, -s.length);
  // A quarter ellipse for the neck; a cubic through tip and neck for the shoulder keeps the section smooth.
  const Curve neckline = [=](double t) {
    const double angle = 0.5 * std::numbers::pi * t;
    return Eigen::Vector2d(s.half_neck * std::sin(angle), -drop * std::cos(angle));
  };
  const double waist_t = (0.40 + s.underarm.y()) / (s.length + s.underarm.y());
  const Curve side = [=](double t) -> Eigen::Vector2d {
    // A parabola in x through underarm, waist and hem; y runs evenly.
    const double a = (t - waist_t) * (t - 1.0) / (waist_t);
    const double b = t * (t - 1.0) / (waist_t * (waist_t - 1.0));
    const double c = t * (t - waist_t) / (1.0 - waist_t);
    return {a * s.underarm.x() + b * s.half_waist + c * s.half_hem, (1.0 - t) * s.underarm.y() + t * hem.y()};
  };
  const Curve hem_line = [=](double t) -> Eigen::Vector2d {
    return {(1.0 - t) * hem.x(), hem.y() - s.hem_sag * t * (2.0 - t)};
  };
  return {{neckline, 0.15, {{0.0, "neck_drop"}, {1.0, "P2"}}},
          {Line(neck, s.shoulder_tip), 0.14, {{0.08, "e1"}, {0.5, "e2"}, {1.0, "e3"}}},
          {Line(s.shoulder_tip, s.sleeve_top), 0.2, {{1.0, "e4"}}},
          {Line(s.sleeve_top, s.sleeve_bottom), 0.13, {{1.0, "sleeve_bottom_L"}}},
          {Line(s.sleeve_bottom, s.underarm), 0.07, {{1.0, "underarm_L"}}},
          {side, 0.45, {{waist_t, "waist_L"}, {0.75, "hip_L"}, {1.0, "hem_L"}}},
          {hem_line, 0.26, {{1.0, "hem_centre"}}}};
}

// Turns a sleeve about the shoulder, the armhole line's neighbourhood bent smoothly.
Eigen::Vector2d TurnSleeve(const DrawnTShirt& s, const Eigen::Vector2d& p, double turn) {
  if (p.x() < s.shoulder_tip.x() || p.y() < s.sleeve_bottom.y() - 0.01) return p;
  const Eigen::Vector2d armhole = (s.underarm - s.shoulder_tip).normalized();
  const Eigen::Vector2d outwards(-armhole.y(), armhole.x());
  const double beyond = outwards.dot(p - s.shoulder_tip);
  const double weight = std::clamp(beyond / 0.03, 0.0, 1.0);
  const double angle = -turn * weight * weight * (3.0 - 2.0 * weight);
  const Eigen::Vector2d pivot = 0.5 * (s.shoulder_tip + s.underarm);
  const Eigen::Vector2d arm = p - pivot;
  return pivot + Eigen::Vector2d(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                                 std::sin(angle) * arm.x() + std::cos(angle) * arm.y());
}

}  // namespace

GarmentView DrawView(const DrawnTShirt& shirt, GarmentSide side, const DrawnView& how) {
  const bool front = side == GarmentSide::kFront;
  const double turn = how.sleeve_turn_deg * std::numbers::pi / 180.0;
  const double tilt = how.tilt_deg * std::numbers::pi / 180.0;
  GarmentView view;
  view.side = side;
  view.metre_per_pixel = 1.0 / how.pixels_per_metre;
  view.image_width = static_cast<int>(1.3 * how.pixels_per_metre);
  view.image_height = static_cast<int>(1.1 * how.pixels_per_metre);

  const auto pixel_of = [&](const Eigen::Vector2d& flat, double wave) -> Eigen::Vector2d {
    // Bend, then lay on the table, then look: x to the wearer's left is the image's right on the front only.
    Eigen::Vector2d p = flat;
    p.x() += how.sway * std::sin(5.0 * p.y()) + how.crumple * std::sin(wave);
    p.y() += how.crumple * std::cos(1.3 * wave);
    const Eigen::Vector2d seen(front ? p.x() : -p.x(), -p.y() - 0.34);
    const Eigen::Vector2d turned(std::cos(tilt) * seen.x() - std::sin(tilt) * seen.y(),
                                 std::sin(tilt) * seen.x() + std::cos(tilt) * seen.y());
    return how.pixels_per_metre * (turned + Eigen::Vector2d(0.65, 0.55));
  };

  std::map<std::string, Eigen::Vector2d> places;
  std::vector<Eigen::Vector2d> left, right;  // From the neck's middle to the hem's middle.
  const double drop = front ? shirt.front_drop : shirt.back_drop;
  const std::vector<Stroke> strokes = LeftHalf(shirt, drop);
  DrawnTShirt right_shirt = shirt;
  right_shirt.sleeve_top = shirt.shoulder_tip + shirt.right_sleeve_share * (shirt.sleeve_top - shirt.shoulder_tip);
  right_shirt.sleeve_bottom = shirt.underarm + shirt.right_sleeve_share * (shirt.sleeve_bottom - shirt.underarm);
  const std::vector<Stroke> right_strokes = LeftHalf(right_shirt, drop);
  double arc = 0.0;
  for (size_t s = 0; s < strokes.size(); ++s) {
    const Stroke& stroke = strokes[s];
    std::vector<double> steps;
    const int count = static_cast<int>(std::ceil(stroke.length * how.pixels_per_metre / 1.5));
    for (int i = 0; i < count; ++i) steps.push_back(static_cast<double>(i) / count);
    for (const auto& [t, name] : stroke.at) steps.push_back(t);
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    for (double t : steps) {
      const Eigen::Vector2d flat = stroke.curve(t);
      // Waves of about 6 cm with another phase on the other side.
      const double wave = 2.0 * std::numbers::pi * (arc + t * stroke.length) / 0.06;
      const Eigen::Vector2d on_left = TurnSleeve(shirt, flat, turn);
      const Eigen::Vector2d on_right = TurnSleeve(right_shirt, right_strokes[s].curve(t), -turn);
      left.push_back(pixel_of(on_left, wave));
      right.push_back(pixel_of({-on_right.x(), on_right.y()}, wave + 2.0));
      for (const auto& [named_t, name] : stroke.at) {
        if (named_t != t) continue;
        places[name] = left.back();
        if (TwinPointName(GarmentKind::kTShirt, name) != name)
          places[TwinPointName(GarmentKind::kTShirt, name)] = right.back();
      }
    }
    arc += stroke.length;
  }
  // Both halves start and end on the middle; the left one speaks for it.
  std::vector<Eigen::Vector2d> outline = left;
  outline.insert(outline.end(), right.rbegin() + 1, right.rend() - 1);
  if (!front) std::reverse(outline.begin(), outline.end());
  view.outline = outline;
  for (const std::string& name : OutlinePointNames(GarmentKind::kTShirt)) {
    view.points.push_back({name, places.at(name), 1.0});
  }
  return view;
}

Garment DrawGarment(const DrawnTShirt& shirt, const DrawnView& front, const DrawnView& back) {
  Garment garment;
  garment.id = "drawn-tshirt";
  garment.length = shirt.length;
  garment.front = DrawView(shirt, GarmentSide::kFront, front);
  garment.back = DrawView(shirt, GarmentSide::kBack, back);
  return garment;
}

}  // namespace fitroom::testing
