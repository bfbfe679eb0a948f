#include "common/body/body_slices.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/body/arm_separation.h"
#include "common/body/outline_profile.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

// Heights as parts of the stature between which a thing is looked for. Wider than people differ (crotch 0.44-0.50,
// armpit 0.73-0.77 of the stature in adults).
constexpr double kLegsSurelyApart = 0.30;
constexpr double kLegsSurelyJoined = 0.60;
constexpr double kArmsSurelyJoined = 0.80;
constexpr double kArmsSurelyApart = 0.64;
// An arm against a trunk (ArmSeparation::neck_ratio): the neck of its outline at the armpit, and at most anywhere
// below. In the external population the neck has 0.75 from 3 to 9 mm above the armpit, and 1 or more beyond 15 mm.
constexpr double kFoldedNeck = 0.75;
constexpr double kTouchingNeck = 1.0;
constexpr double kFoldRise = 0.006;  // (unit: metre)
constexpr size_t kFoldDepth = 4;     // Slices: folds this far above a free arm are the armpit's own (15 mm).
// Thighs in contact are shallower on the midline than this part of the section's depth. Free crotches of the external
// population reach it 15 to 30 mm above where the legs join, thighs in contact farther up than that many slices.
constexpr double kContactDepth = 0.62;
constexpr size_t kContactSlices = 9;
constexpr double kCrotchDepth = 0.02;  // (unit: metre)
// Above this part of the stature there is no crotch.
constexpr double kHighestCrotch = 0.52;
constexpr double kArmJump = 0.05;          // An arm's middle moves less between two slices (unit: metre).
constexpr double kTouchDoubt = 0.2;        // Counted as bridged outline (unit: metre).
constexpr double kArmpitUsual = 0.753;     // Of the stature.
constexpr double kHeightTolerance = 2e-4;  // Of a merge (unit: metre).

SectionOptions SliceOptions() {
  SectionOptions options;
  options.min_area = 1e-4;   // A finger (unit: square metre).
  options.max_bridge = 0.2;  // Wider than any hole that a scanner leaves (unit: metre).
  return options;
}

// The two largest outlines, left first, if they lie beside each other.
std::optional<std::array<int, 2>> TwoLegs(const std::vector<SectionLoop>& loops) {
  if (loops.size() < 2 || loops[1].area < 0.25 * loops[0].area) return std::nullopt;
  const bool first_is_left = loops[0].centroid.x() > loops[1].centroid.x();
  const SectionLoop& left = loops[first_is_left ? 0 : 1];
  const SectionLoop& right = loops[first_is_left ? 1 : 0];
  // One beyond the other's middle: a hand beside a trunk is not a leg beside a leg.
  if (left.bounds.min().x() < right.centroid.x() || right.bounds.max().x() > left.centroid.x()) return std::nullopt;
  return first_is_left ? std::array<int, 2>{0, 1} : std::array<int, 2>{1, 0};
}

// Whether the largest outline reaches over both legs as they were below.
bool LegsAreJoined(const std::vector<SectionLoop>& loops, const std::array<Eigen::Vector2d, 2>& leg_middles) {
  return !loops.empty() && loops[0].bounds.max().x() > leg_middles[0].x() &&
         loops[0].bounds.min().x() < leg_middles[1].x();
}

// The middle of the shortest line between two outlines.
Eigen::Vector2d MiddleOfGap(const SectionLoop& a, const SectionLoop& b) {
  double best = 1e300;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : a.points) {
    for (const Eigen::Vector2d& q : b.points) {
      const double squared_distance = (p - q).squaredNorm();
      if (squared_distance < best) {
        best = squared_distance;
        middle = 0.5 * (p + q);
      }
    }
  }
  return middle;
}

// The outline that continues the trunk: it holds the middle of the one below, or is the nearest large one.
int ContinueTrunk(const std::vector<SectionLoop>& loops, const Eigen::Vector2d& middle) {
  int best = -1;
  double best_distance = 0.12;  // A trunk does not jump farther between two slices (unit: metre).
  for (size_t i = 0; i < loops.size() && loops[i].area > 0.2 * loops[0].area; ++i) {
    const double distance = loops[i].bounds.exteriorDistance(middle) + 0.1 * (loops[i].centroid - middle).norm();
    if (distance < best_distance) {
      best_distance = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

// The outline of the arm on one side, where it is apart from the trunk: large, and beside the trunk's middle.
int FindArm(const std::vector<SectionLoop>& loops, int trunk, Side side, double stature) {
  for (size_t i = 0; i < loops.size(); ++i) {
    if (static_cast<int>(i) == trunk || loops[i].area < 4e-4 * stature * stature) continue;
    const double aside =
        SignOf(side) * (loops[i].centroid.x() - (trunk < 0 ? 0.0 : loops[static_cast<size_t>(trunk)].centroid.x()));
    if (aside > 0.05 * stature) return static_cast<int>(i);
  }
  return -1;
}

// Cuts and follows. Kept as a class because every step needs the index and the options.
class Slicer {
 public:
  explicit Slicer(const HeightIndex& index) : index_(index), options_(SliceOptions()) {}

  Result<BodySlices> Run() {
    body_.stature = index_.max_height() - index_.min_height();
    for (double height = 0.5 * kSliceStep; height < index_.max_height(); height += kSliceStep) {
      BodySlice slice;
      slice.height = height;
      slice.loops = index_.CutAt(height, options_);
      body_.slices.push_back(std::move(slice));
    }
    FollowLegs();
    if (!body_.crotch.found) {
      return InvalidArgument("NOT_A_BODY",
                             "the legs never join below 0.6 of the height; the scan must show the whole body");
    }
    FollowTrunk();
    for (const Side side : kSides) FollowArm(side);
    return std::move(body_);
  }

 private:
  size_t SliceNumber(double part) const {
    const double number = part * body_.stature / kSliceStep;
    return std::min(body_.slices.size() - 1, static_cast<size_t>(std::max(0.0, number)));
  }

  void FollowLegs() {
    for (size_t k = 0; k < SliceNumber(kLegsSurelyApart); ++k) NameLegs(body_.slices[k]);
    for (size_t k = SliceNumber(kLegsSurelyApart); k < SliceNumber(kLegsSurelyJoined); ++k) {
      BodySlice& slice = body_.slices[k];
      const BodySlice* below = k > 0 && body_.slices[k - 1].leg[0] >= 0 ? &body_.slices[k - 1] : nullptr;
      if (below != nullptr) {
        const std::array<Eigen::Vector2d, 2> middles = {below->LegLoop(Side::kLeft)->centroid,
                                                        below->LegLoop(Side::kRight)->centroid};
        if (LegsAreJoined(slice.loops, middles)) {
          RefineCrotch(below->height, slice.height, middles);
          PassTouchingThighs(k);
          return;
        }
      }
      NameLegs(slice);
    }
  }

  static void NameLegs(BodySlice& slice) {
    if (const auto legs = TwoLegs(slice.loops)) slice.leg = *legs;
  }

  void RefineCrotch(double apart, double joined, const std::array<Eigen::Vector2d, 2>& middles) {
    std::vector<SectionLoop> below = index_.CutAt(apart, options_);
    while (joined - apart > kHeightTolerance) {
      const double middle = 0.5 * (apart + joined);
      std::vector<SectionLoop> loops = index_.CutAt(middle, options_);
      if (LegsAreJoined(loops, middles)) {
        joined = middle;
      } else {
        apart = middle;
        below = std::move(loops);
      }
    }
    if (below.size() < 2) return;
    const Eigen::Vector2d gap = MiddleOfGap(below[0], below[1]);
    body_.crotch.position = Eigen::Vector3d(gap.x(), joined, gap.y());
    body_.crotch.bridge_length = below[0].bridge_length + below[1].bridge_length;
    body_.crotch.found = true;
  }

  // Thighs that touch join below the crotch, over a contact that is shallow from front to back. Moves the crotch up to
  // where the midline is as deep as at a crotch; leaves it where that is the case at once, or over a hole.
  void PassTouchingThighs(size_t joined) {
    MergePoint& crotch = body_.crotch;
    if (!crotch.found || crotch.bridge_length > 0.01) return;
    for (size_t k = joined + 1; k < SliceNumber(kHighestCrotch); ++k) {
      const BodySlice& slice = body_.slices[k];
      if (slice.loops.empty()) return;
      const std::optional<DepthRange> midline = DepthAt(slice.loops[0], crotch.position.x());
      const double depth = slice.loops[0].bounds.sizes().y();
      if (!midline || midline->front - midline->back < kContactDepth * depth) continue;
      if (k <= joined + kContactSlices) return;
      crotch.position =
          Eigen::Vector3d(crotch.position.x(), slice.height - kCrotchDepth, 0.5 * (midline->front + midline->back));
      crotch.bridge_length = kTouchDoubt;
      crotch.touching = true;
      return;
    }
  }

  void FollowTrunk() {
    Eigen::Vector2d middle(body_.crotch.position.x(), body_.crotch.position.z());
    for (BodySlice& slice : body_.slices) {
      if (slice.height < body_.crotch.position.y()) continue;
      slice.leg = {-1, -1};
      slice.trunk = ContinueTrunk(slice.loops, middle);
      if (slice.trunk >= 0) middle = slice.TrunkLoop()->centroid;
    }
  }

  // From the chest down to the first slice at which the arm is apart from the trunk, or lies against it with a fold
  // before and a fold behind; then on to the fingertips.
  void FollowArm(Side side) {
    const size_t lowest = SliceNumber(kArmsSurelyApart);
    size_t k = SliceNumber(kArmsSurelyJoined);
    size_t folded = 0;  // The highest slice with both folds.
    Eigen::Vector2d fold_middle = Eigen::Vector2d::Zero();
    for (; k > lowest; --k) {
      BodySlice& slice = body_.slices[k];
      slice.arm[IndexOf(side)] = FindArm(slice.loops, slice.trunk, side, body_.stature);
      if (slice.arm[IndexOf(side)] >= 0) break;
      if (folded == 0 && slice.trunk >= 0) {
        if (const auto parts = SeparateArm(*slice.TrunkLoop(), FoldOptions(side, kFoldedNeck))) {
          folded = k;
          fold_middle = parts->cut_middle;
        }
      }
    }
    const bool apart = k > lowest;
    if (apart && folded < k + kFoldDepth) {
      RefineArmpit(side, body_.slices[k], body_.slices[k + 1]);
    } else if (folded > 0) {
      // The arm touches the trunk below the armpit: the skin's hollow ends a little below where its folds begin.
      k = folded;
      body_.armpit[IndexOf(side)] = {
          Eigen::Vector3d(fold_middle.x(), body_.slices[k].height - kFoldRise, fold_middle.y()), kTouchDoubt, true,
          /*touching=*/true};
      if (!CutOffArm(body_.slices[k], side)) return;
      for (size_t above = k + 1; above < SliceNumber(kArmpitUsual); ++above) {
        if (!CutOffArm(body_.slices[above], side)) ClipTrunk(body_.slices[above], side, fold_middle.x());
      }
    } else {
      return;
    }
    FollowArmDown(k, side);
  }

  void FollowArmDown(size_t k, Side side) {
    Eigen::Vector2d middle = body_.slices[k].ArmLoop(side)->centroid;
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();
    while (k-- > 0) {
      BodySlice& slice = body_.slices[k];
      const Eigen::Vector2d expected = middle + drift;
      int next = ContinueArm(slice, expected);
      if (next < 0 && CutOffArm(slice, side, &expected)) next = slice.arm[IndexOf(side)];
      if (next < 0) break;
      slice.arm[IndexOf(side)] = next;
      drift = 0.7 * drift + 0.3 * (slice.ArmLoop(side)->centroid - middle);
      middle = slice.ArmLoop(side)->centroid;
    }
  }

  static ArmSeparationOptions FoldOptions(Side side, double max_neck_ratio) {
    ArmSeparationOptions options;
    options.sign = SignOf(side);
    options.max_neck_ratio = max_neck_ratio;
    return options;
  }

  // Cuts an arm that touches the trunk off the slice's trunk outline; false where none does, or none near the
  // `expected` place if there is one: just above the crotch a thigh has a neck like an arm's.
  static bool CutOffArm(BodySlice& slice, Side side, const Eigen::Vector2d* expected = nullptr) {
    if (slice.trunk < 0) return false;
    auto parts = SeparateArm(*slice.TrunkLoop(), FoldOptions(side, kTouchingNeck));
    if (!parts || (expected != nullptr && (parts->arm.centroid - *expected).norm() > kArmJump)) return false;
    slice.loops[static_cast<size_t>(slice.trunk)] = std::move(parts->trunk);
    slice.loops.push_back(std::move(parts->arm));
    slice.arm[IndexOf(side)] = static_cast<int>(slice.loops.size()) - 1;
    return true;
  }

  // Draws the trunk's outline in to the vertical plane at `limit`, where an arm is too broadly joined to be cut off.
  static void ClipTrunk(BodySlice& slice, Side side, double limit) {
    if (slice.trunk < 0) return;
    SectionLoop& loop = slice.loops[static_cast<size_t>(slice.trunk)];
    loop.bounds.setEmpty();
    for (Eigen::Vector2d& p : loop.points) {
      if (SignOf(side) * (p.x() - limit) > 0.0) p.x() = limit;
      loop.bounds.extend(p);
    }
    const PolygonMoments moments = ComputeMoments(loop.points);
    loop.area = std::abs(moments.signed_area);
    loop.centroid = moments.centroid;
  }

  // The outline nearest to where the arm should go on; -1 where it has ended or touches the trunk.
  int ContinueArm(const BodySlice& slice, const Eigen::Vector2d& expected) const {
    int best = -1;
    double best_distance = kArmJump;
    for (size_t i = 0; i < slice.loops.size(); ++i) {
      const int number = static_cast<int>(i);
      if (number == slice.trunk || number == slice.leg[0] || number == slice.leg[1]) continue;
      const double distance =
          slice.loops[i].bounds.exteriorDistance(expected) + 0.2 * (slice.loops[i].centroid - expected).norm();
      if (distance < best_distance) {
        best_distance = distance;
        best = number;
      }
    }
    return best;
  }

  void RefineArmpit(Side side, const BodySlice& below, const BodySlice& above) {
    double apart = below.height;
    double joined = above.height;
    std::vector<SectionLoop> loops_below = below.loops;
    int trunk = below.trunk;
    int arm = below.arm[IndexOf(side)];
    if (trunk < 0) return;
    while (joined - apart > kHeightTolerance) {
      const double height = 0.5 * (apart + joined);
      std::vector<SectionLoop> loops = index_.CutAt(height, options_);
      const int trunk_here = ContinueTrunk(loops, loops_below[static_cast<size_t>(trunk)].centroid);
      const int arm_here = trunk_here < 0 ? -1 : FindArm(loops, trunk_here, side, body_.stature);
      if (arm_here < 0) {
        joined = height;
      } else {
        apart = height;
        loops_below = std::move(loops);
        trunk = trunk_here;
        arm = arm_here;
      }
    }
    const SectionLoop& trunk_loop = loops_below[static_cast<size_t>(trunk)];
    const SectionLoop& arm_loop = loops_below[static_cast<size_t>(arm)];
    const Eigen::Vector2d gap = MiddleOfGap(trunk_loop, arm_loop);
    MergePoint& armpit = body_.armpit[IndexOf(side)];
    armpit.position = Eigen::Vector3d(gap.x(), joined, gap.y());
    armpit.bridge_length = trunk_loop.bridge_length + arm_loop.bridge_length;
    armpit.found = true;
  }

  const HeightIndex& index_;
  SectionOptions options_;
  BodySlices body_;
};

}  // namespace

const BodySlice& BodySlices::At(double height) const {
  const auto last = static_cast<double>(slices.size() - 1);
  return slices[static_cast<size_t>(std::clamp(height / kSliceStep - 0.5 + 0.5, 0.0, last))];
}

Result<BodySlices> SliceBody(const HeightIndex& index) { return Slicer(index).Run(); }

}  // namespace fitroom
