#include "common/body/stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "common/body/plane_section.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

// All lengths here are parts of the stature: the mesh is scaled to height 1. The limits are wide: they tell bodies from
// chairs, cars and halves of bodies, not one body from another.
constexpr int kLevelCount = 100;
constexpr double kMinLimbArea = 2.5e-4;  // 6 cm² at a stature of 1.6 m: less than an ankle.

// One part of the stature, by section levels.
struct Range {
  double low, high;
};
constexpr Range kShins = {0.08, 0.30};
constexpr Range kTrunk = {0.52, 0.70};
constexpr Range kHead = {0.90, 0.97};

// The mesh turned so that the candidate direction is Y, scaled to height 1, floor at 0; and its sections.
struct Upright {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d origin;  // Of the scaled frame, in the mesh's frame.
  double height = 0.0;
  std::vector<std::vector<SectionLoop>> levels;

  const std::vector<SectionLoop>& At(double part) const {
    return levels[static_cast<size_t>(std::clamp(part * kLevelCount, 0.0, kLevelCount - 1.0))];
  }
};

Eigen::Matrix3d RotationToY(const Eigen::Vector3d& up) {
  const Eigen::Vector3d aside = std::abs(up.x()) < 0.5 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d rotation;
  rotation.row(1) = up.transpose();
  rotation.row(2) = aside.cross(up).normalized().transpose();
  rotation.row(0) = up.cross(Eigen::Vector3d(rotation.row(2).transpose())).transpose();
  return rotation;
}

// Segments that all levels together may cut. A scan of 8 million triangles has 1.2 million; a mesh that has more is no
// surface but a tangle of long triangles, and would take minutes.
constexpr double kMaxSegmentCount = 4e6;

double ExpectedSegmentCount(const TriangleMesh& mesh) {
  double count = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const double a = mesh.vertices[static_cast<size_t>(t[0])].y();
    const double b = mesh.vertices[static_cast<size_t>(t[1])].y();
    const double c = mesh.vertices[static_cast<size_t>(t[2])].y();
    count += kLevelCount * (std::max({a, b, c}) - std::min({a, b, c}));
  }
  return count;
}

// Cuts the mesh at evenly spaced levels. An empty result for a mesh without height, or of too long triangles.
Upright StandUpright(const TriangleMesh& mesh, const Eigen::Vector3d& up) {
  Upright upright;
  upright.rotation = RotationToY(up);
  TriangleMesh turned;
  turned.vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& p : mesh.vertices) turned.vertices.push_back(upright.rotation * p);
  const Eigen::AlignedBox3d bounds = ComputeBounds(turned);
  upright.height = bounds.sizes().y();
  if (!(upright.height > 0.0)) return upright;
  const Eigen::Vector3d corner(bounds.center().x(), bounds.min().y(), bounds.center().z());
  upright.origin = upright.rotation.transpose() * corner;
  for (Eigen::Vector3d& p : turned.vertices) p = (p - corner) / upright.height;
  turned.triangles = mesh.triangles;
  if (ExpectedSegmentCount(turned) > kMaxSegmentCount) return upright;
  const HeightIndex index(turned, kLevelCount);
  SectionOptions options;
  options.min_area = kMinLimbArea;
  options.max_bridge = 0.1;
  for (int level = 0; level < kLevelCount; ++level) {
    upright.levels.push_back(index.CutAt((level + 0.5) / kLevelCount, options));
  }
  return upright;
}

// The same body upside down: the sections in reverse order, one horizontal axis turned with them.
Upright TurnedOver(const Upright& upright) {
  Upright over = upright;
  std::reverse(over.levels.begin(), over.levels.end());
  for (auto& level : over.levels) {
    for (SectionLoop& loop : level) {
      for (Eigen::Vector2d& p : loop.points) p.x() = -p.x();
      loop.centroid.x() = -loop.centroid.x();
    }
  }
  over.rotation.row(0) = -upright.rotation.row(0);
  over.rotation.row(1) = -upright.rotation.row(1);
  over.origin = upright.origin + upright.height * upright.rotation.row(1).transpose();
  return over;
}

// What the shins look like over their range of levels.
struct Shins {
  int level_count = 0;
  int paired_levels = 0;   // Two outlines of like size.
  int crowded_levels = 0;  // Four or more of like size.
  double area = 0.0;       // Mean of one leg's section.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d across = Eigen::Vector2d::Zero();  // From one leg to the other; the sign is arbitrary.
};

Shins LookAtShins(const Upright& upright) {
  Shins shins;
  for (double part = kShins.low; part < kShins.high; part += 1.0 / kLevelCount) {
    const std::vector<SectionLoop>& loops = upright.At(part);
    ++shins.level_count;
    if (loops.size() >= 4 && loops[3].area > 0.4 * loops[0].area) ++shins.crowded_levels;
    if (loops.size() < 2 || loops[1].area < 0.45 * loops[0].area) continue;
    if (loops.size() > 2 && loops[2].area > 0.4 * loops[1].area) continue;
    ++shins.paired_levels;
    Eigen::Vector2d across = loops[1].centroid - loops[0].centroid;
    if (across.dot(shins.across) < 0.0) across = -across;
    shins.across += across;
    shins.area += 0.5 * (loops[0].area + loops[1].area);
    shins.middle += 0.5 * (loops[0].centroid + loops[1].centroid);
  }
  if (shins.paired_levels > 0) {
    shins.across /= shins.paired_levels;
    shins.area /= shins.paired_levels;
    shins.middle /= shins.paired_levels;
  }
  return shins;
}

// Counts the levels of a range at which one outline is much larger than the rest together.
struct SingleMass {
  int level_count = 0;
  int single_levels = 0;
  int crowded_levels = 0;  // Two or more large outlines.
  double area = 0.0;       // Median of the largest outlines.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  // Largest extent of the outline and the one across it.
};

// The extents of an outline along its own longest direction and across it.
Eigen::Vector2d OwnExtents(const SectionLoop& loop) {
  double longest = 0.0;
  double shortest = 1e300;
  for (int step = 0; step < 18; ++step) {
    const double angle = std::numbers::pi * step / 18.0;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    double low = 1e300;
    double high = -1e300;
    for (const Eigen::Vector2d& p : loop.points) {
      low = std::min(low, p.dot(direction));
      high = std::max(high, p.dot(direction));
    }
    longest = std::max(longest, high - low);
    shortest = std::min(shortest, high - low);
  }
  return {longest, shortest};
}

SingleMass LookAtMass(const Upright& upright, Range range) {
  SingleMass mass;
  std::vector<double> areas;
  for (double part = range.low; part < range.high; part += 1.0 / kLevelCount) {
    const std::vector<SectionLoop>& loops = upright.At(part);
    ++mass.level_count;
    if (loops.empty()) continue;
    areas.push_back(loops[0].area);
    if (loops.size() > 1 && loops[1].area > 0.5 * loops[0].area) {
      ++mass.crowded_levels;
      continue;
    }
    ++mass.single_levels;
    mass.middle += loops[0].centroid;
    mass.size += OwnExtents(loops[0]);
  }
  if (mass.single_levels > 0) {
    mass.middle /= mass.single_levels;
    mass.size /= mass.single_levels;
  }
  if (!areas.empty()) {
    std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2), areas.end());
    mass.area = areas[areas.size() / 2];
  }
  return mass;
}

// Returns what keeps the shape from being one standing body; OK if nothing does.
Status CheckStance(const Shins& shins, const SingleMass& trunk, const SingleMass& head) {
  if (2 * shins.crowded_levels > shins.level_count && 2 * head.crowded_levels > head.level_count) {
    return InvalidArgument("SEVERAL_BODIES", "the file shows more than one body; export each person's scan on its own");
  }
  const auto missing = [](const std::string& what) {
    return InvalidArgument("NOT_A_BODY", "this is not one whole standing body: " + what +
                                             "; the scan must show a person upright from the soles to the crown, legs "
                                             "apart below the knee");
  };
  if (3 * shins.paired_levels < 2 * shins.level_count) return missing("there are no two legs at its lower end");
  const double legs_apart = shins.across.norm();
  if (legs_apart < 0.03 || legs_apart > 0.6) return missing("the legs are not beside each other");
  if (3 * trunk.single_levels < 2 * trunk.level_count) return missing("there is no trunk above the legs");
  if (trunk.area < 1.5 * shins.area) return missing("the trunk is not thicker than a leg");
  if (trunk.area < 0.008 || trunk.area > 0.2 || trunk.size.x() > 0.6 || trunk.size.y() < 0.04) {
    return missing("the trunk has not the size of a trunk");
  }
  if ((trunk.middle - shins.middle).norm() > 0.15) return missing("the trunk is not above the legs");
  if (3 * head.single_levels < 2 * head.level_count) return missing("there is no head at its upper end");
  if (head.area < 0.002 || head.area > 0.035 || head.size.x() > 0.2) return missing("the head has not a head's size");
  if ((head.middle - trunk.middle).norm() > 0.15) return missing("the head is not above the trunk");
  return {};
}

// The extent of all outlines of a level along a direction, relative to their own common middle.
struct Reach {
  double front = 0.0, back = 0.0;
};

// How far the feet reach before and behind the ankles.
Reach ReachOfFeet(const Upright& upright, const Eigen::Vector2d& forward) {
  Reach reach;
  double ankle = 0.0;
  int ankle_count = 0;
  for (const double part : {0.055, 0.065, 0.075, 0.085}) {
    for (size_t i = 0; i < std::min<size_t>(2, upright.At(part).size()); ++i) {
      ankle += upright.At(part)[i].centroid.dot(forward);
      ++ankle_count;
    }
  }
  if (ankle_count == 0) return reach;
  ankle /= ankle_count;
  for (const double part : {0.005, 0.015, 0.025, 0.035}) {
    for (const SectionLoop& loop : upright.At(part)) {
      for (const Eigen::Vector2d& p : loop.points) {
        reach.front = std::max(reach.front, p.dot(forward) - ankle);
        reach.back = std::max(reach.back, ankle - p.dot(forward));
      }
    }
  }
  return reach;
}

// Turns `forward` to where the toes point; where the feet do not tell, to where the face lies before the nape.
void ChooseForward(const Upright& upright, const SingleMass& head, Eigen::Vector2d& forward, std::string& reason) {
  const Reach feet = ReachOfFeet(upright, forward);
  if (std::abs(feet.front - feet.back) > 0.02) {
    if (feet.front < feet.back) forward = -forward;
    reason = "the feet reach farther on that side of the ankles";
    return;
  }
  const SingleMass nape = LookAtMass(upright, {0.84, 0.87});
  if ((head.middle - nape.middle).dot(forward) < 0.0) forward = -forward;
  reason = "the head lies before the neck (the feet do not tell)";
}

}  // namespace

Result<Stance> FindStanceAlong(const TriangleMesh& mesh, const Eigen::Vector3d& up, bool sign_is_known) {
  Upright upright = StandUpright(mesh, up);
  if (upright.levels.empty()) return InvalidArgument("NOT_A_BODY", "the mesh is flat or a tangle; this is not a body");
  Status failure;
  for (const bool over : {false, true}) {
    if (over && sign_is_known) break;
    if (over) upright = TurnedOver(upright);
    const Shins shins = LookAtShins(upright);
    const SingleMass trunk = LookAtMass(upright, kTrunk);
    const SingleMass head = LookAtMass(upright, kHead);
    const Status status = CheckStance(shins, trunk, head);
    if (!status.ok()) {
      if (failure.ok() || status.reason() == "SEVERAL_BODIES") failure = status;
      continue;
    }
    const Eigen::Vector2d across = shins.across.normalized();
    Eigen::Vector2d forward(-across.y(), across.x());
    Stance stance;
    ChooseForward(upright, head, forward, stance.facing_reason);
    stance.up = upright.rotation.row(1).transpose();
    stance.forward = upright.rotation.transpose() * Eigen::Vector3d(forward.x(), 0.0, forward.y());
    const Eigen::Vector3d middle(trunk.middle.x(), 0.0, trunk.middle.y());
    stance.floor_centre = upright.origin + upright.height * (upright.rotation.transpose() * middle);
    stance.stature = upright.height;
    stance.up_reason = "two legs at the lower end, one trunk above them, one head at the upper end";
    return stance;
  }
  return failure;
}

}  // namespace fitroom
