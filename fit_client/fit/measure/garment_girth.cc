#include "fit_client/fit/measure/garment_girth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "fit_client/fit/measure/contact_pressure.h"
#include "fit_client/fit/measure/garment_line.h"

namespace fitroom {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A point where the plane meets the cloth: x and z (unit: metre).
using Point = Eigen::Vector2d;

// Where the plane cuts the cloth: points on edges of the mesh and the segments between them, one a triangle.
struct Section {
  std::vector<Point> points;
  std::vector<bool> may_be_bridged;  // One a point: the cloth goes on here as a sleeve, or across an open seam.
  std::vector<std::pair<int, int>> segments;
};

// A polyline of a section. `closed`: the last point is joined to the first, which is not repeated.
struct Chain {
  std::vector<Point> points;
  bool closed = false;
  bool ends_may_be_bridged = false;
};

// Says whether a triangle belongs to a sleeve. Nobody knows: it does not.
bool IsSleeve(const ClothMesh& cloth, const Eigen::Vector3i& triangle) {
  return std::max(SleevePart(cloth, triangle, true), SleevePart(cloth, triangle, false)) > 0.5;
}

using Edge = std::pair<int, int>;  // Of sewn particles, the lower first.

// Cuts triangles at a height. A particle exactly on the plane counts as above it, so that every cut triangle gives one
// segment and no point is met twice.
class Cutter {
 public:
  Cutter(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions, double height)
      : cloth_(cloth), positions_(positions), height_(height), sewn_(SewParticles(cloth, positions)) {}

  Section CutTorso() {
    std::set<Edge> sleeve_edges;
    for (const Eigen::Vector3i& triangle : cloth_.triangles) {
      const std::vector<Edge> edges = CutEdges(triangle);
      if (edges.size() != 2) continue;
      if (IsSleeve(cloth_, triangle)) {
        sleeve_edges.insert(edges.begin(), edges.end());
        continue;
      }
      const int from = PointOn(edges[0]);
      const int to = PointOn(edges[1]);
      if (from != to) section_.segments.emplace_back(from, to);
    }
    std::vector<bool> is_on_seam(positions_.size(), false);
    for (const SeamPair& pair : cloth_.seams) {
      is_on_seam[Sewn(pair.a)] = true;
      is_on_seam[Sewn(pair.b)] = true;
    }
    section_.may_be_bridged.resize(section_.points.size());
    for (const auto& [edge, point] : point_of_edge_) {
      section_.may_be_bridged[static_cast<size_t>(point)] =
          sleeve_edges.contains(edge) ||
          (is_on_seam[static_cast<size_t>(edge.first)] && is_on_seam[static_cast<size_t>(edge.second)]);
    }
    return std::move(section_);
  }

 private:
  size_t Sewn(int particle) const { return static_cast<size_t>(sewn_[static_cast<size_t>(particle)]); }
  bool IsAbove(int particle) const { return positions_[Sewn(particle)].y() >= height_; }

  // Returns the two edges of a triangle that the plane cuts, or none.
  std::vector<Edge> CutEdges(const Eigen::Vector3i& triangle) const {
    std::vector<Edge> edges;
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      if (IsAbove(a) != IsAbove(b)) {
        edges.push_back(std::minmax(sewn_[static_cast<size_t>(a)], sewn_[static_cast<size_t>(b)]));
      }
    }
    return edges;
  }

  int PointOn(const Edge& edge) {
    const auto [known, is_new] = point_of_edge_.try_emplace(edge, static_cast<int>(section_.points.size()));
    if (is_new) {
      const Eigen::Vector3d& p = positions_[static_cast<size_t>(edge.first)];
      const Eigen::Vector3d& q = positions_[static_cast<size_t>(edge.second)];
      const double t = std::clamp((height_ - p.y()) / (q.y() - p.y()), 0.0, 1.0);
      section_.points.emplace_back(p.x() + t * (q.x() - p.x()), p.z() + t * (q.z() - p.z()));
    }
    return known->second;
  }

  const ClothMesh& cloth_;
  const std::vector<Eigen::Vector3d>& positions_;
  const double height_;
  const std::vector<int> sewn_;
  std::map<Edge, int> point_of_edge_;
  Section section_;
};

// Joins segments that share a point. Chains begin at open ends first, so that an open chain is never cut in two.
std::vector<Chain> LinkChains(const Section& section) {
  std::vector<std::vector<int>> segments_of(section.points.size());
  for (size_t s = 0; s < section.segments.size(); ++s) {
    segments_of[static_cast<size_t>(section.segments[s].first)].push_back(static_cast<int>(s));
    segments_of[static_cast<size_t>(section.segments[s].second)].push_back(static_cast<int>(s));
  }
  std::vector<bool> used(section.segments.size(), false);
  std::vector<Chain> chains;
  const auto walk = [&](int start) {
    Chain chain;
    int point = start;
    chain.points.push_back(section.points[static_cast<size_t>(point)]);
    for (;;) {
      int next = -1;
      for (const int s : segments_of[static_cast<size_t>(point)]) {
        if (used[static_cast<size_t>(s)]) continue;
        used[static_cast<size_t>(s)] = true;
        const auto& [a, b] = section.segments[static_cast<size_t>(s)];
        next = a == point ? b : a;
        break;
      }
      if (next < 0) break;
      point = next;
      if (point == start) {
        chain.closed = true;
        break;
      }
      chain.points.push_back(section.points[static_cast<size_t>(point)]);
    }
    chain.ends_may_be_bridged =
        section.may_be_bridged[static_cast<size_t>(start)] && section.may_be_bridged[static_cast<size_t>(point)];
    if (chain.points.size() > 1) chains.push_back(std::move(chain));
  };
  for (size_t p = 0; p < section.points.size(); ++p) {
    if (segments_of[p].size() % 2 == 1) walk(static_cast<int>(p));
  }
  for (size_t p = 0; p < section.points.size(); ++p) walk(static_cast<int>(p));
  return chains;
}

// Returns how often a polyline turns round `centre`, in turns; a closed one is closed by its last segment.
double TurnsRound(const std::vector<Point>& points, bool closed, const Point& centre) {
  double angle = 0.0;
  const size_t count = closed ? points.size() : points.size() - 1;
  for (size_t i = 0; i < count; ++i) {
    const Point a = points[i] - centre;
    const Point b = points[(i + 1) % points.size()] - centre;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return angle / (2.0 * kPi);
}

double Length(const std::vector<Point>& points, bool closed) {
  double length = closed ? (points.front() - points.back()).norm() : 0.0;
  for (size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

// Perimeter of the convex hull (Andrew's monotone chain).
double HullLength(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const size_t base = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= base + 2) {
        const Point a = hull[hull.size() - 1] - hull[hull.size() - 2];
        const Point b = point - hull[hull.size() - 2];
        if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull.size() > 1 ? Length(hull, /*closed=*/true) : 0.0;
}

// Joins open chains to one closed curve, always on to the nearest free end. Returns the curve; adds up the bridges.
std::vector<Point> JoinChains(std::vector<Chain> chains, double& bridged_length) {
  std::vector<Point> curve = std::move(chains.front().points);
  chains.erase(chains.begin());
  while (!chains.empty()) {
    size_t best = 0;
    bool reversed = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t c = 0; c < chains.size(); ++c) {
      for (const bool from_back : {false, true}) {
        const Point& end = from_back ? chains[c].points.back() : chains[c].points.front();
        const double distance = (end - curve.back()).norm();
        if (distance < nearest) {
          nearest = distance;
          best = c;
          reversed = from_back;
        }
      }
    }
    std::vector<Point>& points = chains[best].points;
    if (reversed) std::reverse(points.begin(), points.end());
    curve.insert(curve.end(), points.begin(), points.end());
    bridged_length += nearest;
    chains.erase(chains.begin() + static_cast<ptrdiff_t>(best));
  }
  bridged_length += (curve.front() - curve.back()).norm();
  return curve;
}

}  // namespace

GarmentGirth MeasureDrapedGirth(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions, double height,
                                const Eigen::Vector2d& axis) {
  GarmentGirth result;
  if (positions.size() != cloth.rest_positions.size()) return result;
  std::vector<Chain> chains = LinkChains(Cutter(cloth, positions, height).CutTorso());
  // A whole curve round the axis; of several (folds of a hem) the longest.
  for (const Chain& chain : chains) {
    if (!chain.closed || std::abs(TurnsRound(chain.points, true, axis)) < 0.5) continue;
    const double length = Length(chain.points, true);
    if (length <= result.girth) continue;
    result = {true, length, HullLength(chain.points), 0.0};
  }
  if (result.found) return result;
  // Otherwise the open pieces between the armholes. Closed curves beside the axis are folds.
  std::erase_if(chains, [](const Chain& chain) { return chain.closed; });
  if (chains.empty()) return result;
  // An end at a hem or a neckline: the garment does not go round here.
  for (const Chain& chain : chains) {
    if (!chain.ends_may_be_bridged) return result;
  }
  double bridged_length = 0.0;
  const std::vector<Point> curve = JoinChains(std::move(chains), bridged_length);
  if (std::abs(TurnsRound(curve, true, axis)) < 0.5) return result;
  return {true, Length(curve, true), HullLength(curve), bridged_length};
}

}  // namespace fitroom
