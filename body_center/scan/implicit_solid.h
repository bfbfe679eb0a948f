#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fitroom::body_center {

// A shape given by a function that is negative inside, zero on its surface and positive outside, and grows roughly like
// the distance to the surface (unit: metre). Immutable; safe to share between threads.
class Shape {
 public:
  virtual ~Shape() = default;
  // Returns the function's value at `point`.
  virtual double Evaluate(const Eigen::Vector3d& point) const = 0;
  // Returns a box that holds the whole shape.
  virtual Eigen::AlignedBox3d Bounds() const = 0;
};

// One cross-section of a swept shape: a superellipse whose front and back halves differ.
//
//            v ^  front          |u/half_width|^n + |v/front|^n = 1     for v >= 0
//        .-----+-----.           |u/half_width|^n + |v/back|^n  = 1     for v < 0
//       (      +------)--> u     n = 2 is an ellipse, larger is boxier.
//        '-----+-----'
//              back     (centre is given in the sweep's own frame)
struct SweptSection {
  double position = 0.0;                             // Along the axis (unit: metre).
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // (u, v) (unit: metre).
  double half_width = 0.0;                           // Along u, both ways (unit: metre).
  double front = 0.0;                                // Extent along +v (unit: metre).
  double back = 0.0;                                 // Extent along -v (unit: metre).
  double front_exponent = 2.0;
  double back_exponent = 2.0;
};

// Makes the shape swept by at least two sections with rising positions, interpolated smoothly and cut off flat at both
// ends. `world_from_sweep` places the frame whose axes are u, v and the axis.
std::shared_ptr<const Shape> MakeSweep(const Eigen::Isometry3d& world_from_sweep, std::vector<SweptSection> sections);

// Makes the hull of two balls.
std::shared_ptr<const Shape> MakeRoundCone(const Eigen::Vector3d& start, double start_radius,
                                           const Eigen::Vector3d& end, double end_radius);

// Makes an ellipsoid with axes along the world's.
std::shared_ptr<const Shape> MakeEllipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);

// A solid made of shapes that are blended into one another, part by part within a group and then group by group.
// Cheap to copy: shapes are shared.
class ImplicitSolid {
 public:
  // Which of the figure's groups a surface point belongs to.
  enum class Region { kTorso, kHead, kArm, kLeg };

  // Starts a new group. `blend` is the width over which it is rounded into the groups before it (unit: metre).
  void AddGroup(Region region, double blend);
  // Adds a shape to the last group, rounded into it over `blend` (unit: metre).
  void Add(std::shared_ptr<const Shape> shape, double blend);
  // Takes a shape away from the last group, rounded over `blend` (unit: metre).
  void Carve(std::shared_ptr<const Shape> shape, double blend);

  // Returns the solid's function at `point`; the solid ends at the floor y = 0.
  double Evaluate(const Eigen::Vector3d& point) const;
  // Returns the function's gradient by central differences.
  Eigen::Vector3d Gradient(const Eigen::Vector3d& point) const;
  // Returns the region whose group is nearest.
  Region RegionAt(const Eigen::Vector3d& point) const;

  // Returns the solid reduced to what matters inside `box`: the same values near the surface, computed faster.
  ImplicitSolid RestrictedTo(const Eigen::AlignedBox3d& box) const;
  // Returns the solid without one region's groups.
  ImplicitSolid Without(Region region) const;
  bool empty() const { return groups_.empty(); }
  Eigen::AlignedBox3d Bounds() const;

 private:
  struct Part {
    std::shared_ptr<const Shape> shape;
    Eigen::AlignedBox3d bounds;
    double blend = 0.0;
    bool carved = false;
  };
  struct Group {
    std::vector<Part> parts;
    double blend = 0.0;
    Region region = Region::kTorso;
  };

  static double EvaluateGroup(const Group& group, const Eigen::Vector3d& point);

  std::vector<Group> groups_;
};

}  // namespace fitroom::body_center
