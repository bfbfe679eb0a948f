#include "fit_client/fit/stages/start_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/stages/dressing_guides.h"
#include "fit_client/fit/stages/frontal_map.h"
#include "fit_client/fit/stages/harmonic_extension.h"
#include "fit_client/fit/stages/panel_outline.h"
#include "fit_client/fit/stages/sleeve_tube.h"

namespace fitroom {
namespace {

constexpr double kUnderarmReach =
    0.12;                              // So far down a sleeve's underside its depth is still the torso's (unit: metre).
constexpr double kLargestBody = 10.0;  // The frontal map of a longer one would not fit the memory (unit: metre).

using Eigen::Vector2d;
using Eigen::Vector3d;

// A particle whose place in the frontal plane and whose middle depth are given.
struct Anchor {
  int particle = 0;
  Vector3d place = Vector3d::Zero();
};

// One half of the torso's tube as the garment would fill it, level by level under the underarm.
struct TorsoTube {
  double underarm_y = 0.0;          // (unit: metre)
  std::vector<double> half_widths;  // Where the side seam runs, from underarm_y downwards (unit: metre).
  std::vector<double> half_depths;  // Of the ellipse through it (unit: metre).
  double step = 0.005;              // (unit: metre)

  double Sample(const std::vector<double>& values, double y) const {
    const double index = std::clamp((underarm_y - y) / step, 0.0, static_cast<double>(values.size() - 1));
    const auto i = std::min(static_cast<size_t>(index), values.size() - 1);
    const size_t j = std::min(i + 1, values.size() - 1);
    const double t = index - static_cast<double>(i);
    return (1.0 - t) * values[i] + t * values[j];
  }
};

// Ramanujan's second approximation; exact to 1e-4 for the ratios of a torso.
double EllipsePerimeter(double a, double b) {
  const double h = std::pow((a - b) / (a + b), 2);
  return std::numbers::pi * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

// Solves for the half depth of an ellipse of half width a and perimeter p; 0 where even a flat one is too long.
double HalfDepthOfEllipse(double a, double perimeter) {
  double low = 0.0;
  double high = perimeter / 4.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (EllipsePerimeter(a, middle) < perimeter ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double ChainLength(const ClothMesh& cloth, const std::vector<int>& chain) {
  return RestArcLengths(cloth, chain).back();
}

// Everything about one half (left or right) of the top on one half of the body.
class HalfPlacement {
 public:
  HalfPlacement(const ClothMesh& cloth, const Body& body, const FrontalMap& map, const DressingGuides& guides, int side,
                const StartPoseOptions& options)
      : cloth_(cloth), body_(body), map_(map), guides_(guides), side_(side), options_(options) {}

  // Finds the half's seams on one panel's outline.
  Status FindSeams(const PanelOutline& outline, GarmentKind kind) {
    const std::string suffix = side_ > 0 ? "_L" : "_R";
    const std::string neck = side_ > 0 ? "P2" : "P1";
    const bool is_dress = kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece;
    const std::string shoulder = is_dress ? (side_ > 0 ? "e2" : "e6") : (side_ > 0 ? "e3" : "e7");
    const std::string sleeve_end = is_dress ? "sleeve_top" + suffix : (side_ > 0 ? "e4" : "e8");
    FR_ASSIGN_OR_RETURN(top_, outline.Section(neck, HasSleeves(kind) ? sleeve_end : shoulder));
    FR_ASSIGN_OR_RETURN(shoulder_, outline.Section(neck, shoulder));
    if (HasSleeves(kind)) {
      FR_ASSIGN_OR_RETURN(under_, outline.Section("underarm" + suffix, "sleeve_bottom" + suffix));
    }
    FR_ASSIGN_OR_RETURN(side_seam_, outline.Section("underarm" + suffix, "hem" + suffix));
    return Status();
  }

  // Decides where the underarm goes and how wide the torso's tube is below it.
  void ShapeTube() {
    const Vector3d shoulder_rest = Rest(shoulder_.back());
    const Vector3d underarm_rest = Rest(side_seam_.front());
    const double armhole = (shoulder_rest - underarm_rest).norm();
    top_start_ = guides_.shoulder_line.DistanceAtAbscissa(std::abs(Rest(top_.front()).x()));
    const Vector2d tip = guides_.shoulder_line.At(top_start_ + ChainLength(cloth_, shoulder_));
    tube_.underarm_y = guides_.levels_begin;
    const double lowest = guides_.levels_begin - 0.20;
    while (tube_.underarm_y > lowest) {
      const Vector2d underarm(SideAbscissa(tube_.underarm_y, side_seam_.front()), tube_.underarm_y);
      if ((tip - underarm).norm() >= 0.97 * armhole) break;
      tube_.underarm_y -= tube_.step;
    }
    const std::vector<double> lengths = RestArcLengths(cloth_, side_seam_);
    size_t at = 0;
    for (double s = 0.0; s <= lengths.back() + tube_.step; s += tube_.step) {
      while (at + 1 < lengths.size() && lengths[at] < s) ++at;
      const double half_width = SideAbscissa(tube_.underarm_y - s, side_seam_[at]);
      tube_.half_widths.push_back(half_width);
      tube_.half_depths.push_back(HalfDepthOfEllipse(half_width, 4.0 * std::abs(Rest(side_seam_[at]).x())));
    }
    Smooth(tube_.half_widths);
    Smooth(tube_.half_depths);
  }

  // Lists where the half's seam particles go.
  void AddAnchors(std::vector<Anchor>& anchors) const {
    const LimbAxis& arm = side_ > 0 ? body_.arm_left : body_.arm_right;
    const std::vector<double> top_lengths = RestArcLengths(cloth_, top_);
    for (size_t i = 0; i < top_.size(); ++i) {
      const Vector2d place = guides_.shoulder_line.At(top_start_ + top_lengths[i]);
      anchors.push_back({top_[i], Place(place, RidgeDepth(place, arm))});
    }
    if (!under_.empty()) AddUndersideAnchors(arm, anchors);
    const std::vector<double> side_lengths = RestArcLengths(cloth_, side_seam_);
    for (size_t i = 0; i < side_seam_.size(); ++i) {
      const double y = tube_.underarm_y - options_.side_scale * side_lengths[i];
      anchors.push_back(
          {side_seam_[i], Place({tube_.Sample(tube_.half_widths, y), y}, guides_.LevelAt(y).middle_depth)});
    }
  }

  // Lists where the sleeve's underside goes: straight to its end on the arm, or along the arm's inner outline where it
  // reaches past the elbow.
  void AddUndersideAnchors(const LimbAxis& arm, std::vector<Anchor>& anchors) const {
    const Vector2d underarm(tube_.Sample(tube_.half_widths, tube_.underarm_y), tube_.underarm_y);
    const Vector2d sleeve_end = SleeveBottom(underarm);
    const std::vector<double> lengths = RestArcLengths(cloth_, under_);
    const double underarm_z = guides_.LevelAt(tube_.underarm_y).middle_depth;
    const Polyline inside = InsideOfArm(underarm);
    const bool follows_arm = sleeve_end.y() < arm.joint.y() && inside.points().size() > 2;
    for (size_t i = 1; i < under_.size(); ++i) {
      const double t = lengths[i] / lengths.back();
      const Vector2d place = follows_arm ? inside.At(lengths[i]) : Vector2d((1.0 - t) * underarm + t * sleeve_end);
      const double from_torso = follows_arm ? std::max(0.0, 1.0 - lengths[i] / kUnderarmReach) : 1.0 - t;
      anchors.push_back(
          {under_[i], Place(place, from_torso * underarm_z + (1.0 - from_torso) * AxisDepth(arm, place.y()))});
    }
  }

  // Adds the sleeve's seams on this panel, from the shoulder tip and from the underarm.
  void AddSleeveSeams(size_t panel, SleeveSeams& seams) const {
    if (under_.empty()) return;
    seams.top[panel].assign(top_.begin() + static_cast<std::ptrdiff_t>(shoulder_.size()) - 1, top_.end());
    seams.under[panel] = under_;
  }

  // Returns how far the torso's tube stands off its middle depth at (u, y): a half ellipse, fading out above the
  // underarm, where the body's own depth takes over.
  double Bulge(double u, double y, double neck_y) const {
    const double a = tube_.Sample(tube_.half_widths, y);
    const double b = tube_.Sample(tube_.half_depths, y);
    const double fade = std::clamp((neck_y - y) / std::max(neck_y - tube_.underarm_y, 0.05), 0.0, 1.0);
    return fade * b * std::sqrt(std::max(0.0, 1.0 - std::pow(u / a, 2)));
  }

 private:
  const Vector3d& Rest(int particle) const { return cloth_.rest_positions[static_cast<size_t>(particle)]; }
  Vector3d Place(const Vector2d& in_half, double z) const { return {side_ * in_half.x(), in_half.y(), z}; }

  // Where the side seam runs at height y: on the ellipse that has the torso's proportions and the garment's girth, kept
  // between the torso and the arm.
  double SideAbscissa(double y, int side_particle) const {
    const DressingGuides::Level& level = guides_.LevelAt(y);
    const double girth = 4.0 * std::abs(Rest(side_particle).x());
    const double scale = girth / EllipsePerimeter(level.torso_end, std::max(level.half_depth, 0.05));
    const double inner = level.torso_end + options_.clearance;
    const double outer = level.arm_begin - options_.clearance;
    if (outer < inner) return 0.5 * (level.torso_end + level.arm_begin);
    return std::clamp(scale * level.torso_end, inner, outer);
  }

  double RidgeDepth(const Vector2d& place, const LimbAxis& arm) const {
    const double x = side_ * place.x();
    if (place.x() < std::abs(arm.root.x())) {
      double depth = 0.0;
      int count = 0;
      for (const double below : {0.015, 0.025}) {
        const double y = place.y() - options_.clearance - below;
        const auto front = map_.FrontDepth(x, y, 0.0);
        const auto back = map_.BackDepth(x, y, 0.0);
        if (!front || !back) continue;
        depth += 0.5 * (*front + *back);
        ++count;
      }
      if (count > 0) return depth / count;
    }
    return AxisDepth(arm, place.y());
  }

  static double AxisDepth(const LimbAxis& arm, double y) {
    const auto on_bone = [y](const Vector3d& from, const Vector3d& to) {
      const double span = from.y() - to.y();
      const double t = std::abs(span) < 1e-6 ? 0.0 : std::clamp((from.y() - y) / span, 0.0, 1.0);
      return from.z() + t * (to.z() - from.z());
    };
    return y >= arm.joint.y() ? on_bone(arm.root, arm.joint) : on_bone(arm.joint, arm.end);
  }

  // The lower end of the sleeve: on the arm's inner outline, the underside's length away from the underarm.
  Vector2d SleeveBottom(const Vector2d& underarm) const {
    const double length = ChainLength(cloth_, under_);
    Vector2d best = guides_.arm_inside.back();
    for (const Vector2d& point : guides_.arm_inside) {
      if (point.y() > underarm.y() || (point - underarm).norm() < length) continue;
      best = point;
      break;
    }
    return best;
  }

  // The way from the underarm along the arm's inner outline; straight to where it comes free of the torso.
  Polyline InsideOfArm(const Vector2d& underarm) const {
    std::vector<Vector2d> points = {underarm};
    for (const Vector2d& point : guides_.arm_inside) {
      const bool is_free = point.y() < underarm.y() - 0.02 && point.x() > underarm.x();
      if (is_free && point.y() < points.back().y()) points.push_back(point);
    }
    return Polyline(std::move(points));
  }

  static void Smooth(std::vector<double>& values) {
    for (int pass = 0; pass < 8; ++pass) {
      const std::vector<double> before = values;
      for (size_t i = 1; i + 1 < values.size(); ++i) {
        values[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
      }
    }
  }

  const ClothMesh& cloth_;
  const Body& body_;
  const FrontalMap& map_;
  const DressingGuides& guides_;
  int side_;
  StartPoseOptions options_;
  std::string shoulder_name_;
  std::vector<int> top_, shoulder_, under_, side_seam_;
  double top_start_ = 0.0;
  TorsoTube tube_;
};

// Extends the anchors' displacements over one panel. Returns one place a particle of the panel (x, y, middle depth).
Result<std::vector<Vector3d>> PlacesBetween(const ClothMesh& cloth, int panel, const std::vector<Anchor>& anchors) {
  std::vector<GivenValue> given;
  for (const Anchor& anchor : anchors) {
    given.push_back({anchor.particle, anchor.place - cloth.rest_positions[static_cast<size_t>(anchor.particle)]});
  }
  FR_ASSIGN_OR_RETURN(std::vector<Vector3d> places, ExtendHarmonically(cloth, panel, given));
  for (size_t i = 0; i < places.size(); ++i) places[i] += cloth.rest_positions[i];
  for (const Anchor& anchor : anchors) places[static_cast<size_t>(anchor.particle)] = anchor.place;
  return places;
}

}  // namespace

Result<StartPose> PlaceTop(const ClothMesh& cloth, GarmentKind kind, const Body& body, const TriangleMesh& collider,
                           const StartPoseOptions& options) {
  if (ComputeBounds(collider).sizes().maxCoeff() > kLargestBody) {
    return InvalidArgument("BODY_TOO_LARGE", "the body is more than 10 m long; is the unit metres?");
  }
  const FrontalMap map(collider, options.map_pitch);
  FR_ASSIGN_OR_RETURN(const DressingGuides left_guides, FindDressingGuides(body, map, +1, options.clearance));
  FR_ASSIGN_OR_RETURN(const DressingGuides right_guides, FindDressingGuides(body, map, -1, options.clearance));
  StartPose pose;
  pose.around.resize(cloth.rest_positions.size());
  std::array<SleeveSeams, 2> sleeves;
  for (const int panel : {0, 1}) {
    FR_ASSIGN_OR_RETURN(const PanelOutline outline, PanelOutline::Trace(cloth, panel));
    HalfPlacement left(cloth, body, map, left_guides, +1, options);
    HalfPlacement right(cloth, body, map, right_guides, -1, options);
    std::vector<Anchor> anchors;
    for (HalfPlacement* half : {&left, &right}) {
      FR_RETURN_IF_ERROR(half->FindSeams(outline, kind));
      half->ShapeTube();
      half->AddAnchors(anchors);
    }
    left.AddSleeveSeams(static_cast<size_t>(panel), sleeves[0]);
    right.AddSleeveSeams(static_cast<size_t>(panel), sleeves[1]);
    FR_ASSIGN_OR_RETURN(const std::vector<Vector3d> places, PlacesBetween(cloth, panel, anchors));
    std::vector<bool> sewn(cloth.rest_positions.size(), false);
    for (const Anchor& anchor : anchors) sewn[static_cast<size_t>(anchor.particle)] = true;
    const double neck_y = std::max(left_guides.shoulder_line.At(0.0).y(), right_guides.shoulder_line.At(0.0).y());
    const double outward = panel == 0 ? 1.0 : -1.0;
    for (size_t i = 0; i < places.size(); ++i) {
      if (cloth.panel_of_particle[i] != panel) continue;
      const Vector3d& place = places[i];
      const HalfPlacement& half = place.x() >= 0.0 ? left : right;
      pose.around[i] = place;
      if (sewn[i]) continue;  // Both panels' seams lie on one line, outside of the body's outline.
      double stand_off = half.Bulge(std::abs(place.x()), place.y(), neck_y);
      const std::optional<double> surface = panel == 0 ? map.FrontDepth(place.x(), place.y(), options.clearance)
                                                       : map.BackDepth(place.x(), place.y(), options.clearance);
      if (surface) stand_off = std::max(stand_off, outward * (*surface - place.z()) + options.clearance);
      pose.around[i].z() += outward * std::max(stand_off, 0.0);
    }
  }
  LaySleeveRoundArm(cloth, sleeves[0], +1, body.arm_left, collider, options.clearance, pose.around);
  LaySleeveRoundArm(cloth, sleeves[1], -1, body.arm_right, collider, options.clearance, pose.around);
  for (size_t i = 0; i < pose.around.size(); ++i) {
    const double outward = cloth.panel_of_particle[i] == 0 ? 1.0 : -1.0;
    pose.apart.emplace_back(pose.around[i] + Vector3d(0.0, 0.0, outward * options.apart));
  }
  return pose;
}

}  // namespace fitroom
