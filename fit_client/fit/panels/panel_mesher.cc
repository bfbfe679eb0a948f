#include "fit_client/fit/panels/panel_mesher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/check.h"
#include "fit_client/fit/panels/exact_predicates.h"
#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/triangulation.h"

namespace fitroom::panels {
namespace {

// A lattice point nearer to the outline than this is left out (unit: pitch). Tuned on the drawn shirt and seven real
// ones: below 0.55 short edges remain, above 0.75 the gap at the outline gets edges longer than 1.6 pitches.
constexpr double kOutlineClearance = 0.70;
// An inner edge longer than this is split once (unit: pitch).
constexpr double kLongEdge = 1.38;
// Points further than this from the outline are not moved (unit: pitch).
constexpr double kSmoothingDepth = 3.5;
constexpr int kSmoothingRounds = 3;
// Triangles with an angle of less than 30 degrees are mended: its cosine.
constexpr double kSharpCosine = 0.5 * std::numbers::sqrt3;
constexpr int kSweepsPerRound = 4;

// Answers how far points lie from the outline, by buckets of outline segments. Distances are exact up to `reach`.
class OutlineDistance {
 public:
  OutlineDistance(std::span<const Eigen::Vector2d> outline, double reach) : outline_(outline), cell_(reach) {
    low_ = high_ = outline[0];
    for (const Eigen::Vector2d& p : outline) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    columns_ = Column(high_.x()) + 1;
    rows_ = Row(high_.y()) + 1;
    buckets_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
    for (size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
      // In every cell within reach of the segment's box.
      for (int r = std::max(0, Row(std::min(a.y(), b.y())) - 1);
           r <= std::min(rows_ - 1, Row(std::max(a.y(), b.y())) + 1); ++r) {
        for (int c = std::max(0, Column(std::min(a.x(), b.x())) - 1);
             c <= std::min(columns_ - 1, Column(std::max(a.x(), b.x())) + 1); ++c) {
          buckets_[Bucket(c, r)].push_back(static_cast<int>(i));
        }
      }
    }
  }

  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }

  // Returns the distance to the outline, or `reach` if it is larger. The point lies in the outline's box.
  double At(const Eigen::Vector2d& point) const {
    double distance = cell_;
    for (int i : buckets_[Bucket(Column(point.x()), Row(point.y()))]) {
      const size_t a = static_cast<size_t>(i);
      distance = std::min(distance, DistanceToSegment(point, outline_[a], outline_[(a + 1) % outline_.size()]));
    }
    return distance;
  }

 private:
  int Column(double x) const { return static_cast<int>((x - low_.x()) / cell_); }
  int Row(double y) const { return static_cast<int>((y - low_.y()) / cell_); }
  size_t Bucket(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  }

  std::span<const Eigen::Vector2d> outline_;
  double cell_;
  Eigen::Vector2d low_, high_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> buckets_;
};

// Where a horizontal line crosses the outline, ascending.
std::vector<double> Crossings(std::span<const Eigen::Vector2d> outline, double y) {
  std::vector<double> crossings;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > y) != (b.y() > y)) crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

// The lattice points of a level inside the outline and clear of it, row by row upwards, each row from right to left of
// the wearer. Every point of a level's lattice is one of the next finer level's as well: the coarsest has its first row
// unshifted, so that the finer ones have every second.
void AddLattice(std::span<const Eigen::Vector2d> outline, const OutlineDistance& distance, const MeshSize& size,
                int level, std::vector<Eigen::Vector2d>& points) {
  const double pitch = size.PitchOf(level);
  const double row_height = 0.5 * std::numbers::sqrt3 * pitch;
  int row = level == 0 ? 0 : 1;
  for (double y = distance.low().y() + row_height; y < distance.high().y(); y += row_height, ++row) {
    const double shift = row % 2 == 0 ? 0.0 : 0.5;
    const std::vector<double> crossings = Crossings(outline, y);
    for (size_t k = 0; k + 1 < crossings.size(); k += 2) {
      for (double n = std::ceil(crossings[k] / pitch - shift); (n + shift) * pitch < crossings[k + 1]; ++n) {
        const Eigen::Vector2d point((n + shift) * pitch, y);
        if (size.LevelAt(point) == level && distance.At(point) >= kOutlineClearance * pitch) points.push_back(point);
      }
    }
  }
}

bool IsPositive(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c, double least) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > least;
}

// Puts a point into the middle of each edge that is too long and not between two outline points; middles that crowd
// the outline or each other are left out.
void SplitLongEdges(const OutlineDistance& distance, int outline_count, const MeshSize& size, PanelMesh& mesh) {
  std::vector<Eigen::Vector2d> middles;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (a > b || b < outline_count) continue;  // Each inner edge is seen from both sides; one is enough.
      const Eigen::Vector2d& p = mesh.points[static_cast<size_t>(a)];
      const Eigen::Vector2d& q = mesh.points[static_cast<size_t>(b)];
      const Eigen::Vector2d middle = 0.5 * (p + q);
      const double pitch = std::max({size.At(p), size.At(q), size.At(middle)});
      if ((p - q).norm() < kLongEdge * pitch) continue;
      const bool crowded = distance.At(middle) < 0.5 * pitch ||
                           std::any_of(middles.begin(), middles.end(),
                                       [&](const auto& other) { return (other - middle).norm() < 0.75 * pitch; });
      if (!crowded) middles.push_back(middle);
    }
  }
  mesh.points.insert(mesh.points.end(), middles.begin(), middles.end());
}

// Puts a point into the middle of each inner edge that joins two sewn samples of the outline, as across a narrow
// sleeve. Returns whether there was any.
bool SplitSewnBridges(const std::vector<bool>& sewn, PanelMesh& mesh) {
  const int outline_count = static_cast<int>(sewn.size());
  const size_t count_before = mesh.points.size();
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (a > b || b >= outline_count) continue;  // Each inner edge is seen from both sides; one is enough.
      const bool on_outline = b == a + 1 || (a == 0 && b == outline_count - 1);
      if (on_outline || !sewn[static_cast<size_t>(a)] || !sewn[static_cast<size_t>(b)]) continue;
      mesh.points.push_back(0.5 * (mesh.points[static_cast<size_t>(a)] + mesh.points[static_cast<size_t>(b)]));
    }
  }
  return mesh.points.size() > count_before;
}

// Moves the points near the outline towards the middle of their neighbours. A move that would turn a triangle over is
// not made.
void SmoothNearOutline(int outline_count, const OutlineDistance& distance, const MeshSize& size, PanelMesh& mesh) {
  const size_t count = mesh.points.size();
  std::vector<bool> may_move(count, false);
  for (size_t v = static_cast<size_t>(outline_count); v < count; ++v) {
    may_move[v] = distance.At(mesh.points[v]) < kSmoothingDepth * size.At(mesh.points[v]);
  }
  std::vector<std::vector<int>> triangles_of(count);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const size_t v = static_cast<size_t>(mesh.triangles[t][k]);
      if (may_move[v]) triangles_of[v].push_back(static_cast<int>(t));
    }
  }
  const double finest = size.PitchOf(size.level_count());
  const double least_area = 1e-3 * finest * finest;
  const auto point = [&](int v) -> const Eigen::Vector2d& { return mesh.points[static_cast<size_t>(v)]; };
  for (int sweep = 0; sweep < kSweepsPerRound; ++sweep) {
    for (size_t v = static_cast<size_t>(outline_count); v < count; ++v) {
      if (!may_move[v]) continue;
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (int t : triangles_of[v]) {
        const Eigen::Vector3i& triangle = mesh.triangles[static_cast<size_t>(t)];
        for (int k = 0; k < 3; ++k) {
          if (triangle[k] != static_cast<int>(v)) sum += point(triangle[k]);
        }
      }
      const Eigen::Vector2d before = mesh.points[v];
      mesh.points[v] = sum / (2.0 * static_cast<double>(triangles_of[v].size()));
      for (int t : triangles_of[v]) {
        const Eigen::Vector3i& triangle = mesh.triangles[static_cast<size_t>(t)];
        if (!IsPositive(point(triangle[0]), point(triangle[1]), point(triangle[2]), least_area)) {
          mesh.points[v] = before;
          break;
        }
      }
    }
  }
}

// The cosine of a triangle's smallest angle, which falls as the angle grows; 2 for one that is turned over or flat.
double SharpestCosine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  if (!IsPositive(a, b, c, 0.0)) return 2.0;
  const Eigen::Vector2d ab = b - a, bc = c - b, ca = a - c;
  const double ab_length = ab.norm(), bc_length = bc.norm(), ca_length = ca.norm();
  return std::max({-ab.dot(ca) / (ab_length * ca_length), -bc.dot(ab) / (bc_length * ab_length),
                   -ca.dot(bc) / (ca_length * bc_length)});
}

double SharpestCosine(const PanelMesh& mesh, const Eigen::Vector3i& corner) {
  return SharpestCosine(mesh.points[static_cast<size_t>(corner[0])], mesh.points[static_cast<size_t>(corner[1])],
                        mesh.points[static_cast<size_t>(corner[2])]);
}

// The corners of triangles that are too sharp, and of the triangles round these.
std::vector<bool> NearSharpAngles(const PanelMesh& mesh) {
  std::vector<bool> sharp(mesh.points.size(), false);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (SharpestCosine(mesh, t) < kSharpCosine) continue;
    for (const int v : t) sharp[static_cast<size_t>(v)] = true;
  }
  std::vector<bool> near = sharp;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (!sharp[static_cast<size_t>(t[0])] && !sharp[static_cast<size_t>(t[1])] && !sharp[static_cast<size_t>(t[2])]) {
      continue;
    }
    for (const int v : t) near[static_cast<size_t>(v)] = true;
  }
  return near;
}

// Moves inner points of triangles that are too sharp to where the sharpest angle round the point is widest, looking in
// eight directions with ever shorter steps. What averaging leaves between a curved outline and the lattice is mended
// so.
void OpenSharpAngles(int outline_count, const MeshSize& size, PanelMesh& mesh) {
  for (double share = 0.16; share > 0.01; share *= 0.5) {
    const std::vector<bool> may_move = NearSharpAngles(mesh);
    std::vector<std::vector<int>> triangles_of(mesh.points.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const int v : mesh.triangles[t]) {
        if (may_move[static_cast<size_t>(v)]) triangles_of[static_cast<size_t>(v)].push_back(static_cast<int>(t));
      }
    }
    const auto sharpest_round = [&](size_t v) {
      double sharpest = -1.0;
      for (const int t : triangles_of[v]) {
        sharpest = std::max(sharpest, SharpestCosine(mesh, mesh.triangles[static_cast<size_t>(t)]));
      }
      return sharpest;
    };
    for (size_t v = static_cast<size_t>(outline_count); v < mesh.points.size(); ++v) {
      if (!may_move[v]) continue;
      double best = sharpest_round(v);
      if (best < kSharpCosine) continue;
      const Eigen::Vector2d from = mesh.points[v];
      const double step = share * size.At(from);
      Eigen::Vector2d to = from;
      for (int direction = 0; direction < 8; ++direction) {
        const double heading = direction * std::numbers::pi / 4.0;
        mesh.points[v] = from + step * Eigen::Vector2d(std::cos(heading), std::sin(heading));
        const double sharpest = sharpest_round(v);
        if (sharpest >= best) continue;
        best = sharpest;
        to = mesh.points[v];
      }
      mesh.points[v] = to;
    }
  }
}

}  // namespace

Result<PanelMesh> MeshPanel(std::span<const Eigen::Vector2d> outline, const std::vector<bool>& sewn,
                            const MeshSize& size) {
  FR_CHECK(sewn.size() == outline.size());
  PanelMesh mesh;
  mesh.points.assign(outline.begin(), outline.end());
  for (const Eigen::Vector2d& p : outline) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() * kGridStepsPerMetre > static_cast<double>(kGridInputLimit)) {
      return InvalidArgument("POINT_OUT_OF_RANGE", "a panel's outline is not finite or further out than 4 m");
    }
  }
  if (outline.size() < 3) return InvalidArgument("TOO_FEW_POINTS", "a panel's outline needs three points");
  const OutlineDistance distance(outline, kSmoothingDepth * size.pitch());
  for (int level = 0; level <= size.level_count(); ++level) AddLattice(outline, distance, size, level, mesh.points);

  const int outline_count = static_cast<int>(outline.size());
  for (int round = 0;; ++round) {
    FR_ASSIGN_OR_RETURN(mesh.triangles, TriangulatePolygon(mesh.points, outline_count));
    if (round == kSmoothingRounds) {
      OpenSharpAngles(outline_count, size, mesh);
      FR_ASSIGN_OR_RETURN(mesh.triangles, TriangulatePolygon(mesh.points, outline_count));
      break;
    }
    if (SplitSewnBridges(sewn, mesh)) {
      FR_ASSIGN_OR_RETURN(mesh.triangles, TriangulatePolygon(mesh.points, outline_count));
    }
    if (round == 1) {
      SplitLongEdges(distance, outline_count, size, mesh);
      FR_ASSIGN_OR_RETURN(mesh.triangles, TriangulatePolygon(mesh.points, outline_count));
    }
    SmoothNearOutline(outline_count, distance, size, mesh);
  }
  return mesh;
}

}  // namespace fitroom::panels
