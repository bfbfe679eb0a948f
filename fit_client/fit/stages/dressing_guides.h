#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/body/body.h"
#include "fit_client/fit/stages/frontal_map.h"

namespace fitroom {

// A chain of points in the frontal plane, walked by arc length. Metres.
class Polyline {
 public:
  Polyline() = default;
  explicit Polyline(std::vector<Eigen::Vector2d> points);

  // Returns the point `distance` along the line from its start; beyond the ends it goes on straight.
  Eigen::Vector2d At(double distance) const;
  // Returns the arc length at which the line first reaches abscissa u; the nearest end's if it never does.
  double DistanceAtAbscissa(double u) const;
  double length() const { return distances_.empty() ? 0.0 : distances_.back(); }
  const std::vector<Eigen::Vector2d>& points() const { return points_; }

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> distances_;  // Arc length at each point.
};

// Where the seams of a top belong on one half of a body, in the frontal plane (u, y): u grows from the body's middle
// towards its own side, left or right.
//
//   neck .-''-._     shoulder_line: over the shoulder's ridge, then down the arm's outside, taut
//        |        '.
//        |   _.-.   '.
//        |  ( gap :   :
//        |  |     :...:   levels: the torso's side and where the arm begins
struct DressingGuides {
  Polyline shoulder_line;                   // From the side of the neck outwards, one clearance above the body.
  std::vector<Eigen::Vector2d> arm_inside;  // The arm's inner outline from root to end, one clearance away from it.

  // One height of the torso: where it ends and where the arm begins.
  struct Level {
    double torso_end = 0.0;     // Half width of the torso (unit: metre).
    double arm_begin = 0.0;     // Infinity where no arm is beside the torso (unit: metre).
    double half_depth = 0.0;    // Half of the torso's depth (unit: metre).
    double middle_depth = 0.0;  // z midway between the torso's front and back (unit: metre).
  };
  std::vector<Level> levels;  // From levels_begin downwards in equal steps.
  double levels_begin = 0.0;  // Height of the first level, just under the armpit (unit: metre).
  double level_step = 0.005;  // (unit: metre)

  // Returns the level at height y, the nearest one outside of the range.
  const Level& LevelAt(double y) const;
};

// Finds the guides of one half of `body`: side is +1 for its left, -1 for its right; clearance in metres.
// FAILED_PRECONDITION: LANDMARK_MISSING when the neck, shoulder, armpit or arm was not found on the scan,
// ARMS_ALONG_BODY when no gap is seen beside most of the arm.
Result<DressingGuides> FindDressingGuides(const Body& body, const FrontalMap& map, int side, double clearance);

}  // namespace fitroom
