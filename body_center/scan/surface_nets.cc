#include "body_center/scan/surface_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/check.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// Cells along a block's edge. Blocks far from the surface are passed over.
constexpr int kBlock = 8;
constexpr int kCorners = kBlock + 1;
// How steep the solid's function is taken to be: a block is passed over if its centre says that it is farther from the
// surface than its corners can be. Where the function is steeper, the surface is still followed from block to block.
constexpr double kSteepest = 1.7;

class SurfaceNets {
 public:
  SurfaceNets(const ImplicitSolid& solid, double spacing, int attempt) : solid_(solid), spacing_(spacing) {
    const Eigen::AlignedBox3d bounds = solid.Bounds();
    // The grid starts off the floor and off the middle plane: a corner exactly on the surface has no sign.
    origin_ = Vector3d(bounds.min().x(), 0.0, bounds.min().z()) -
              spacing * (Vector3d(4.37, 4.41, 4.29) + 0.13 * attempt * Vector3d(1, -1, 2));
    const Vector3d size = bounds.max() - origin_;
    for (int axis = 0; axis < 3; ++axis) {
      block_count_[axis] = static_cast<int>(std::ceil((size[axis] / spacing + 6.0) / kBlock));
    }
    const Vector3i cells = kBlock * block_count_;
    vertex_of_cell_.assign(
        static_cast<size_t>(cells.x()) * static_cast<size_t>(cells.y()) * static_cast<size_t>(cells.z()), -1);
    const Vector3i corners = cells + Vector3i::Ones();
    sign_of_corner_.assign(
        static_cast<size_t>(corners.x()) * static_cast<size_t>(corners.y()) * static_cast<size_t>(corners.z()), 0);
  }

  TriangleMesh Run() {
    for (int z = 0; z < block_count_.z(); ++z) {
      for (int y = 0; y < block_count_.y(); ++y) {
        for (int x = 0; x < block_count_.x(); ++x) {
          if (MayHoldSurface(Vector3i(x, y, z))) VisitBlock(Vector3i(x, y, z));
        }
      }
    }
    // Edges are added while their neighbours are visited.
    for (size_t i = 0; i < edges_.size(); ++i) VisitNeighbours(edges_[i]);
    for (const CrossedEdge& edge : edges_) EmitQuad(edge);
    PutOnSurface();
    EvenOut();
    PutOnSurface();
    return std::move(mesh_);
  }

 private:
  // A grid edge from the corner `cell` along `axis` whose ends lie on different sides.
  struct CrossedEdge {
    Vector3i cell;
    int axis = 0;
    bool starts_inside = false;
  };
  // The vertices made in one block, and the solid as it is there.
  struct BlockVertices {
    ImplicitSolid solid;
    size_t first = 0;
    size_t last = 0;
  };

  size_t CellIndex(const Vector3i& cell) const {
    const Vector3i cells = kBlock * block_count_;
    return (static_cast<size_t>(cell.z()) * static_cast<size_t>(cells.y()) + static_cast<size_t>(cell.y())) *
               static_cast<size_t>(cells.x()) +
           static_cast<size_t>(cell.x());
  }
  Vector3d CornerPosition(const Vector3i& corner) const { return origin_ + spacing_ * corner.cast<double>(); }
  double ValueAt(int x, int y, int z) const { return values_[static_cast<size_t>((z * kCorners + y) * kCorners + x)]; }

  Eigen::AlignedBox3d BlockBox(const Vector3i& block) const {
    return {CornerPosition(kBlock * block), CornerPosition(kBlock * block + Vector3i::Constant(kBlock))};
  }

  bool MayHoldSurface(const Vector3i& block) const {
    const Eigen::AlignedBox3d box = BlockBox(block);
    const ImplicitSolid local = solid_.RestrictedTo(box);
    if (local.empty()) return false;
    const double half_diagonal = 0.5 * std::sqrt(3.0) * kBlock * spacing_;
    return std::abs(local.Evaluate(box.center())) <= kSteepest * half_diagonal;
  }

  // A corner is shared by up to eight blocks whose reduced solids may differ in the last digits: the first one to see
  // it decides on which side it lies.
  double WithKnownSign(const Vector3i& corner, double value) {
    const Vector3i corners = kBlock * block_count_ + Vector3i::Ones();
    int8_t& known = sign_of_corner_[(static_cast<size_t>(corner.z()) * static_cast<size_t>(corners.y()) +
                                     static_cast<size_t>(corner.y())) *
                                        static_cast<size_t>(corners.x()) +
                                    static_cast<size_t>(corner.x())];
    const int8_t sign = value < 0.0 ? -1 : 1;
    if (known == 0) known = sign;
    return known == sign ? value : known * 1e-9;
  }

  void VisitNeighbours(const CrossedEdge edge) {  // A copy: visiting adds edges.
    const Vector3i b = Vector3i::Unit((edge.axis + 1) % 3);
    const Vector3i c = Vector3i::Unit((edge.axis + 2) % 3);
    for (const Vector3i& cell : {Vector3i(edge.cell - b), Vector3i(edge.cell - b - c), Vector3i(edge.cell - c)}) {
      if (vertex_of_cell_[CellIndex(cell)] < 0) VisitBlock(cell / kBlock);
    }
  }

  void VisitBlock(const Vector3i& block) {
    const Vector3i first = kBlock * block;
    ImplicitSolid local = solid_.RestrictedTo(BlockBox(block));
    size_t index = 0;
    for (int z = 0; z < kCorners; ++z) {
      for (int y = 0; y < kCorners; ++y) {
        for (int x = 0; x < kCorners; ++x) {
          const Vector3i corner = first + Vector3i(x, y, z);
          values_[index++] = WithKnownSign(corner, local.Evaluate(CornerPosition(corner)));
        }
      }
    }
    const size_t first_vertex = mesh_.vertices.size();
    for (int z = 0; z < kBlock; ++z) {
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) VisitCell(first, Vector3i(x, y, z));
      }
    }
    if (mesh_.vertices.size() > first_vertex) {
      blocks_.push_back({std::move(local), first_vertex, mesh_.vertices.size()});
    }
  }

  // Makes the cell's vertices, one a sheet of the surface, and notes the three edges that the cell owns.
  void VisitCell(const Vector3i& first, const Vector3i& place) {
    std::array<double, 8> corner;
    int inside_count = 0;
    for (int i = 0; i < 8; ++i) {
      corner[static_cast<size_t>(i)] = ValueAt(place.x() + (i & 1), place.y() + ((i >> 1) & 1), place.z() + (i >> 2));
      if (corner[static_cast<size_t>(i)] < 0.0) ++inside_count;
    }
    if (inside_count == 0 || inside_count == 8) return;
    const Vector3i cell = first + place;
    vertex_of_cell_[CellIndex(cell)] = static_cast<int32_t>(mesh_.vertices.size());
    uint32_t left = CrossedEdges(corner);
    while (left != 0) {
      const uint32_t sheet = SheetOf(corner, left);
      AddVertex(cell, corner, sheet);
      left &= ~sheet;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (IsInside(corner, 0) != IsInside(corner, 1 << axis)) edges_.push_back({cell, axis, IsInside(corner, 0)});
    }
  }

  static bool IsInside(const std::array<double, 8>& corner, int i) { return corner[static_cast<size_t>(i)] < 0.0; }
  // A cell's twelve edges: along `axis`, at `b` and `c` (0 or 1) along the next two axes.
  static int EdgeId(int axis, int b, int c) { return axis * 4 + b + 2 * c; }
  static int EdgeStart(int edge) {
    const int axis = edge / 4;
    return ((edge & 1) << ((axis + 1) % 3)) | (((edge >> 1) & 1) << ((axis + 2) % 3));
  }

  static uint32_t CrossedEdges(const std::array<double, 8>& corner) {
    uint32_t crossed = 0;
    for (int edge = 0; edge < 12; ++edge) {
      const int start = EdgeStart(edge);
      if (IsInside(corner, start) != IsInside(corner, start | (1 << (edge / 4)))) crossed |= 1u << edge;
    }
    return crossed;
  }

  // Returns the crossed edges that one sheet of the surface joins: those connected through the cell's faces, starting
  // from the lowest of `left`. On a face with four crossings the two inside corners are kept apart, in both cells that
  // share the face, so that the mesh stays a manifold (Nielson, Dual Marching Cubes, 2004).
  static uint32_t SheetOf(const std::array<double, 8>& corner, uint32_t left) {
    uint32_t sheet = left & (~left + 1);
    for (bool grows = true; grows;) {
      grows = false;
      for (int face = 0; face < 6; ++face) {
        const int n = face / 2, side = face % 2;
        const int b = (n + 1) % 3, c = (n + 2) % 3;
        // The face's edges in order round it, each after the corner it starts from:
        // (0,0) -b-> (1,0) -c-> (1,1) -b-> (0,1) -c-> (0,0). An edge along b lies at (c, n), one along c at (n, b).
        const std::array<int, 4> edges = {EdgeId(b, 0, side), EdgeId(c, side, 1), EdgeId(b, 1, side),
                                          EdgeId(c, side, 0)};
        const std::array<int, 4> corners = {side << n, (side << n) | (1 << b), (side << n) | (1 << b) | (1 << c),
                                            (side << n) | (1 << c)};
        uint32_t of_face = 0;
        for (const int edge : edges) of_face |= left & (1u << edge);
        const bool is_ambiguous = IsInside(corner, corners[0]) == IsInside(corner, corners[2]) &&
                                  IsInside(corner, corners[1]) == IsInside(corner, corners[3]) &&
                                  IsInside(corner, corners[0]) != IsInside(corner, corners[1]);
        for (size_t i = 0; i < 4; ++i) {
          uint32_t joined = of_face;
          if (is_ambiguous) {
            if (!IsInside(corner, corners[i])) continue;
            joined = left & ((1u << edges[i]) | (1u << edges[(i + 3) % 4]));
          }
          if ((joined & sheet) != 0 && (joined & ~sheet) != 0) {
            sheet |= joined;
            grows = true;
          }
        }
      }
    }
    return sheet;
  }

  // Adds the vertex of one sheet at the mean of its crossings.
  void AddVertex(const Vector3i& cell, const std::array<double, 8>& corner, uint32_t sheet) {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (int edge = 0; edge < 12; ++edge) {
      if ((sheet & (1u << edge)) == 0) continue;
      const int start = EdgeStart(edge), axis = edge / 4;
      const double a = corner[static_cast<size_t>(start)];
      const double b = corner[static_cast<size_t>(start | (1 << axis))];
      Vector3d crossing(start & 1, (start >> 1) & 1, start >> 2);
      crossing[axis] = a / (a - b);
      sum += crossing;
      ++count;
    }
    mesh_.vertices.push_back(CornerPosition(cell) + spacing_ / count * sum);
    sheets_.push_back(sheet);
  }

  // Returns the cell's vertex whose sheet crosses the edge.
  int VertexAt(const Vector3i& cell, int edge) const {
    int vertex = vertex_of_cell_[CellIndex(cell)];
    FR_CHECK(vertex >= 0);
    while ((sheets_[static_cast<size_t>(vertex)] & (1u << edge)) == 0) ++vertex;
    return vertex;
  }

  // Joins the vertices of the four cells round a crossed edge.
  void EmitQuad(const CrossedEdge& edge) {
    const Vector3i b = Vector3i::Unit((edge.axis + 1) % 3);
    const Vector3i c = Vector3i::Unit((edge.axis + 2) % 3);
    std::array<int, 4> v = {
        VertexAt(edge.cell, EdgeId(edge.axis, 0, 0)), VertexAt(edge.cell - b, EdgeId(edge.axis, 1, 0)),
        VertexAt(edge.cell - b - c, EdgeId(edge.axis, 1, 1)), VertexAt(edge.cell - c, EdgeId(edge.axis, 0, 1))};
    if (!edge.starts_inside) std::swap(v[1], v[3]);
    const auto squared_distance = [this](int i, int j) {
      return (mesh_.vertices[static_cast<size_t>(i)] - mesh_.vertices[static_cast<size_t>(j)]).squaredNorm();
    };
    if (squared_distance(v[0], v[2]) <= squared_distance(v[1], v[3])) {
      mesh_.triangles.emplace_back(v[0], v[1], v[2]);
      mesh_.triangles.emplace_back(v[0], v[2], v[3]);
    } else {
      mesh_.triangles.emplace_back(v[0], v[1], v[3]);
      mesh_.triangles.emplace_back(v[1], v[2], v[3]);
    }
  }

  // One Newton step along the gradient, at most half a cell.
  void PutOnSurface() {
    constexpr double kStep = 1e-4;
    for (const BlockVertices& block : blocks_) {
      for (size_t i = block.first; i < block.last; ++i) {
        Vector3d& vertex = mesh_.vertices[i];
        const double value = block.solid.Evaluate(vertex);
        Vector3d gradient;
        for (int axis = 0; axis < 3; ++axis) {
          gradient[axis] = (block.solid.Evaluate(vertex + kStep * Vector3d::Unit(axis)) - value) / kStep;
        }
        Vector3d move = -value / std::max(gradient.squaredNorm(), 0.1) * gradient;
        if (move.norm() > 0.5 * spacing_) move *= 0.5 * spacing_ / move.norm();
        vertex += move;
      }
    }
  }

  // Moves every vertex half way to its neighbours' mean, within the tangent plane.
  void EvenOut() {
    const std::vector<Vector3d> normals = ComputeVertexNormals(mesh_);
    std::vector<Vector3d> sums(mesh_.vertices.size(), Vector3d::Zero());
    std::vector<int> counts(mesh_.vertices.size(), 0);
    for (const Vector3i& triangle : mesh_.triangles) {
      for (int i = 0; i < 3; ++i) {
        const size_t from = static_cast<size_t>(triangle[i]);
        sums[from] += mesh_.vertices[static_cast<size_t>(triangle[(i + 1) % 3])];
        sums[from] += mesh_.vertices[static_cast<size_t>(triangle[(i + 2) % 3])];
        counts[from] += 2;
      }
    }
    for (size_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (counts[i] == 0) continue;
      const Vector3d move = sums[i] / counts[i] - mesh_.vertices[i];
      mesh_.vertices[i] += 0.5 * (move - move.dot(normals[i]) * normals[i]);
    }
  }

  const ImplicitSolid& solid_;
  double spacing_;
  Vector3d origin_;
  Vector3i block_count_;
  std::array<double, kCorners* kCorners* kCorners> values_ = {};
  std::vector<int32_t> vertex_of_cell_;  // The cell's first vertex; the others follow it.
  std::vector<uint32_t> sheets_;         // The edges that each vertex's sheet crosses, as bits.
  std::vector<int8_t> sign_of_corner_;   // -1 inside, 1 outside, 0 not seen yet.
  std::vector<CrossedEdge> edges_;
  std::vector<BlockVertices> blocks_;
  TriangleMesh mesh_;
};

// Says whether no edge is used twice in the same direction.
bool IsManifold(const TriangleMesh& mesh) {
  std::vector<uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Vector3i& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      edges.push_back(static_cast<uint64_t>(triangle[i]) << 32 | static_cast<uint32_t>(triangle[(i + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

}  // namespace

TriangleMesh PolygoniseSurface(const ImplicitSolid& solid, double spacing) {
  FR_CHECK(spacing > 1e-4);
  // Where a saddle lies just so between two cells, four quadrilaterals share an edge. That depends on where the grid
  // lies, and is rare: another grid is tried.
  constexpr int kMaxAttempts = 6;
  TriangleMesh mesh;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    mesh = SurfaceNets(solid, spacing, attempt).Run();
    if (IsManifold(mesh)) break;
  }
  return mesh;
}

}  // namespace fitroom::body_center
