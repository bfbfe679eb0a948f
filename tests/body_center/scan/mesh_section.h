#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/triangle_mesh.h"

namespace fitroom::testing {

// Returns what a tape round the trunk would measure at `height`, from the mesh alone: the section's loop that surrounds
// the middle plane, its hull walked by gift wrapping. A second method beside the product's own.
inline double TrunkGirth(const TriangleMesh& mesh, double height) {
  using Edge = std::pair<int, int>;
  std::map<Edge, Eigen::Vector2d> place;
  std::map<Edge, std::vector<Edge>> next;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    std::vector<Edge> cut;
    for (int i = 0; i < 3; ++i) {
      const int a = std::min(t[i], t[(i + 1) % 3]), b = std::max(t[i], t[(i + 1) % 3]);
      const Eigen::Vector3d& p = mesh.vertices[static_cast<size_t>(a)];
      const Eigen::Vector3d& q = mesh.vertices[static_cast<size_t>(b)];
      if ((p.y() < height) == (q.y() < height)) continue;
      const double s = (height - p.y()) / (q.y() - p.y());
      place[{a, b}] = {p.x() + s * (q.x() - p.x()), p.z() + s * (q.z() - p.z())};
      cut.emplace_back(a, b);
    }
    if (cut.size() != 2) continue;
    next[cut[0]].push_back(cut[1]);
    next[cut[1]].push_back(cut[0]);
  }
  // The connected loop with most of its width on both sides of x = 0.
  std::map<Edge, bool> seen;
  std::vector<Eigen::Vector2d> best;
  double best_reach = 0.0;
  for (const auto& [start, unused] : next) {
    if (seen[start]) continue;
    std::vector<Eigen::Vector2d> loop;
    std::vector<Edge> open = {start};
    seen[start] = true;
    while (!open.empty()) {
      const Edge edge = open.back();
      open.pop_back();
      loop.push_back(place[edge]);
      for (const Edge& other : next[edge]) {
        if (!seen[other]) open.push_back(other);
        seen[other] = true;
      }
    }
    double low = 0.0, high = 0.0;
    for (const Eigen::Vector2d& p : loop) {
      low = std::min(low, p.x());
      high = std::max(high, p.x());
    }
    if (std::min(-low, high) > best_reach) {
      best_reach = std::min(-low, high);
      best = loop;
    }
  }
  if (best.size() < 3) return 0.0;
  // Gift wrapping: always the point with all others on its left.
  size_t first = 0;
  for (size_t i = 1; i < best.size(); ++i) {
    if (best[i].x() < best[first].x()) first = i;
  }
  double girth = 0.0;
  size_t at = first;
  for (size_t steps = 0; steps <= best.size(); ++steps) {
    size_t to = at == 0 ? 1 : 0;
    for (size_t i = 0; i < best.size(); ++i) {
      const Eigen::Vector2d a = best[to] - best[at], b = best[i] - best[at];
      const double turn = a.x() * b.y() - a.y() * b.x();
      if (turn < 0.0 || (turn == 0.0 && b.squaredNorm() > a.squaredNorm())) to = i;
    }
    girth += (best[to] - best[at]).norm();
    at = to;
    if (at == first) break;
  }
  return girth;
}

}  // namespace fitroom::testing
