#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// A tape laid level round a body at a distance: the curve that keeps `offset` from the convex hull of a section. Points
// are found by their way along it. Coordinates (x, z) of the body frame, metres; the way round is from the front (+z)
// over the body's left (+x) to the back.
class TapeCurve {
 public:
  TapeCurve() = default;
  // Lays the tape round `points`, at least three that are not on one line (else is_empty()); offset >= 0.
  TapeCurve(std::span<const Eigen::Vector2d> points, double offset);

  // Lays a tape of a garment's girth round `points`, `clearance` away where the garment is narrower (unit: metre).
  static TapeCurve AsWideAs(double girth, std::span<const Eigen::Vector2d> points, double clearance);

  bool is_empty() const { return points_.empty(); }
  // Returns the tape's length: the hull's perimeter plus 2 pi offset.
  double length() const { return points_.empty() ? 0.0 : distances_.back(); }
  // Returns the point after `distance` along the tape from its start; any number of rounds, also backwards.
  Eigen::Vector2d At(double distance) const;
  // Lets the tape start where the ray from `centre` along `direction` leaves it.
  void StartTowards(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction);
  // Returns the middle of the tape's bounds.
  const Eigen::Vector2d& middle() const { return middle_; }

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> distances_;  // Arc length at each point and, last, of the whole.
  double start_ = 0.0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
};

}  // namespace fitroom
