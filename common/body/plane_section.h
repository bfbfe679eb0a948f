#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/triangle_mesh.h"

namespace fitroom {

// A plane with its own coordinates: a point p has (s, t) = ((p - origin)·u, (p - origin)·v). u and v are unit and
// perpendicular.
struct SectionPlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitZ();

  Eigen::Vector3d ToSpace(const Eigen::Vector2d& p) const { return origin + p.x() * u + p.y() * v; }
};

// One closed outline of a section. Where the mesh has a hole the outline was closed by straight bridges.
struct SectionLoop {
  std::vector<Eigen::Vector2d> points;  // In the plane's coordinates; the last joins the first.
  Eigen::AlignedBox2d bounds;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double area = 0.0;           // Never negative (unit: square of the mesh's).
  double bridge_length = 0.0;  // Of all straight bridges together; 0 where the mesh is closed.
};

struct SectionOptions {
  double min_area = 0.0;      // Smaller outlines are dropped (unit: square of the mesh's).
  double max_bridge = 1e300;  // Ends farther apart belong to different outlines (unit: the mesh's).
};

// Cuts the listed triangles by a plane and joins the pieces into closed outlines, largest first. The triangles' winding
// does not matter; duplicate triangles count once; ends left open by holes are joined to their nearest partner.
// Never fails: no contact gives no outlines.
std::vector<SectionLoop> CutByPlane(const TriangleMesh& mesh, std::span<const int> triangles, const SectionPlane& plane,
                                    const SectionOptions& options);

// Finds the triangles of a mesh that meet a horizontal plane without looking at all of them: they are registered in
// slabs of height. Refers to the mesh, which must outlive it and stay unchanged. Safe to read from several threads.
class HeightIndex {
 public:
  // `slab_count` slabs share the mesh's height evenly.
  HeightIndex(const TriangleMesh& mesh, int slab_count);

  // Returns the outlines at Y = `height`, in (x, z) coordinates.
  std::vector<SectionLoop> CutAt(double height, const SectionOptions& options) const;

  // Returns the triangles that may reach into [low, high]; one that spans several slabs is listed once.
  std::vector<int> TrianglesBetween(double low, double high) const;

  double min_height() const { return min_height_; }
  double max_height() const { return max_height_; }
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  int SlabOf(double height) const;
  std::pair<int, int> SlabsOf(const Eigen::Vector3i& triangle) const;  // First and last.

  const TriangleMesh& mesh_;
  double min_height_ = 0.0;
  double max_height_ = 0.0;
  double slabs_per_unit_ = 0.0;
  std::vector<int> slab_begin_;  // Into triangles_, one more than slabs.
  std::vector<int> triangles_;
};

}  // namespace fitroom
