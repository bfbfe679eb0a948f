#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace fitroom {

// Returns the corners of the convex hull of `points`, counter-clockwise, without collinear corners. Fewer than three
// distinct points come back as they are (sorted, without repetition).
std::vector<Eigen::Vector2d> ConvexHull(std::span<const Eigen::Vector2d> points);

// Returns the length of the closed polygon through `points`.
double ClosedLength(std::span<const Eigen::Vector2d> points);

// Returns what a tape round the points would measure: the perimeter of their convex hull.
double TapeLength(std::span<const Eigen::Vector2d> points);

// Signed area and centroid of a closed polygon; the centroid of a polygon without area is the mean of its corners.
struct PolygonMoments {
  double signed_area = 0.0;  // Positive where the corners run counter-clockwise.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
};
PolygonMoments ComputeMoments(std::span<const Eigen::Vector2d> points);

}  // namespace fitroom
