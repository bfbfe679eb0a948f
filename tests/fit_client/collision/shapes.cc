#include "tests/fit_client/collision/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace fitroom::testing {
namespace {

// Joins a grid of `rows` x `columns` vertices (starting at vertex `first`) that closes on itself along the columns.
void AddRing(TriangleMesh& mesh, int first, int rows, int columns, bool closed_rows) {
  for (int row = 0; row + (closed_rows ? 0 : 1) < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int next_row = (row + 1) % rows;
      const int next_column = (column + 1) % columns;
      const int a = first + row * columns + column;
      const int b = first + row * columns + next_column;
      const int c = first + next_row * columns + column;
      const int d = first + next_row * columns + next_column;
      mesh.triangles.emplace_back(a, c, b);
      mesh.triangles.emplace_back(b, c, d);
    }
  }
}

}  // namespace

TriangleMesh MakeSphere(const Eigen::Vector3d& centre, double radius, int subdivisions) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  TriangleMesh mesh;
  mesh.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int round = 0; round < subdivisions; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (is_new) {
        mesh.vertices.push_back(0.5 * (mesh.vertices[static_cast<size_t>(a)] + mesh.vertices[static_cast<size_t>(b)]));
      }
      return place->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      const int ab = middle(triangle[0], triangle[1]);
      const int bc = middle(triangle[1], triangle[2]);
      const int ca = middle(triangle[2], triangle[0]);
      finer.emplace_back(triangle[0], ab, ca);
      finer.emplace_back(ab, triangle[1], bc);
      finer.emplace_back(ca, bc, triangle[2]);
      finer.emplace_back(ab, bc, ca);
    }
    mesh.triangles = std::move(finer);
  }
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = centre + radius * vertex.normalized();
  return mesh;
}

TriangleMesh MakeBox(const Eigen::AlignedBox3d& box, int cuts) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> vertices;
  const auto vertex = [&](const Eigen::Vector3i& node) {
    const auto [place, is_new] =
        vertices.try_emplace({node.x(), node.y(), node.z()}, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(box.min() + box.sizes().cwiseProduct(node.cast<double>()) / cuts);
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, cuts}) {
      for (int i = 0; i < cuts; ++i) {
        for (int j = 0; j < cuts; ++j) {
          const auto node = [&](int u, int v) {
            Eigen::Vector3i at;
            at[axis] = side;
            at[(axis + 1) % 3] = u;
            at[(axis + 2) % 3] = v;
            return vertex(at);
          };
          const int a = node(i, j);
          const int b = node(i + 1, j);
          const int c = node(i + 1, j + 1);
          const int d = node(i, j + 1);
          if (side == cuts) {
            mesh.triangles.emplace_back(a, b, c);
            mesh.triangles.emplace_back(a, c, d);
          } else {
            mesh.triangles.emplace_back(a, c, b);
            mesh.triangles.emplace_back(a, d, c);
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh MakeTorus(double ring_radius, double tube_radius, int ring_count, int tube_count) {
  TriangleMesh mesh;
  for (int ring = 0; ring < ring_count; ++ring) {
    const double u = 2.0 * M_PI * ring / ring_count;
    for (int tube = 0; tube < tube_count; ++tube) {
      const double v = -2.0 * M_PI * tube / tube_count;
      const double r = ring_radius + tube_radius * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), tube_radius * std::sin(v), r * std::sin(u));
    }
  }
  AddRing(mesh, 0, ring_count, tube_count, /*closed_rows=*/true);
  return mesh;
}

TriangleMesh MakeCylinder(double radius, double low, double high, int around, int along) {
  TriangleMesh mesh;
  for (int row = 0; row <= along; ++row) {
    for (int column = 0; column < around; ++column) {
      const double angle = 2.0 * M_PI * column / around;
      mesh.vertices.emplace_back(radius * std::cos(angle), low + (high - low) * row / along, radius * std::sin(angle));
    }
  }
  AddRing(mesh, 0, along + 1, around, /*closed_rows=*/false);
  for (const bool top : {false, true}) {
    const int centre = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(0.0, top ? high : low, 0.0);
    const int first = top ? along * around : 0;
    for (int column = 0; column < around; ++column) {
      const int a = first + column;
      const int b = first + (column + 1) % around;
      if (top) {
        mesh.triangles.emplace_back(centre, b, a);
      } else {
        mesh.triangles.emplace_back(centre, a, b);
      }
    }
  }
  return mesh;
}

}  // namespace fitroom::testing
