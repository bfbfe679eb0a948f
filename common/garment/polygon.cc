#include "common/garment/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/check.h"

namespace fitroom {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Twice the signed area of the triangle a, b, c.
double Orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return Cross(b - a, c - a);
}

bool OnSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

int Sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

bool SegmentsMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d) {
  const int abc = Sign(Orientation(a, b, c));
  const int abd = Sign(Orientation(a, b, d));
  const int cda = Sign(Orientation(c, d, a));
  const int cdb = Sign(Orientation(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && OnSegment(a, b, c)) || (abd == 0 && OnSegment(a, b, d)) || (cda == 0 && OnSegment(c, d, a)) ||
         (cdb == 0 && OnSegment(c, d, b));
}

// Edge i+1 starts where edge i ends; they meet elsewhere only if it turns back along it.
bool FoldsBack(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return Orientation(a, b, c) == 0 && (b - a).dot(c - b) < 0;
}

}  // namespace

double SignedArea(const Polygon& polygon) {
  double twice_area = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) twice_area += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice_area;
}

double Perimeter(const Polygon& polygon) {
  double length = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return length;
}

OutlinePlace NearestPlace(const Polygon& polygon, const Eigen::Vector2d& point) {
  FR_CHECK(!polygon.empty());
  OutlinePlace best;
  double best_squared_distance = std::numeric_limits<double>::infinity();
  double before = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - a;
    const double squared_length = edge.squaredNorm();
    const double t = squared_length > 0 ? std::clamp((point - a).dot(edge) / squared_length, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d foot = a + t * edge;
    const double length = std::sqrt(squared_length);
    if ((foot - point).squaredNorm() < best_squared_distance) {
      best_squared_distance = (foot - point).squaredNorm();
      best = {i, before + t * length, std::sqrt(best_squared_distance), foot};
    }
    before += length;
  }
  return best;
}

OutlinePlace PlaceAt(const Polygon& polygon, double arc_length) {
  FR_CHECK(!polygon.empty());
  const double perimeter = Perimeter(polygon);
  double rest = std::fmod(arc_length, perimeter);
  if (rest < 0) rest += perimeter;
  OutlinePlace place;
  place.arc_length = rest;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    if (rest <= length || i + 1 == polygon.size()) {
      place.edge = i;
      place.pixel = length > 0 ? Eigen::Vector2d(polygon[i] + std::min(1.0, rest / length) * edge) : polygon[i];
      return place;
    }
    rest -= length;
  }
  return place;
}

std::optional<Crossing> FindCrossing(const Polygon& polygon) {
  const size_t count = polygon.size();
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % count];
    if (a == b || FoldsBack(a, b, polygon[(i + 2) % count])) return Crossing{i, (i + 1) % count};
    const Eigen::Vector2d low = a.cwiseMin(b);
    const Eigen::Vector2d high = a.cwiseMax(b);
    for (size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;  // Neighbours over the end of the list.
      const Eigen::Vector2d& c = polygon[j];
      const Eigen::Vector2d& d = polygon[(j + 1) % count];
      if (std::max(c.x(), d.x()) < low.x() || std::min(c.x(), d.x()) > high.x() || std::max(c.y(), d.y()) < low.y() ||
          std::min(c.y(), d.y()) > high.y()) {
        continue;
      }
      if (SegmentsMeet(a, b, c, d)) return Crossing{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace fitroom
