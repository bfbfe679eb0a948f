#include "fit_client/fit/stages/place_bottom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/body/polygon.h"
#include "fit_client/fit/stages/garment_levels.h"
#include "fit_client/fit/stages/harmonic_extension.h"
#include "fit_client/fit/stages/leg_stack.h"
#include "fit_client/fit/stages/panel_outline.h"
#include "fit_client/fit/stages/tape_curve.h"

namespace fitroom {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSteepest = 0.35;     // A step along the outseam falls at least by this share of its length.
constexpr double kOfItsLeg = 1e-6;     // Half widths from the middle at which a seam's particles count as one leg's.
constexpr double kLegsApart = 0.0015;  // Tubes of the legs stay this far from the plane between them (unit: metre).

// Heights on the body of heights at rest: a monotone table, straight between its entries and beyond.
class HeightMap {
 public:
  void Add(double rest_y, double y) { entries_.emplace_back(rest_y, y); }
  void Finish() {
    std::sort(entries_.begin(), entries_.end());
    for (size_t k = 1; k < entries_.size(); ++k) {
      entries_[k].second = std::max(entries_[k].second, entries_[k - 1].second + 1e-6);
    }
  }
  template <typename Map>
  void Transform(const Map& map) {
    for (auto& [rest_y, y] : entries_) y = map(y);
  }
  double RestOf(double y) const {
    const auto after = std::upper_bound(entries_.begin(), entries_.end(), y,
                                        [](double value, const auto& entry) { return value < entry.second; });
    const size_t k = std::clamp<size_t>(static_cast<size_t>(after - entries_.begin()), 1, entries_.size() - 1);
    const auto& [rest_a, y_a] = entries_[k - 1];
    const auto& [rest_b, y_b] = entries_[k];
    const double part = std::clamp((y - y_a) / std::max(y_b - y_a, 1e-9), -1.0, 2.0);
    return rest_a + part * (rest_b - rest_a);
  }

 private:
  std::vector<std::pair<double, double>> entries_;  // Rest height, height on the body.
};

// The tubes at one height of the body.
struct Tubes {
  TapeCurve trunk;
  std::array<TapeCurve, 2> leg;
  double front_share = 0.5;  // Of the trunk's tape that the front panel takes.
  std::array<double, 2> leg_front_share = {0.5, 0.5};
  // How far front's middle, back's middle and the sides have come from the legs' tapes to the trunk's, 0 to 1.
  double trunk_front = 1.0;
  double trunk_back = 1.0;
  double trunk_side = 1.0;
};

double Total(const GarmentLevels::Widths& widths, size_t side) { return widths[side][0] + widths[side][1]; }

double FrontShare(double front, double back) {
  return front + back > 0.0 ? std::clamp(front / (front + back), 0.2, 0.8) : 0.5;
}

class BottomPlacement {
 public:
  BottomPlacement(const ClothMesh& cloth, const BottomOutline& outline, const LowerBody& body,
                  const BottomPoseOptions& options)
      : cloth_(cloth), outline_(outline), body_(body), options_(options) {}

  Result<BottomPose> Place() {
    FindMiddle();
    FR_RETURN_IF_ERROR(FindAcross());
    const GarmentLevels levels(cloth_, across_);
    MapHeights(levels);
    FR_RETURN_IF_ERROR(FindHeights());
    MakeTubes(levels);
    BottomPose pose;
    for (size_t i = 0; i < heights_.size(); ++i) pose.around.push_back(PlaceParticle(i));
    Lower();
    MakeTubes(levels);
    for (size_t i = 0; i < heights_.size(); ++i) {
      pose.round_legs.push_back(PlaceParticle(i));
      const double outward = cloth_.panel_of_particle[i] == 0 ? 1.0 : -1.0;
      pose.apart.push_back(pose.round_legs.back() + Vector3d(0.0, 0.0, outward * options_.apart));
    }
    return pose;
  }

 private:
  // Centre seams and the crotch: where left and right meet.
  void FindMiddle() {
    is_middle_.assign(cloth_.rest_positions.size(), false);
    for (const auto& panel : outline_.centre_seams) {
      for (const auto& chain : panel) {
        for (const int particle : chain.particles) is_middle_[static_cast<size_t>(particle)] = true;
      }
    }
    for (const int particle : outline_.crotch) is_middle_[static_cast<size_t>(particle)] = true;
  }

  // How far across its half each particle lies: +1 or -1 at the outseams, 0 at inseams and centre seams.
  Status FindAcross() {
    across_.assign(cloth_.rest_positions.size(), Vector3d::Zero());
    for (const int panel : {0, 1}) {
      std::vector<GivenValue> given;
      for (const size_t side : {0, 1}) {
        for (const int particle : outline_.outseams[side][static_cast<size_t>(panel)].particles) {
          given.push_back({particle, Vector3d(side == 0 ? 1.0 : -1.0, 0.0, 0.0)});
        }
        for (const auto& chain : outline_.inseams[side]) GiveMiddle(chain, panel, given);
      }
      for (const auto& chain : outline_.centre_seams[static_cast<size_t>(panel)]) GiveMiddle(chain, panel, given);
      FR_RETURN_IF_ERROR(Extend(panel, given, across_));
    }
    return Status();
  }

  // On the middle, but still of its own leg.
  static void GiveMiddle(const BottomOutline::Chain& chain, int panel, std::vector<GivenValue>& given) {
    if (chain.panel != panel) return;
    const Vector3d value((chain.side == 0 ? 1.0 : -1.0) * kOfItsLeg, 0.0, 0.0);
    for (const int particle : chain.particles) given.push_back({particle, value});
  }

  Status Extend(int panel, const std::vector<GivenValue>& given, std::vector<Vector3d>& values) const {
    FR_ASSIGN_OR_RETURN(const std::vector<Vector3d> extended, ExtendHarmonically(cloth_, panel, given));
    for (size_t i = 0; i < values.size(); ++i) {
      if (cloth_.panel_of_particle[i] == panel) values[i] = extended[i];
    }
    return Status();
  }

  double RestHeight(int particle) const { return cloth_.rest_positions[static_cast<size_t>(particle)].y(); }

  // Radius of the tube at a height, for the way that an outseam takes over the hip.
  double Radius(const GarmentLevels& levels, double y, double rest_y) const {
    const GarmentLevels::Widths widths = levels.At(rest_y);
    const double body_girth = body_.TrunkGirth(y) + 2.0 * std::numbers::pi * options_.clearance;
    return std::max(body_girth, Total(widths, 0) + Total(widths, 1)) / (2.0 * std::numbers::pi);
  }

  // Lets the left outseam run down over the body from where the waist will be.
  void MapHeights(const GarmentLevels& levels) {
    const std::vector<int>& seam = outline_.outseams[0][0].particles;
    start_y_ = body_.groin().y() - options_.below_groin;
    double y = body_.waist_height() - options_.below_waist;
    if (outline_.has_legs()) y = 0.5 * (WaistAbove(0) + WaistAbove(1));
    side_heights_ = {y};
    for (size_t k = 1; k < seam.size(); ++k) {
      if (outline_.has_legs() && y <= body_.groin().y()) {
        const std::vector<int> on_leg(seam.begin() + static_cast<std::ptrdiff_t>(k - 1), seam.end());
        const std::vector<double> heights = DownLeg(y, RestArcLengths(cloth_, on_leg));
        side_heights_.insert(side_heights_.end(), heights.begin() + 1, heights.end());
        break;
      }
      y = Step(levels, seam[k - 1], seam[k], y, -1.0);
      side_heights_.push_back(y);
    }
    for (size_t k = 0; k < seam.size(); ++k) heights_on_body_.Add(RestHeight(seam[k]), side_heights_[k]);
    heights_on_body_.Finish();
  }

  // Heights of a leg's seam whose ways (ascending, from 0) start at `y`.
  std::vector<double> DownLeg(double y, const std::vector<double>& ways) {
    const LegStack stack = StackLeg(y, ways.back(), options_.lowest_hem);
    if (stack.share < stack_.share) stack_ = stack;
    std::vector<double> heights;
    for (const double way : ways) heights.push_back(HeightDownLeg(stack, y, way));
    return heights;
  }

  // The height that the middle of the waist's edge reaches when the crotch is up and the cloth follows the midline.
  double WaistAbove(int panel) const {
    double length = 0.0;
    for (const auto& chain : outline_.centre_seams[static_cast<size_t>(panel)]) {
      length = std::max(length, RestArcLengths(cloth_, chain.particles).back());
    }
    if (length == 0.0) {  // No centre seam: straight up from the crotch.
      const double middle = cloth_.rest_positions[static_cast<size_t>(outline_.crotch.front())].x();
      double nearest = 1e9;
      for (const WaistParticle& edge : outline_.waist) {
        const Vector3d& place = cloth_.rest_positions[static_cast<size_t>(edge.particle)];
        if (cloth_.panel_of_particle[static_cast<size_t>(edge.particle)] != panel) continue;
        if (std::abs(place.x() - middle) >= nearest) continue;
        nearest = std::abs(place.x() - middle);
        length = place.y() - RestHeight(outline_.crotch.front());
      }
    }
    return WalkUpMidline(panel, {length}).front();
  }

  double Step(const GarmentLevels& levels, int from, int to, double y, double direction) const {
    const double length =
        (cloth_.rest_positions[static_cast<size_t>(to)] - cloth_.rest_positions[static_cast<size_t>(from)]).norm();
    const double widening =
        Radius(levels, y + direction * length, RestHeight(to)) - Radius(levels, y, RestHeight(from));
    const double fall = std::sqrt(std::max(length * length - widening * widening, 0.0));
    return y + direction * std::max(fall, kSteepest * length);
  }

  // The height of every particle: given along the seams, harmonic between them.
  Status FindHeights() {
    heights_.assign(cloth_.rest_positions.size(), 0.0);
    std::vector<Vector3d> rise(cloth_.rest_positions.size(), Vector3d::Zero());
    for (const int panel : {0, 1}) {
      std::vector<GivenValue> given;
      const auto give = [&](int particle, double y) {
        given.push_back({particle, Vector3d(0.0, y - RestHeight(particle), 0.0)});
      };
      for (const size_t side : {0, 1}) {
        const std::vector<int>& seam = outline_.outseams[side][static_cast<size_t>(panel)].particles;
        const size_t last = side_heights_.size() - 1;
        for (size_t k = 0; k < seam.size(); ++k) give(seam[k], side_heights_[std::min(k, last)]);
        for (const auto& chain : outline_.inseams[side]) {
          if (chain.panel != panel) continue;
          const std::vector<double> heights = DownLeg(start_y_, RestArcLengths(cloth_, chain.particles));
          for (size_t k = 0; k < chain.particles.size(); ++k) give(chain.particles[k], heights[k]);
        }
      }
      for (const auto& chain : outline_.centre_seams[static_cast<size_t>(panel)]) GiveCentreSeam(chain, give);
      FR_RETURN_IF_ERROR(Extend(panel, given, rise));
    }
    for (size_t i = 0; i < heights_.size(); ++i) heights_[i] = cloth_.rest_positions[i].y() + rise[i].y();
    return Status();
  }

  // A centre seam follows the body's midline up from the groin, as long as it is.
  template <typename Give>
  void GiveCentreSeam(const BottomOutline::Chain& chain, const Give& give) const {
    const std::vector<int> upwards(chain.particles.rbegin(), chain.particles.rend());
    const std::vector<double> heights = WalkUpMidline(chain.panel, RestArcLengths(cloth_, upwards));
    for (size_t k = 0; k < upwards.size(); ++k) give(upwards[k], heights[k]);
  }

  // Heights after given ways (ascending) up the body's midline from where the crotch starts.
  std::vector<double> WalkUpMidline(int panel, const std::vector<double>& ways) const {
    constexpr double kStep = 0.004;  // (unit: metre)
    std::vector<double> heights;
    double y = start_y_;
    double z = MidlineDepth(y, panel);
    double walked = 0.0;
    for (const double way : ways) {
      while (walked < way) {
        const double next = MidlineDepth(y + kStep, panel);
        const double length = std::hypot(kStep, next - z);
        const double part = std::min(1.0, (way - walked) / length);
        walked += part * length;
        y += part * kStep;
        z += part * (next - z);
        if (part < 1.0) break;
      }
      heights.push_back(y);
    }
    return heights;
  }

  // z of the body's midline, from between the legs to the trunk's front or back.
  double MidlineDepth(double y, int panel) const {
    const LowerBody::Level& level = body_.At(y);
    if (y < body_.groin().y() || !level.has_midline) return body_.groin().z();
    return panel == 0 ? std::max(level.front, body_.groin().z()) : std::min(level.back, body_.groin().z());
  }

  void MakeTubes(const GarmentLevels& levels) {
    const Eigen::Vector3d& groin = body_.groin();
    tubes_.clear();
    for (int k = 0; k * LowerBody::kStep <= body_.highest(); ++k) {
      const double y = k * LowerBody::kStep;
      const double rest_y = heights_on_body_.RestOf(y);
      const LowerBody::Level& level = body_.At(y);
      const GarmentLevels::Widths widths = levels.At(rest_y);
      Tubes tubes;
      tubes.trunk = TapeCurve::AsWideAs(Total(widths, 0) + Total(widths, 1), level.trunk, options_.clearance);
      tubes.front_share = FrontShare(widths[0][0] + widths[1][0], widths[0][1] + widths[1][1]);
      if (!tubes.trunk.is_empty()) tubes.trunk.StartTowards({groin.x(), tubes.trunk.middle().y()}, {0.0, 1.0});
      if (outline_.has_legs()) {
        const double below_crotch = std::min(rest_y, RestHeight(outline_.crotch.front()) - LowerBody::kStep);
        ShapeLegs(y, level, levels.At(below_crotch), tubes);
        BlendAtCrotch(y, tubes);
      }
      tubes_.push_back(std::move(tubes));
    }
  }

  void ShapeLegs(double y, const LowerBody::Level& level, const GarmentLevels::Widths& widths, Tubes& tubes) const {
    const LowerBody::Level& leg_level = body_.At(std::min(y, body_.groin().y() - 0.5 * LowerBody::kStep));
    for (const size_t side : {0, 1}) {
      const std::vector<Vector2d>& points = leg_level.leg[side].empty() ? level.leg[side] : leg_level.leg[side];
      TapeCurve& tape = tubes.leg[side];
      tape = TapeCurve::AsWideAs(Total(widths, side), points, options_.clearance);
      tubes.leg_front_share[side] = FrontShare(widths[side][0], widths[side][1]);
      if (!tape.is_empty()) tape.StartTowards(tape.middle(), {side == 0 ? -1.0 : 1.0, 0.0});
    }
  }

  // Says how far the middle of front and back has come from between the legs to the trunk's tape: as far as the body's
  // own midline where the garment is up, by the garment's own height above its crotch where it hangs round the legs.
  void BlendAtCrotch(double y, Tubes& tubes) const {
    const Eigen::Vector3d& groin = body_.groin();
    if (is_lowered_) {
      const double crotch = heights_[static_cast<size_t>(outline_.crotch.front())] + LowerBody::kStep;
      const double above = (y - crotch) / kLoweredFork;
      tubes.trunk_front = tubes.trunk_back = tubes.trunk_side = std::clamp(above, 0.0, 1.0);
      return;
    }
    tubes.trunk_side = std::clamp((y - groin.y()) / (2.0 * kSideReach) + 0.5, 0.0, 1.0);
    if (y < groin.y() || y > groin.y() + kLegsReach || tubes.trunk.is_empty()) {
      tubes.trunk_front = tubes.trunk_back = y < groin.y() ? 0.0 : 1.0;
      return;
    }
    const double front = tubes.trunk.At(0.0).y() - groin.z();
    const double back = groin.z() - tubes.trunk.At(0.5 * tubes.trunk.length()).y();
    tubes.trunk_front = std::clamp((MidlineDepth(y, 0) - groin.z()) / std::max(front, 1e-3), 0.0, 1.0);
    tubes.trunk_back = std::clamp((groin.z() - MidlineDepth(y, 1)) / std::max(back, 1e-3), 0.0, 1.0);
  }

  Vector3d PlaceParticle(size_t i) const {
    const double y = heights_[i];
    const double place = std::clamp(y / LowerBody::kStep, 0.0, static_cast<double>(tubes_.size() - 1) - 1e-6);
    const size_t level = static_cast<size_t>(place);
    const double part = place - static_cast<double>(level);
    const Vector2d below = InTubes(tubes_[level], i);
    const Vector2d above = InTubes(tubes_[std::min(level + 1, tubes_.size() - 1)], i);
    Vector2d at = (1.0 - part) * below + part * above;
    const TapeCurve& leg = tubes_[level].leg[across_[i].x() >= 0.0 ? 0 : 1];
    if (!is_lowered_ && !leg.is_empty()) at += LegFold(stack_, y, at - leg.middle());
    return {at.x(), y, at.y()};
  }

  Vector2d InTubes(const Tubes& tubes, size_t i) const {
    const bool front = cloth_.panel_of_particle[i] == 0;
    const double across = std::clamp(across_[i].x(), -1.0, 1.0);
    const double middle_part = front ? tubes.trunk_front : tubes.trunk_back;
    const double trunk_part = middle_part + std::abs(across) * (tubes.trunk_side - middle_part);
    const Vector2d on_trunk = trunk_part > 0.0 ? OnTrunk(tubes, front, across) : Vector2d(Vector2d::Zero());
    if (trunk_part >= 1.0) return on_trunk;
    // Between the legs left and right meet in the plane between them.
    const Vector2d on_leg =
        is_middle_[i] ? Vector2d(body_.groin().x(), body_.groin().z()) : OnLeg(tubes, front, across);
    return trunk_part * on_trunk + (1.0 - trunk_part) * on_leg;
  }

  static Vector2d OnTrunk(const Tubes& tubes, bool front, double across) {
    if (tubes.trunk.is_empty()) return Vector2d::Zero();
    const double half = 0.5 * tubes.trunk.length();
    const double way = front ? std::abs(across) * half * tubes.front_share
                             : half - std::abs(across) * half * (1.0 - tubes.front_share);
    return tubes.trunk.At(across >= 0.0 ? way : -way);
  }

  Vector2d OnLeg(const Tubes& tubes, bool front, double across) const {
    const size_t side = across >= 0.0 ? 0 : 1;
    const TapeCurve& tape = tubes.leg[side];
    if (tape.is_empty()) return OnTrunk(tubes, front, across);
    const double share = front ? tubes.leg_front_share[side] : 1.0 - tubes.leg_front_share[side];
    const double way = std::abs(across) * share * tape.length();
    // Tapes start at the legs' inner sides and lead from the front over the body's left: on the left leg outwards.
    const bool forward = (side == 0) == front;
    Vector2d at = tape.At(forward ? way : -way);
    const double middle = body_.groin().x();
    at.x() = side == 0 ? std::max(at.x(), middle + kLegsApart) : std::min(at.x(), middle - kLegsApart);
    return at;
  }

  // Pushes the whole garment down along the legs, its hem as far as the floor allows.
  void Lower() {
    const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
    const double bottom = *low;
    const double height = std::max(*high - bottom, 1e-3);
    const double room = std::max(0.0, bottom - options_.lowest_hem);
    const double drop = std::min(options_.drop, 0.5 * height + room);
    const double at_hem = std::min(room, drop);
    const auto lowered = [=](double y) { return y - at_hem - (y - bottom) / height * (drop - at_hem); };
    for (double& y : heights_) y = lowered(y);
    heights_on_body_.Transform(lowered);
    is_lowered_ = true;
  }

  static constexpr double kLegsReach = 0.12;    // Above the groin the trunk's tube is reached by then (unit: metre).
  static constexpr double kSideReach = 0.08;    // Above and below the groin the sides go over (unit: metre).
  static constexpr double kLoweredFork = 0.06;  // The same above the crotch of a lowered garment (unit: metre).

  const ClothMesh& cloth_;
  const BottomOutline& outline_;
  const LowerBody& body_;
  const BottomPoseOptions& options_;
  std::vector<bool> is_middle_;
  std::vector<Vector3d> across_;  // x: across, see FindAcross().
  std::vector<double> heights_;
  std::vector<double> side_heights_;  // Of the left outseam's particles.
  double start_y_ = 0.0;              // Where the crotch starts.
  HeightMap heights_on_body_;
  std::vector<Tubes> tubes_;  // One a step of the body's levels.
  bool is_lowered_ = false;
  LegStack stack_;  // The legs' most pushed-together seam.
};

}  // namespace

Result<BottomPose> PlaceBottom(const ClothMesh& cloth, const BottomOutline& outline, const LowerBody& body,
                               const BottomPoseOptions& options) {
  return BottomPlacement(cloth, outline, body, options).Place();
}

}  // namespace fitroom
