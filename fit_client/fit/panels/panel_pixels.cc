#include "fit_client/fit/panels/panel_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fit_client/fit/panels/photo_warp.h"
#include "fit_client/fit/panels/unfold_texture.h"

namespace fitroom::panels {
namespace {

constexpr double kCoarsestPitch = 0.08;  // (unit: metre)

double Cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

// The map that is linear on each triangle of a mesh and carries its points to their pixels; beyond the mesh's edge, by
// the triangle that is least missed.
class PiecewiseLinearMap {
 public:
  PiecewiseLinearMap(const PanelMesh& mesh, const std::vector<Eigen::Vector2d>& pixels, double cell)
      : mesh_(mesh), pixels_(pixels), cell_(cell) {
    low_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low_;
    for (const Eigen::Vector2d& p : mesh.points) {
      low_ = low_.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    columns_ = Cell(high.x() - low_.x()) + 1;
    rows_ = Cell(high.y() - low_.y()) + 1;
    buckets_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::Vector2d from = Corner(t, 0), to = from;
      for (int k = 1; k < 3; ++k) {
        from = from.cwiseMin(Corner(t, k));
        to = to.cwiseMax(Corner(t, k));
      }
      // One cell more on every side, for points beyond the mesh's edge.
      for (int r = std::max(0, Cell(from.y() - low_.y()) - 1); r <= std::min(rows_ - 1, Cell(to.y() - low_.y()) + 1);
           ++r) {
        for (int c = std::max(0, Cell(from.x() - low_.x()) - 1);
             c <= std::min(columns_ - 1, Cell(to.x() - low_.x()) + 1); ++c) {
          buckets_[Bucket(c, r)].push_back(static_cast<int>(t));
        }
      }
    }
  }

  // Returns nothing for a point far from the mesh.
  std::optional<Eigen::Vector2d> At(const Eigen::Vector2d& point) const {
    const int column = std::clamp(Cell(point.x() - low_.x()), 0, columns_ - 1);
    const int row = std::clamp(Cell(point.y() - low_.y()), 0, rows_ - 1);
    double best_inside = -std::numeric_limits<double>::infinity();
    std::optional<Eigen::Vector2d> best;
    for (const int bucketed : buckets_[Bucket(column, row)]) {
      const size_t t = static_cast<size_t>(bucketed);
      const Eigen::Vector2d a = Corner(t, 0), b = Corner(t, 1), c = Corner(t, 2);
      const double area = Cross(b - a, c - a);
      const Eigen::Vector3d weights(Cross(b - point, c - point) / area, Cross(c - point, a - point) / area,
                                    Cross(a - point, b - point) / area);
      if (weights.minCoeff() <= best_inside) continue;
      best_inside = weights.minCoeff();
      best = weights[0] * Pixel(t, 0) + weights[1] * Pixel(t, 1) + weights[2] * Pixel(t, 2);
      if (best_inside >= 0.0) break;
    }
    return best;
  }

 private:
  int Cell(double offset) const { return static_cast<int>(std::floor(offset / cell_)); }
  size_t Bucket(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  }
  const Eigen::Vector2d& Corner(size_t triangle, int k) const {
    return mesh_.points[static_cast<size_t>(mesh_.triangles[triangle][k])];
  }
  const Eigen::Vector2d& Pixel(size_t triangle, int k) const {
    return pixels_[static_cast<size_t>(mesh_.triangles[triangle][k])];
  }

  const PanelMesh& mesh_;
  const std::vector<Eigen::Vector2d>& pixels_;
  double cell_;
  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> buckets_;
};

// Carries the texture of a coarser mesh of the panel over to the points inside; false where there is none.
bool RefineCoarserPixels(const PanelPattern& panel, const PanelMesh& mesh, size_t outline_count, double pitch,
                         std::vector<Eigen::Vector2d>& pixels) {
  const double coarse_pitch = 2.0 * pitch;
  if (coarse_pitch > kCoarsestPitch) return false;
  const OutlineSamples outline = SampleOutline(panel, MeshSize(coarse_pitch));
  const Result<PanelMesh> coarse = MeshPanel(outline.points, outline.sewn, MeshSize(coarse_pitch));
  if (!coarse.ok()) return false;
  const std::vector<Eigen::Vector2d> coarse_pixels = ComputePanelPixels(panel, outline, *coarse, coarse_pitch);
  const PiecewiseLinearMap map(*coarse, coarse_pixels, 2.0 * coarse_pitch);
  for (size_t v = outline_count; v < pixels.size(); ++v) {
    const std::optional<Eigen::Vector2d> pixel = map.At(mesh.points[v]);
    if (pixel) pixels[v] = *pixel;
  }
  return true;
}

}  // namespace

std::vector<Eigen::Vector2d> ComputePanelPixels(const PanelPattern& panel, const OutlineSamples& outline,
                                                const PanelMesh& mesh, double pitch) {
  const PhotoWarp warp(panel);
  const size_t outline_count = outline.pixels.size();
  std::vector<Eigen::Vector2d> pixels = outline.pixels;
  for (size_t v = outline_count; v < mesh.points.size(); ++v) pixels.push_back(warp.PixelAt(mesh.points[v]));
  const int turned_count = UnfoldTexture(mesh, static_cast<int>(outline_count), pixels);
  if (turned_count == 0) return pixels;
  std::vector<Eigen::Vector2d> refined = pixels;
  if (!RefineCoarserPixels(panel, mesh, outline_count, pitch, refined)) return pixels;
  return UnfoldTexture(mesh, static_cast<int>(outline_count), refined) <= turned_count ? refined : pixels;
}

}  // namespace fitroom::panels
