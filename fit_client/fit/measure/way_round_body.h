#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/body/plane_section.h"
#include "common/body/tape_girths.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/measure/garment_line.h"

namespace fitroom {

// How long cloth has to be to go round a body and what is worn on it. Refers to both, which must outlive it.
class WayRoundBody {
 public:
  WayRoundBody(const Body& body, const std::vector<const TriangleMesh*>& layers);

  const TapeGirths& tape() const { return tape_; }

  // The level section of the trunk and of what is worn on it, as (x, z).
  std::vector<Eigen::Vector2d> OutlineAt(double height) const;

  // Returns the length of a taut string from end to end of a half, `offset` away from body and layers, in the plane in
  // which the half lies (PlaneOf()): over a bust a line rises from the seams, and the level way would be shorter.
  double TautLengthOf(const LineHalf& half, bool is_front, double offset) const;

 private:
  TapeGirths tape_;
  std::vector<HeightIndex> layers_;
};

// Returns the plane through a half's ends and its centre, with the right end at (0, 0), the left one at (d, 0) and the
// side to which the half bulges at positive v. A half that hardly bulges, or that is steeper than a half line ever lies
// on a body, is taken as level; nothing where its ends are on one vertical.
std::optional<SectionPlane> PlaneOf(const LineHalf& half, bool is_front);

}  // namespace fitroom
