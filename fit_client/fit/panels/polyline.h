#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace fitroom::panels {

// An open chain of points in the plane. Closed polygons use the same type; their first point is not repeated.
using Polyline = std::vector<Eigen::Vector2d>;

// Returns the length along the chain from its first point to each of its points.
std::vector<double> CumulativeLengths(std::span<const Eigen::Vector2d> chain);

double ChainLength(std::span<const Eigen::Vector2d> chain);

// Returns the point at `value` of the monotone `parameters`, one a point, linear in between and clamped at the ends.
Eigen::Vector2d InterpolateChain(std::span<const Eigen::Vector2d> chain, std::span<const double> parameters,
                                 double value);

// Returns `count` + 1 points at equal steps of arc length; the ends are kept exactly.
Polyline ResampleChain(std::span<const Eigen::Vector2d> chain, int count);

// Smooths equally spaced samples by a Gaussian whose standard deviation is `sigma_in_steps` samples, and keeps both
// ends exactly: the chain is carried on beyond an end by its point reflection there.
Polyline SmoothSamples(const Polyline& samples, double sigma_in_steps);

// Fits a Bezier curve of `degree` to points at `parameters` (0 to 1) by least squares, with its ends on the first and
// last point, and returns the curve at the same parameters. With fewer points than the degree needs the degree falls.
// The point `held`, if not negative, is followed more closely than the rest.
Polyline FitBezier(std::span<const Eigen::Vector2d> points, std::span<const double> parameters, int degree,
                   int held = -1);

// Returns the signed area of a closed polygon, positive if counter-clockwise.
double SignedArea(std::span<const Eigen::Vector2d> polygon);

bool PolygonContains(std::span<const Eigen::Vector2d> polygon, const Eigen::Vector2d& point);

// Says whether no two sides of the closed polygon meet except neighbours at their common corner.
bool IsSimplePolygon(std::span<const Eigen::Vector2d> polygon);

double DistanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a, const Eigen::Vector2d& b);

double DistanceToChain(const Eigen::Vector2d& point, std::span<const Eigen::Vector2d> chain);

}  // namespace fitroom::panels
