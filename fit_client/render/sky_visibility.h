#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace fitroom::render {

// How much of a wide soft light from above and around reaches a point: 0 none, 1 all. Gives armpits, sleeves, necks and
// hems the soft shadow that makes cloth sit on a body.
//
// Method: orthographic depth maps of the occluders from fixed directions; a receiver counts the directions in which
// nothing stands before it, weighted by the cosine to its normal and by the light from there.
class SkyVisibility {
 public:
  // Starts with no occluder. `bounds_min` and `bounds_max` enclose all occluders (unit: metre).
  SkyVisibility(const Eigen::Vector3d& bounds_min, const Eigen::Vector3d& bounds_max);

  // Adds triangles to what casts shadow.
  void AddOccluder(std::span<const Eigen::Vector3d> positions, std::span<const Eigen::Vector3i> triangles);

  // Returns one value a point. `normals` have unit length (or are zero: fully lit) and point away from the surface.
  std::vector<float> Compute(std::span<const Eigen::Vector3d> positions,
                             std::span<const Eigen::Vector3d> normals) const;

 private:
  // One direction's depth map: the largest height along the direction, a cell of a grid across it.
  struct DepthMap {
    Eigen::Vector3f direction, across, up;
    float weight = 0.0F;
    std::vector<float> heights;
  };
  Eigen::Vector3f centre_;
  float radius_ = 0.0F;
  int cell_count_ = 0;  // A side of the grid.
  std::vector<DepthMap> maps_;
};

}  // namespace fitroom::render
