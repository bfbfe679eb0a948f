#include "fit_client/fit/panels/triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fit_client/fit/panels/exact_predicates.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Triangles = std::vector<Eigen::Vector3i>;

double AreaOf(const Points& points, const Eigen::Vector3i& t) {
  const Eigen::Vector2d& a = points[static_cast<size_t>(t[0])];
  const Eigen::Vector2d u = points[static_cast<size_t>(t[1])] - a, v = points[static_cast<size_t>(t[2])] - a;
  return 0.5 * (u.x() * v.y() - u.y() * v.x());
}

std::map<std::pair<int, int>, std::vector<int>> TrianglesOfEdges(const Triangles& triangles) {
  std::map<std::pair<int, int>, std::vector<int>> edges;
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      edges[std::minmax(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(static_cast<int>(t));
    }
  }
  return edges;
}

// The laws of any triangulation of a polygon's inside: positive areas that sum up to the polygon's, every side an edge
// of one triangle, every other edge of two, Euler's formula for a disc, every point used.
void ExpectFillsPolygon(const Points& points, int polygon_count, const Triangles& triangles) {
  double area = 0.0;
  for (const Eigen::Vector3i& t : triangles) {
    EXPECT_GT(AreaOf(points, t), 0.0);
    area += AreaOf(points, t);
  }
  EXPECT_NEAR(area, SignedArea({points.data(), static_cast<size_t>(polygon_count)}), 1e-12);
  const auto edges = TrianglesOfEdges(triangles);
  for (const auto& [edge, owners] : edges) {
    const int step = edge.second - edge.first;
    const bool is_side = edge.second < polygon_count && (step == 1 || step == polygon_count - 1);
    EXPECT_EQ(owners.size(), is_side ? 1u : 2u) << edge.first << "-" << edge.second;
  }
  for (int i = 0; i < polygon_count; ++i) {
    EXPECT_TRUE(edges.contains(std::minmax(i, (i + 1) % polygon_count))) << "side " << i << " is lost";
  }
  EXPECT_EQ(static_cast<int>(points.size()) - static_cast<int>(edges.size()) + static_cast<int>(triangles.size()), 1);
}

// Brute force: no point that can be seen from inside a triangle across no side of the polygon lies in its circle.
void ExpectEmptyCircles(const Points& points, int polygon_count, const Triangles& triangles) {
  for (const Eigen::Vector3i& t : triangles) {
    const Eigen::Vector2d &a = points[static_cast<size_t>(t[0])], &b = points[static_cast<size_t>(t[1])],
                          &c = points[static_cast<size_t>(t[2])];
    const Eigen::Vector2d u = b - a, v = c - a;
    const double twice = 2.0 * (u.x() * v.y() - u.y() * v.x());
    const Eigen::Vector2d centre = a + Eigen::Vector2d(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                                                       u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
                                           twice;
    const double radius = (a - centre).norm();
    const Eigen::Vector2d middle = (a + b + c) / 3.0;
    for (size_t p = 0; p < points.size(); ++p) {
      const int index = static_cast<int>(p);
      if (index == t[0] || index == t[1] || index == t[2]) continue;
      if ((points[p] - centre).norm() >= radius * (1.0 - 1e-6)) continue;
      bool hidden = false;
      for (int i = 0; i < polygon_count && !hidden; ++i) {
        const int j = (i + 1) % polygon_count;
        if (i == index || j == index) continue;
        const Eigen::Vector2d &s = points[static_cast<size_t>(i)], &e = points[static_cast<size_t>(j)];
        const auto turn = [](const Eigen::Vector2d& o, const Eigen::Vector2d& q, const Eigen::Vector2d& r) {
          return (q.x() - o.x()) * (r.y() - o.y()) - (q.y() - o.y()) * (r.x() - o.x());
        };
        hidden = turn(middle, points[p], s) * turn(middle, points[p], e) < 0 &&
                 turn(s, e, middle) * turn(s, e, points[p]) < 0;
      }
      EXPECT_TRUE(hidden) << "point " << p << " lies in the circle of " << t.transpose();
    }
  }
}

Points Star(int count, double inner) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    const double radius = i % 2 == 0 ? 0.5 : inner;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

TEST(TriangulatePolygon, IsDelaunayInAConvexPolygon) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  Points points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 200; ++i) points.emplace_back(uniform(random), uniform(random));
  const Result<Triangles> triangles = TriangulatePolygon(points, 4);
  ASSERT_TRUE(triangles.ok());
  ExpectFillsPolygon(points, 4, *triangles);
  ExpectEmptyCircles(points, 4, *triangles);
}

TEST(TriangulatePolygon, KeepsEverySideOfASpikyPolygon) {
  for (double inner : {0.4, 0.2, 0.05, 0.01}) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    Points points = Star(22, inner);
    const Points polygon = points;
    while (points.size() < 120) {
      const Eigen::Vector2d candidate(uniform(random), uniform(random));
      if (PolygonContains(polygon, candidate)) points.push_back(candidate);
    }
    const Result<Triangles> triangles = TriangulatePolygon(points, 22);
    ASSERT_TRUE(triangles.ok()) << triangles.status().ToString();
    ExpectFillsPolygon(points, 22, *triangles);
    ExpectEmptyCircles(points, 22, *triangles);
  }
}

TEST(TriangulatePolygon, RecoversSidesThatCrossManyTriangles) {
  // A comb: two long, thin teeth whose sides no Delaunay triangulation of the points alone contains.
  const Points points = {{0, 0},     {1, 0},    {1, 0.02},   {0.02, 0.021}, {0.02, 0.03}, {1, 0.031},
                         {1, 0.051}, {0, 0.05}, {0.5, 0.01}, {0.25, 0.041}, {0.75, 0.04}};
  const Result<Triangles> triangles = TriangulatePolygon(points, 8);
  ASSERT_TRUE(triangles.ok()) << triangles.status().ToString();
  ExpectFillsPolygon(points, 8, *triangles);
  ExpectEmptyCircles(points, 8, *triangles);
}

TEST(TriangulatePolygon, CopesWithPointsOnOneCircleAndOnOneLine) {
  Points points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 1; i < 16; ++i) {
    for (int j = 1; j < 16; ++j) points.emplace_back(i / 16.0, j / 16.0);
  }
  const Result<Triangles> triangles = TriangulatePolygon(points, 4);
  ASSERT_TRUE(triangles.ok());
  ExpectFillsPolygon(points, 4, *triangles);
  EXPECT_EQ(triangles->size(), 2u * points.size() - 2u - 4u);
}

TEST(TriangulatePolygon, RefusesWhatIsNoPanel) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto reason = [](const Points& points, int count) {
    return TriangulatePolygon(points, count).status().reason();
  };
  EXPECT_EQ(reason({{0, 0}, {1, 0}}, 2), "TOO_FEW_POINTS");
  EXPECT_EQ(reason({{0, 0}, {1, 0}, {0, 1}}, 4), "TOO_FEW_POINTS");
  EXPECT_EQ(reason({{0, 0}, {1, 0}, {nan, 1}}, 3), "POINT_OUT_OF_RANGE");
  EXPECT_EQ(reason({{0, 0}, {1, 0}, {0, 1e30}}, 3), "POINT_OUT_OF_RANGE");
  EXPECT_EQ(reason({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}}, 4), "DUPLICATE_POINT");
  EXPECT_EQ(reason({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 4), "CROSSING_OUTLINE");
  EXPECT_EQ(reason({{0, 0}, {1, 0}, {0, 1}, {0.5, 0}}, 3), "CROSSING_OUTLINE");
}

TEST(InCircle, IsExactOnCirclesOfWholeNumbers) {
  // Twelve points of whole coordinates on the circle of radius 65, scaled up to the edge of the range.
  const int64_t scale = int64_t{1} << 19;
  const int64_t xs[] = {65, 63, 60, 56, 52, 39, 33, 25, 16, 0, -16, -65};
  const int64_t ys[] = {0, 16, 25, 33, 39, 52, 56, 60, 63, 65, 63, 0};
  std::vector<GridPoint> circle;
  for (size_t i = 0; i < std::size(xs); ++i) circle.push_back({xs[i] * scale, ys[i] * scale});
  for (size_t i = 0; i + 3 < circle.size(); ++i) {
    const GridPoint &a = circle[i], &b = circle[i + 1], &c = circle[i + 2], d = circle[i + 3];
    EXPECT_FALSE(InCircle(a, b, c, d));
    const int64_t out_x = (d.x > 0) - (d.x < 0), out_y = (d.y > 0) - (d.y < 0);
    EXPECT_TRUE(InCircle(a, b, c, {d.x - out_x, d.y - out_y})) << i;
    EXPECT_FALSE(InCircle(a, b, c, {d.x + out_x, d.y + out_y})) << i;
  }
}

TEST(Orientation, IsExactOneStepOffALine) {
  const GridPoint a{-kGridLimit, -kGridLimit}, b{kGridLimit, kGridLimit};
  EXPECT_EQ(Orientation(a, b, {12345678, 12345678}), 0);
  EXPECT_GT(Orientation(a, b, {12345678, 12345679}), 0);
  EXPECT_LT(Orientation(a, b, {12345679, 12345678}), 0);
}

}  // namespace
}  // namespace fitroom::panels
