#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/base/status.h"
#include "common/body/plane_section.h"

namespace fitroom {

// Left and right are the body's own.
enum class Side { kLeft = 0, kRight = 1 };
inline constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};
// +1 for the left (+X), -1 for the right.
inline double SignOf(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }
inline size_t IndexOf(Side side) { return static_cast<size_t>(side); }

// One horizontal section, its outlines named. Indices into `loops`; -1 where there is none.
struct BodySlice {
  double height = 0.0;
  std::vector<SectionLoop> loops;  // Largest first.
  int trunk = -1;                  // From the crotch to the crown: legs joined, neck, head.
  std::array<int, 2> leg = {-1, -1};
  std::array<int, 2> arm = {-1, -1};

  const SectionLoop* TrunkLoop() const { return trunk < 0 ? nullptr : &loops[static_cast<size_t>(trunk)]; }
  const SectionLoop* LegLoop(Side side) const {
    return leg[IndexOf(side)] < 0 ? nullptr : &loops[static_cast<size_t>(leg[IndexOf(side)])];
  }
  const SectionLoop* ArmLoop(Side side) const {
    return arm[IndexOf(side)] < 0 ? nullptr : &loops[static_cast<size_t>(arm[IndexOf(side)])];
  }
};

// Where two outlines become one: the height, and the middle of the narrowest gap just below it.
struct MergePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double bridge_length = 0.0;  // Of the outlines there: how much of them was guessed over holes.
  bool found = false;
  bool touching = false;  // Both parts touch below: the place was told from the outline's shape.
};

// A body in its canonical frame cut into horizontal slices every 5 mm, with the outlines followed from slice to slice.
struct BodySlices {
  double stature = 0.0;  // Height of the mesh.
  std::vector<BodySlice> slices;
  MergePoint crotch;                 // The two legs become the trunk.
  std::array<MergePoint, 2> armpit;  // An arm leaves the trunk.

  // The slice nearest to a height.
  const BodySlice& At(double height) const;
};

inline constexpr double kSliceStep = 0.005;  // (unit: metre)

// Cuts the indexed mesh and follows legs, trunk and arms. NOT_A_BODY where the legs never join.
Result<BodySlices> SliceBody(const HeightIndex& index);

}  // namespace fitroom
