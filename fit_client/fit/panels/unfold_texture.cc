#include "fit_client/fit/panels/unfold_texture.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/LU>

namespace fitroom::panels {
namespace {

// Smallest area of an image that is left as it is, as a share of what the panel's mean scale gives.
constexpr double kSqueezed = 0.1;
// The patch round a bad triangle grows by a ring of triangles after this many sweeps.
constexpr int kSweepsPerRing = 4;
constexpr int kMaxRings = 8;
constexpr size_t kMaxTrianglesOfPoint = 12;  // For the search over triples; no Delaunay mesh of ours has more.

double TwiceArea(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector3i& t) {
  const Eigen::Vector2d& a = points[static_cast<size_t>(t[0])];
  const Eigen::Vector2d u = points[static_cast<size_t>(t[1])] - a;
  const Eigen::Vector2d v = points[static_cast<size_t>(t[2])] - a;
  return u.x() * v.y() - u.y() * v.x();
}

// The share of its due area that a triangle's image has, as a function of one corner's place x: gradient · x + offset.
struct LinearShare {
  Eigen::Vector2d gradient;
  double offset = 0.0;
  double At(const Eigen::Vector2d& x) const { return gradient.dot(x) + offset; }
};

double WorstShare(const std::vector<LinearShare>& shares, const Eigen::Vector2d& x) {
  double worst = shares.front().At(x);
  for (const LinearShare& share : shares) worst = std::min(worst, share.At(x));
  return worst;
}

// Returns where the smallest of the linear functions is largest: a corner of the upper bound, on which three of them
// agree; or `start`, if that is as good.
Eigen::Vector2d BestPlace(const std::vector<LinearShare>& shares, const Eigen::Vector2d& start) {
  Eigen::Vector2d best = start;
  double best_share = WorstShare(shares, start);
  for (size_t i = 0; i < shares.size(); ++i) {
    for (size_t j = i + 1; j < shares.size(); ++j) {
      for (size_t k = j + 1; k < shares.size(); ++k) {
        Eigen::Matrix2d difference;
        difference.row(0) = (shares[i].gradient - shares[j].gradient).transpose();
        difference.row(1) = (shares[i].gradient - shares[k].gradient).transpose();
        const Eigen::Vector2d offsets(shares[j].offset - shares[i].offset, shares[k].offset - shares[i].offset);
        const Eigen::Vector2d place = difference.inverse() * offsets;
        if (!place.allFinite()) continue;
        const double share = WorstShare(shares, place);
        if (share > best_share) {
          best_share = share;
          best = place;
        }
      }
    }
  }
  return best;
}

class Unfolding {
 public:
  Unfolding(const PanelMesh& mesh, int outline_count, std::vector<Eigen::Vector2d>& pixels)
      : mesh_(mesh), outline_count_(static_cast<size_t>(outline_count)), pixels_(pixels) {
    double image_area = 0.0, panel_area = 0.0;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      image_area += TwiceArea(pixels, t);
      panel_area += TwiceArea(mesh.points, t);
    }
    scale_ = image_area / panel_area;  // Negative where the photograph mirrors the panel.
  }

  // Marks the corners of bad triangles and of `rings` - 1 rings round them; returns how many are turned over, or -1 if
  // none is bad.
  int MarkBad(int rings) {
    marked_.assign(mesh_.points.size(), false);
    int turned_count = 0;
    bool any = false;
    for (const Eigen::Vector3i& t : mesh_.triangles) {
      const double share = TwiceArea(pixels_, t) / (scale_ * TwiceArea(mesh_.points, t));
      if (share >= kSqueezed) continue;
      any = true;
      if (share <= 0.0) ++turned_count;
      Mark(t);
    }
    for (int ring = 1; any && ring < rings; ++ring) {
      const std::vector<bool> before = marked_;
      for (const Eigen::Vector3i& t : mesh_.triangles) {
        for (int k = 0; k < 3; ++k) {
          if (before[static_cast<size_t>(t[k])]) Mark(t);
        }
      }
    }
    return any ? turned_count : -1;
  }

  // Moves every marked point inside once.
  void Sweep() {
    std::vector<std::vector<int>> triangles_of(mesh_.points.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const size_t v = static_cast<size_t>(mesh_.triangles[t][k]);
        if (marked_[v] && v >= outline_count_) triangles_of[v].push_back(static_cast<int>(t));
      }
    }
    for (size_t v = outline_count_; v < mesh_.points.size(); ++v) {
      if (triangles_of[v].size() < 3 || triangles_of[v].size() > kMaxTrianglesOfPoint) continue;
      std::vector<LinearShare> shares;
      for (int t : triangles_of[v]) shares.push_back(ShareOf(mesh_.triangles[static_cast<size_t>(t)], v));
      pixels_[v] = BestPlace(shares, pixels_[v]);
    }
  }

 private:
  void Mark(const Eigen::Vector3i& t) {
    for (int k = 0; k < 3; ++k) marked_[static_cast<size_t>(t[k])] = true;
  }

  // Twice the area of x, p, q is (p - x) x (q - x) = cross(q - p, x) + cross(p, q).
  LinearShare ShareOf(const Eigen::Vector3i& t, size_t v) const {
    int corner = 0;
    while (t[corner] != static_cast<int>(v)) ++corner;
    const Eigen::Vector2d& p = pixels_[static_cast<size_t>(t[(corner + 1) % 3])];
    const Eigen::Vector2d& q = pixels_[static_cast<size_t>(t[(corner + 2) % 3])];
    const double due = scale_ * TwiceArea(mesh_.points, t);
    return {Eigen::Vector2d(p.y() - q.y(), q.x() - p.x()) / due, (p.x() * q.y() - p.y() * q.x()) / due};
  }

  const PanelMesh& mesh_;
  size_t outline_count_;
  std::vector<Eigen::Vector2d>& pixels_;
  double scale_ = 1.0;
  std::vector<bool> marked_;
};

}  // namespace

int UnfoldTexture(const PanelMesh& mesh, int outline_count, std::vector<Eigen::Vector2d>& pixels) {
  Unfolding unfolding(mesh, outline_count, pixels);
  int turned_count = 0;
  for (int sweep = 0; sweep < kMaxRings * kSweepsPerRing; ++sweep) {
    turned_count = unfolding.MarkBad(1 + sweep / kSweepsPerRing);
    if (turned_count < 0) return 0;
    unfolding.Sweep();
  }
  return turned_count;
}

}  // namespace fitroom::panels
