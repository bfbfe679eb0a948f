#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

// Closed polygons in image coordinates (x right, y down; unit: pixel); the first point is not repeated.
namespace fitroom {

using Polygon = std::vector<Eigen::Vector2d>;

// Returns the enclosed area, positive if the polygon runs clockwise on the screen.
double SignedArea(const Polygon& polygon);

double Perimeter(const Polygon& polygon);

// A place on a polygon: on the edge from point `edge` to the next, `arc_length` from point 0.
struct OutlinePlace {
  size_t edge = 0;
  double arc_length = 0.0;  // (unit: pixel)
  double distance = 0.0;    // From the point that was asked for (unit: pixel).
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Returns the place on the polygon that is nearest to `point`; the first of equals. The polygon is not empty.
OutlinePlace NearestPlace(const Polygon& polygon, const Eigen::Vector2d& point);

// Returns the place at an arc length from point 0; any real number, taken round and round.
OutlinePlace PlaceAt(const Polygon& polygon, double arc_length);

struct Crossing {
  size_t first_edge = 0;
  size_t second_edge = 0;
};

// Returns two edges that are not neighbours and meet, or neighbours that fold back onto each other; nothing if the
// polygon is simple. Time grows with the square of the number of points.
std::optional<Crossing> FindCrossing(const Polygon& polygon);

}  // namespace fitroom
