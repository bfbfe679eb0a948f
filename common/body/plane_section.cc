#include "common/body/plane_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "common/base/check.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

// Where a triangle meets the plane: from one of its edges to another. An edge is known by its two vertices, so that
// neighbouring triangles name the same end.
struct CutSegment {
  std::array<uint64_t, 2> edges;
  std::array<Eigen::Vector2d, 2> points;
};

// A run of segments whose ends may be open.
struct Chain {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

// Bridging compares all pairs of open ends; a mesh torn worse than this is closed run by run instead.
constexpr size_t kMaxOpenEnds = 400;

uint64_t EdgeKey(int a, int b) {
  const auto low = static_cast<uint64_t>(std::min(a, b));
  const auto high = static_cast<uint64_t>(std::max(a, b));
  return low << 32 | high;
}

// Cuts one triangle; false where it does not meet the plane. A vertex on the plane counts as above, so that a triangle
// gives one segment or none.
bool CutTriangle(const TriangleMesh& mesh, const Eigen::Vector3i& triangle, const SectionPlane& plane,
                 const Eigen::Vector3d& normal, CutSegment& segment) {
  std::array<double, 3> distance;
  for (int i = 0; i < 3; ++i) {
    distance[static_cast<size_t>(i)] = normal.dot(mesh.vertices[static_cast<size_t>(triangle[i])] - plane.origin);
  }
  int end = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double di = distance[static_cast<size_t>(i)];
    const double dj = distance[static_cast<size_t>(j)];
    if ((di >= 0.0) == (dj >= 0.0)) continue;
    // The lower vertex number first: both triangles of an edge compute the same point to the last bit.
    const bool swap = triangle[i] > triangle[j];
    const Eigen::Vector3d& a = mesh.vertices[static_cast<size_t>(swap ? triangle[j] : triangle[i])];
    const Eigen::Vector3d& b = mesh.vertices[static_cast<size_t>(swap ? triangle[i] : triangle[j])];
    const double da = swap ? dj : di;
    const double db = swap ? di : dj;
    const Eigen::Vector3d p = a + (da / (da - db)) * (b - a) - plane.origin;
    segment.edges[static_cast<size_t>(end)] = EdgeKey(triangle[i], triangle[j]);
    segment.points[static_cast<size_t>(end)] = Eigen::Vector2d(p.dot(plane.u), p.dot(plane.v));
    ++end;
  }
  return end == 2;
}

// Drops repeated segments: they come from duplicate triangles.
void RemoveDuplicates(std::vector<CutSegment>& segments) {
  for (CutSegment& segment : segments) {
    if (segment.edges[0] > segment.edges[1]) {
      std::swap(segment.edges[0], segment.edges[1]);
      std::swap(segment.points[0], segment.points[1]);
    }
  }
  std::sort(segments.begin(), segments.end(),
            [](const CutSegment& a, const CutSegment& b) { return a.edges < b.edges; });
  segments.erase(std::unique(segments.begin(), segments.end(),
                             [](const CutSegment& a, const CutSegment& b) { return a.edges == b.edges; }),
                 segments.end());
}

// For each segment end (2 * segment + side) the end it continues at, or -1.
std::vector<int> LinkEnds(const std::vector<CutSegment>& segments) {
  std::vector<std::pair<uint64_t, int>> ends;
  ends.reserve(2 * segments.size());
  for (size_t i = 0; i < segments.size(); ++i) {
    ends.emplace_back(segments[i].edges[0], static_cast<int>(2 * i));
    ends.emplace_back(segments[i].edges[1], static_cast<int>(2 * i + 1));
  }
  std::sort(ends.begin(), ends.end());
  std::vector<int> partner(2 * segments.size(), -1);
  for (size_t i = 0; i + 1 < ends.size();) {
    if (ends[i].first == ends[i + 1].first) {
      partner[static_cast<size_t>(ends[i].second)] = ends[i + 1].second;
      partner[static_cast<size_t>(ends[i + 1].second)] = ends[i].second;
      i += 2;
    } else {
      ++i;
    }
  }
  return partner;
}

// Follows the links into chains: first those with an open end, then the closed ones.
std::vector<Chain> JoinChains(const std::vector<CutSegment>& segments, const std::vector<int>& partner) {
  std::vector<Chain> chains;
  std::vector<bool> used(segments.size(), false);
  const auto follow = [&](int from_end) {
    Chain chain;
    int end = from_end;
    while (true) {
      const auto segment = static_cast<size_t>(end / 2);
      if (used[segment]) {
        chain.closed = true;
        break;
      }
      used[segment] = true;
      chain.points.push_back(segments[segment].points[static_cast<size_t>(end % 2)]);
      const int far_end = end ^ 1;
      if (partner[static_cast<size_t>(far_end)] < 0) {
        chain.points.push_back(segments[segment].points[static_cast<size_t>(far_end % 2)]);
        break;
      }
      end = partner[static_cast<size_t>(far_end)];
    }
    chains.push_back(std::move(chain));
  };
  for (size_t end = 0; end < partner.size(); ++end) {
    if (partner[end] < 0 && !used[end / 2]) follow(static_cast<int>(end));
  }
  for (size_t segment = 0; segment < segments.size(); ++segment) {
    if (!used[segment]) follow(static_cast<int>(2 * segment));
  }
  return chains;
}

double OpenLength(const Chain& chain) {
  double length = 0.0;
  for (size_t i = 1; i < chain.points.size(); ++i) length += (chain.points[i] - chain.points[i - 1]).norm();
  return length;
}

// Pairs the open ends, nearest first. Ends are numbered 2 * chain (front) and 2 * chain + 1 (back).
std::vector<int> PairOpenEnds(const std::vector<Chain>& open, double max_bridge) {
  std::vector<int> partner(2 * open.size(), -1);
  if (partner.size() > kMaxOpenEnds) return partner;
  struct Bridge {
    double cost;
    int from, to;
  };
  std::vector<Bridge> bridges;
  const auto point = [&open](size_t end) {
    return end % 2 == 0 ? open[end / 2].points.front() : open[end / 2].points.back();
  };
  std::vector<double> lengths;
  for (const Chain& chain : open) lengths.push_back(OpenLength(chain));
  for (size_t i = 0; i < partner.size(); ++i) {
    for (size_t j = i + 1; j < partner.size(); ++j) {
      double cost = (point(i) - point(j)).norm();
      if (cost > max_bridge) continue;
      // A shred inside a hole would close on itself before it joins the outline it is part of.
      if (i / 2 == j / 2 && lengths[i / 2] < 3.0 * cost) cost *= 4.0;
      bridges.push_back({cost, static_cast<int>(i), static_cast<int>(j)});
    }
  }
  std::sort(bridges.begin(), bridges.end(), [](const Bridge& a, const Bridge& b) {
    return std::tie(a.cost, a.from, a.to) < std::tie(b.cost, b.from, b.to);
  });
  for (const Bridge& bridge : bridges) {
    if (partner[static_cast<size_t>(bridge.from)] >= 0 || partner[static_cast<size_t>(bridge.to)] >= 0) continue;
    partner[static_cast<size_t>(bridge.from)] = bridge.to;
    partner[static_cast<size_t>(bridge.to)] = bridge.from;
  }
  return partner;
}

SectionLoop MakeLoop(std::vector<Eigen::Vector2d> points, double bridge_length) {
  SectionLoop loop;
  loop.points = std::move(points);
  for (const Eigen::Vector2d& p : loop.points) loop.bounds.extend(p);
  const PolygonMoments moments = ComputeMoments(loop.points);
  loop.area = std::abs(moments.signed_area);
  loop.centroid = moments.centroid;
  loop.bridge_length = bridge_length;
  return loop;
}

// Joins open chains over their bridges; what finds no partner is closed by a straight line.
void CloseOpenChains(const std::vector<Chain>& open, double max_bridge, std::vector<SectionLoop>& loops) {
  const std::vector<int> partner = PairOpenEnds(open, max_bridge);
  std::vector<bool> used(open.size(), false);
  const auto run_from = [&](size_t start_end) {
    std::vector<Eigen::Vector2d> points;
    double bridge_length = 0.0;
    int end = static_cast<int>(start_end);
    while (end >= 0 && !used[static_cast<size_t>(end / 2)]) {
      const Chain& chain = open[static_cast<size_t>(end / 2)];
      used[static_cast<size_t>(end / 2)] = true;
      const Eigen::Vector2d first = end % 2 == 0 ? chain.points.front() : chain.points.back();
      if (!points.empty()) bridge_length += (first - points.back()).norm();
      if (end % 2 == 0) {
        points.insert(points.end(), chain.points.begin(), chain.points.end());
      } else {
        points.insert(points.end(), chain.points.rbegin(), chain.points.rend());
      }
      end = partner[static_cast<size_t>(end ^ 1)];
    }
    bridge_length += (points.front() - points.back()).norm();
    loops.push_back(MakeLoop(std::move(points), bridge_length));
  };
  for (size_t end = 0; end < partner.size(); ++end) {
    if (partner[end] < 0 && !used[end / 2]) run_from(end);
  }
  for (size_t chain = 0; chain < open.size(); ++chain) {
    if (!used[chain]) run_from(2 * chain);
  }
}

}  // namespace

std::vector<SectionLoop> CutByPlane(const TriangleMesh& mesh, std::span<const int> triangles, const SectionPlane& plane,
                                    const SectionOptions& options) {
  const Eigen::Vector3d normal = plane.u.cross(plane.v);
  std::vector<CutSegment> segments;
  CutSegment segment;
  for (const int triangle : triangles) {
    if (CutTriangle(mesh, mesh.triangles[static_cast<size_t>(triangle)], plane, normal, segment)) {
      segments.push_back(segment);
    }
  }
  RemoveDuplicates(segments);
  std::vector<SectionLoop> loops;
  std::vector<Chain> open;
  for (Chain& chain : JoinChains(segments, LinkEnds(segments))) {
    if (chain.closed) {
      loops.push_back(MakeLoop(std::move(chain.points), 0.0));
    } else {
      open.push_back(std::move(chain));
    }
  }
  CloseOpenChains(open, options.max_bridge, loops);
  std::erase_if(loops, [&options](const SectionLoop& loop) { return !(loop.area >= options.min_area); });
  std::stable_sort(loops.begin(), loops.end(),
                   [](const SectionLoop& a, const SectionLoop& b) { return a.area > b.area; });
  return loops;
}

HeightIndex::HeightIndex(const TriangleMesh& mesh, int slab_count) : mesh_(mesh) {
  FR_CHECK(slab_count > 0);
  const Eigen::AlignedBox3d bounds = ComputeBounds(mesh);
  min_height_ = mesh.vertices.empty() ? 0.0 : bounds.min().y();
  max_height_ = mesh.vertices.empty() ? 0.0 : bounds.max().y();
  const double height = max_height_ - min_height_;
  // Triangles as tall as the mesh would be listed in every slab: fewer slabs bound the memory of such a mesh.
  const int64_t budget = 8 * static_cast<int64_t>(mesh.triangles.size()) + 4096;
  while (true) {
    slabs_per_unit_ = height > 0.0 ? slab_count / height : 0.0;
    slab_begin_.assign(static_cast<size_t>(slab_count) + 1, 0);
    int64_t entry_count = 0;
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      const auto [low, high] = SlabsOf(triangle);
      entry_count += high - low + 1;
    }
    if (entry_count <= budget || slab_count == 1) break;
    slab_count = std::max(1, slab_count / 2);
  }
  // A counting sort: count, sum up, fill.
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const auto [low, high] = SlabsOf(triangle);
    for (int slab = low; slab <= high; ++slab) ++slab_begin_[static_cast<size_t>(slab) + 1];
  }
  for (size_t slab = 1; slab < slab_begin_.size(); ++slab) slab_begin_[slab] += slab_begin_[slab - 1];
  triangles_.resize(static_cast<size_t>(slab_begin_.back()));
  std::vector<int> next(slab_begin_.begin(), slab_begin_.end() - 1);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [low, high] = SlabsOf(mesh.triangles[i]);
    for (int slab = low; slab <= high; ++slab) {
      triangles_[static_cast<size_t>(next[static_cast<size_t>(slab)]++)] = static_cast<int>(i);
    }
  }
}

std::pair<int, int> HeightIndex::SlabsOf(const Eigen::Vector3i& triangle) const {
  const double a = mesh_.vertices[static_cast<size_t>(triangle[0])].y();
  const double b = mesh_.vertices[static_cast<size_t>(triangle[1])].y();
  const double c = mesh_.vertices[static_cast<size_t>(triangle[2])].y();
  return {SlabOf(std::min({a, b, c})), SlabOf(std::max({a, b, c}))};
}

int HeightIndex::SlabOf(double height) const {
  const int last = static_cast<int>(slab_begin_.size()) - 2;
  return std::clamp(static_cast<int>((height - min_height_) * slabs_per_unit_), 0, last);
}

std::vector<SectionLoop> HeightIndex::CutAt(double height, const SectionOptions& options) const {
  const auto slab = static_cast<size_t>(SlabOf(height));
  const std::span<const int> candidates(triangles_.data() + slab_begin_[slab],
                                        static_cast<size_t>(slab_begin_[slab + 1] - slab_begin_[slab]));
  SectionPlane plane;
  plane.origin.y() = height;
  return CutByPlane(mesh_, candidates, plane, options);
}

std::vector<int> HeightIndex::TrianglesBetween(double low, double high) const {
  const auto first = static_cast<size_t>(SlabOf(low));
  const auto last = static_cast<size_t>(SlabOf(high));
  std::vector<int> found(triangles_.begin() + slab_begin_[first], triangles_.begin() + slab_begin_[last + 1]);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace fitroom
