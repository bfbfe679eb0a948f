#include "fit_client/fit/panels/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "common/base/check.h"
#include "fit_client/fit/panels/exact_predicates.h"

namespace fitroom::panels {
namespace {

//            2
//           / \            Edge k of a triangle lies opposite its corner k: from corner k+1 to corner k+2.
//    n[1]  /   \  n[0]     `neighbour[k]` is the triangle on its other side, -1 outside; `fixed[k]` marks a side of
//         0 --- 1          the polygon.
//          n[2]
struct Triangle {
  std::array<int, 3> corner;
  std::array<int, 3> neighbour;
  std::array<bool, 3> fixed = {false, false, false};
};

constexpr std::array<int, 3> kNext = {1, 2, 0};
constexpr std::array<int, 3> kPrevious = {2, 0, 1};

struct EdgeRef {
  int triangle = -1;
  int edge = -1;
};

// Incremental Delaunay triangulation by edge flips (Lawson 1977), with the polygon's sides recovered by flips (Sloan,
// "A fast algorithm for generating constrained Delaunay triangulations", 1993). All decisions are exact on the grid.
class Triangulator {
 public:
  Status AddPoints(std::span<const Eigen::Vector2d> points);
  Status FixPolygon(int polygon_count);
  std::vector<Eigen::Vector3i> TrianglesInside() const;

 private:
  size_t index(int i) const { return static_cast<size_t>(i); }
  Triangle& at(int t) { return triangles_[index(t)]; }
  const Triangle& at(int t) const { return triangles_[index(t)]; }
  const GridPoint& point(int v) const { return points_[index(v)]; }
  int64_t Turn(int a, int b, int c) const { return Orientation(point(a), point(b), point(c)); }

  int Locate(int v);
  Status Insert(int v);
  void FlipAway(int v, std::vector<int> stack);
  int EdgeTowards(int triangle, int neighbour) const;
  void SetTriangle(int t, std::array<int, 3> corner, std::array<int, 3> neighbour, std::array<bool, 3> fixed);
  void Relink(int t, int from, int to);
  void Flip(int t, int edge);
  void RestoreDelaunay(std::vector<EdgeRef> stack);
  EdgeRef FindEdge(int a, int b) const;
  Status CollectCrossedEdges(int a, int b, std::vector<std::pair<int, int>>& crossed) const;
  Status RecoverEdge(int a, int b);
  void MarkFixed(EdgeRef edge);

  std::vector<GridPoint> points_;  // The input's, then the three corners of the enclosing triangle.
  std::vector<Triangle> triangles_;
  std::vector<int> triangle_of_point_;
  int last_triangle_ = 0;
};

void Triangulator::SetTriangle(int t, std::array<int, 3> corner, std::array<int, 3> neighbour,
                               std::array<bool, 3> fixed) {
  at(t) = {corner, neighbour, fixed};
  for (int v : corner) triangle_of_point_[index(v)] = t;
}

int Triangulator::EdgeTowards(int triangle, int neighbour) const {
  for (int k = 0; k < 3; ++k) {
    if (at(triangle).neighbour[index(k)] == neighbour) return k;
  }
  FR_CHECK(false);
  return -1;
}

// Makes triangle t's link to `from` a link to `to`.
void Triangulator::Relink(int t, int from, int to) {
  if (t >= 0) at(t).neighbour[index(EdgeTowards(t, from))] = to;
}

Status Triangulator::AddPoints(std::span<const Eigen::Vector2d> points) {
  points_.reserve(points.size() + 3);
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d scaled = p * kGridStepsPerMetre;
    if (!p.allFinite() || scaled.cwiseAbs().maxCoeff() > static_cast<double>(kGridInputLimit)) {
      return InvalidArgument("POINT_OUT_OF_RANGE", "a panel's point is not finite or further out than 4 m");
    }
    points_.push_back({std::llround(scaled.x()), std::llround(scaled.y())});
  }
  const int count = static_cast<int>(points.size());
  points_.push_back({-kGridLimit, -kGridLimit});
  points_.push_back({kGridLimit, -kGridLimit});
  points_.push_back({0, kGridLimit});
  triangle_of_point_.assign(points_.size(), 0);
  triangles_.reserve(2 * points_.size() + 1);
  triangles_.push_back({});
  SetTriangle(0, {count, count + 1, count + 2}, {-1, -1, -1}, {});
  for (int v = 0; v < count; ++v) FR_RETURN_IF_ERROR(Insert(v));
  return Status();
}

// Walks from the last triangle towards the point. With exact signs the walk ends, because the triangulation is Delaunay
// whenever it is called.
int Triangulator::Locate(int v) {
  int t = last_triangle_;
  for (;;) {
    int next = -1;
    for (int k = 0; k < 3 && next < 0; ++k) {
      const auto& corner = at(t).corner;
      if (Turn(corner[index(kNext[index(k)])], corner[index(kPrevious[index(k)])], v) < 0) {
        next = at(t).neighbour[index(k)];
        FR_CHECK(next >= 0);  // All points lie inside the enclosing triangle.
      }
    }
    if (next < 0) return t;
    t = next;
  }
}

Status Triangulator::Insert(int v) {
  const int t = Locate(v);
  const auto [a, b, c] = at(t).corner;
  for (int corner : {a, b, c}) {
    if (point(corner).x == point(v).x && point(corner).y == point(v).y) {
      return InvalidArgument("DUPLICATE_POINT", "points " + std::to_string(corner) + " and " + std::to_string(v) +
                                                    " of a panel lie on the same place");
    }
  }
  // A point on an edge makes one triangle of no area here; the flips below mend it at once, because the point lies
  // inside the circle of the triangle on the edge's other side.
  const auto [na, nb, nc] = at(t).neighbour;
  const int t1 = static_cast<int>(triangles_.size());
  const int t2 = t1 + 1;
  triangles_.resize(triangles_.size() + 2);
  SetTriangle(t, {v, b, c}, {na, t1, t2}, {});
  SetTriangle(t1, {v, c, a}, {nb, t2, t}, {});
  SetTriangle(t2, {v, a, b}, {nc, t, t1}, {});
  Relink(nb, t, t1);
  Relink(nc, t, t2);
  last_triangle_ = t;
  FlipAway(v, {t, t1, t2});
  return Status();
}

// Flips the far edges of v's triangles until v sees only Delaunay edges.
void Triangulator::FlipAway(int v, std::vector<int> stack) {
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    const auto& own = at(t).corner;
    const int far_edge = static_cast<int>(std::find(own.begin(), own.end(), v) - own.begin());
    const int other = at(t).neighbour[index(far_edge)];
    if (other < 0) continue;
    const auto& corner = at(other).corner;
    if (!InCircle(point(corner[0]), point(corner[1]), point(corner[2]), point(v))) continue;
    Flip(t, far_edge);
    stack.push_back(t);
    stack.push_back(other);
  }
}

//        c                c
//      / | \            /   \         Turns the edge a-c (opposite corner `edge` of t) into d-b.
//     d  |  b    to    d --- b        Afterwards t is (d, b, c) and the other (b, d, a).
//      \ | /            \   /
//        a                a
void Triangulator::Flip(int t, int edge) {
  const int u = at(t).neighbour[index(edge)];
  const Triangle left = at(t);
  const Triangle right = at(u);
  const size_t i = index(edge), i1 = index(kNext[i]), i2 = index(kPrevious[i]);
  const size_t j = index(EdgeTowards(u, t)), j1 = index(kNext[j]), j2 = index(kPrevious[j]);
  const int d = left.corner[i], a = left.corner[i1], c = left.corner[i2];
  const int b = right.corner[j];
  // left: edge i1 is c-d, edge i2 is d-a. right (corners b, c, a from j): edge j1 is a-b, edge j2 is b-c.
  SetTriangle(t, {d, b, c}, {right.neighbour[j2], left.neighbour[i1], u}, {right.fixed[j2], left.fixed[i1], false});
  SetTriangle(u, {b, d, a}, {left.neighbour[i2], right.neighbour[j1], t}, {left.fixed[i2], right.fixed[j1], false});
  Relink(right.neighbour[j2], u, t);
  Relink(left.neighbour[i2], t, u);
}

void Triangulator::RestoreDelaunay(std::vector<EdgeRef> stack) {
  while (!stack.empty()) {
    const EdgeRef edge = stack.back();
    stack.pop_back();
    const Triangle& triangle = at(edge.triangle);
    const int other = triangle.neighbour[index(edge.edge)];
    if (other < 0 || triangle.fixed[index(edge.edge)]) continue;
    const int apex = triangle.corner[index(edge.edge)];
    const auto& corner = at(other).corner;
    if (!InCircle(point(corner[0]), point(corner[1]), point(corner[2]), point(apex))) continue;
    Flip(edge.triangle, edge.edge);
    for (int t : {edge.triangle, other}) {
      stack.push_back({t, 0});
      stack.push_back({t, 1});
    }
  }
}

// Finds the edge between a and b by turning round one of them; triangle -1 if there is none. Turning ends only round
// points inside the enclosing triangle, and of any two at least one is asked for that is.
EdgeRef Triangulator::FindEdge(int a, int b) const {
  if (index(a) + 3 >= points_.size()) std::swap(a, b);
  const int start = triangle_of_point_[index(a)];
  int t = start;
  do {
    const auto& corner = at(t).corner;
    const size_t k = index(static_cast<int>(std::find(corner.begin(), corner.end(), a) - corner.begin()));
    if (corner[index(kNext[k])] == b) return {t, kPrevious[k]};
    if (corner[index(kPrevious[k])] == b) return {t, kNext[k]};
    t = at(t).neighbour[index(kNext[k])];
  } while (t != start && t >= 0);
  return {};
}

void Triangulator::MarkFixed(EdgeRef edge) {
  at(edge.triangle).fixed[index(edge.edge)] = true;
  const int other = at(edge.triangle).neighbour[index(edge.edge)];
  if (other >= 0) at(other).fixed[index(EdgeTowards(other, edge.triangle))] = true;
}

Status CrossingOutline() {
  return InvalidArgument("CROSSING_OUTLINE", "a panel's outline meets itself; check the points of the photograph");
}

// Lists the edges that the segment from a to b crosses, in order.
Status Triangulator::CollectCrossedEdges(int a, int b, std::vector<std::pair<int, int>>& crossed) const {
  // The triangle at a whose far edge the segment leaves through.
  int t = triangle_of_point_[index(a)];
  const int start = t;
  int left = -1, right = -1;
  for (;;) {
    const auto& corner = at(t).corner;
    const size_t k = index(static_cast<int>(std::find(corner.begin(), corner.end(), a) - corner.begin()));
    right = corner[index(kNext[k])];
    left = corner[index(kPrevious[k])];
    if (Turn(a, b, right) < 0 && Turn(a, b, left) > 0) break;
    t = at(t).neighbour[index(kNext[k])];
    if (t == start || t < 0) return CrossingOutline();
  }
  for (;;) {
    const EdgeRef edge = FindEdge(right, left);
    FR_CHECK(edge.triangle >= 0);
    if (at(edge.triangle).fixed[index(edge.edge)]) return CrossingOutline();
    crossed.emplace_back(right, left);
    // The triangle beyond is the one that is not t.
    const int other = edge.triangle == t ? at(t).neighbour[index(edge.edge)] : edge.triangle;
    FR_CHECK(other >= 0);
    const int apex = at(other).corner[index(EdgeTowards(other, t))];
    t = other;
    if (apex == b) return Status();
    const int64_t side = Turn(a, b, apex);
    if (side == 0) return CrossingOutline();
    (side > 0 ? left : right) = apex;
  }
}

Status Triangulator::RecoverEdge(int a, int b) {
  std::vector<std::pair<int, int>> crossed;
  FR_RETURN_IF_ERROR(CollectCrossedEdges(a, b, crossed));
  // Sloan's loop ends; the bound only turns a mistake into an error.
  size_t budget = 64 + 16 * crossed.size() * crossed.size();
  for (size_t i = 0; i < crossed.size(); ++i) {
    if (budget-- == 0) return CrossingOutline();
    const auto [p, q] = crossed[i];
    const EdgeRef edge = FindEdge(p, q);
    FR_CHECK(edge.triangle >= 0);
    const int other = at(edge.triangle).neighbour[index(edge.edge)];
    const int r = at(edge.triangle).corner[index(edge.edge)];
    const int s = at(other).corner[index(EdgeTowards(other, edge.triangle))];
    // A flip needs a strictly convex quadrilateral: p and q on different sides of r-s.
    const int64_t side_p = Turn(r, s, p), side_q = Turn(r, s, q);
    if ((side_p > 0 && side_q < 0) || (side_p < 0 && side_q > 0)) {
      Flip(edge.triangle, edge.edge);
      if (r == a || r == b || s == a || s == b) continue;
      const int64_t side_r = Turn(a, b, r), side_s = Turn(a, b, s);
      if ((side_r > 0) != (side_s > 0)) crossed.emplace_back(r, s);
    } else {
      crossed.emplace_back(p, q);
    }
  }
  return Status();
}

Status Triangulator::FixPolygon(int polygon_count) {
  bool recovered = false;
  for (int a = 0; a < polygon_count; ++a) {
    const int b = (a + 1) % polygon_count;
    EdgeRef edge = FindEdge(a, b);
    if (edge.triangle < 0) {
      FR_RETURN_IF_ERROR(RecoverEdge(a, b));
      edge = FindEdge(a, b);
      if (edge.triangle < 0) return CrossingOutline();
      recovered = true;
    }
    MarkFixed(edge);
  }
  if (recovered) {
    std::vector<EdgeRef> all;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      for (int k = 0; k < 3; ++k) all.push_back({t, k});
    }
    RestoreDelaunay(std::move(all));
  }
  return Status();
}

// Everything that can be reached from the enclosing triangle without crossing the polygon is outside.
std::vector<Eigen::Vector3i> Triangulator::TrianglesInside() const {
  std::vector<bool> outside(triangles_.size(), false);
  std::vector<int> stack = {triangle_of_point_.back()};
  outside[index(stack.back())] = true;
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    for (size_t k = 0; k < 3; ++k) {
      const int other = at(t).neighbour[k];
      if (other < 0 || at(t).fixed[k] || outside[index(other)]) continue;
      outside[index(other)] = true;
      stack.push_back(other);
    }
  }
  std::vector<Eigen::Vector3i> inside;
  for (size_t t = 0; t < triangles_.size(); ++t) {
    const auto& corner = triangles_[t].corner;
    if (!outside[t]) inside.emplace_back(corner[0], corner[1], corner[2]);
  }
  return inside;
}

}  // namespace

Result<std::vector<Eigen::Vector3i>> TriangulatePolygon(std::span<const Eigen::Vector2d> points, int polygon_count) {
  if (polygon_count < 3 || points.size() < static_cast<size_t>(polygon_count)) {
    return InvalidArgument("TOO_FEW_POINTS", "a panel needs an outline of at least three points");
  }
  Triangulator triangulator;
  FR_RETURN_IF_ERROR(triangulator.AddPoints(points));
  FR_RETURN_IF_ERROR(triangulator.FixPolygon(polygon_count));
  return triangulator.TrianglesInside();
}

}  // namespace fitroom::panels
