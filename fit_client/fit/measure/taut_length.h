#pragma once

#include <span>

#include <Eigen/Core>

namespace fitroom {

// Returns how long cloth has to be to run from `from` to `to`, both in the plane of the points, past all `outline`
// points that lie to the left of the way from one to the other (seen along it) and `offset` away from them: a string
// pulled tight. Outline points on the right side are not looked at; the straight way where none is on the left. (unit:
// metre)
//
//            o  o           The points o push the string outwards;
//         o        o        the points x do not.
//   from ------------ to
//            x  x
double TautLength(std::span<const Eigen::Vector2d> outline, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  double offset);

}  // namespace fitroom
