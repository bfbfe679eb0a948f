#include "tests/fit_client/measure/band_on_cylinder.h"

#include <cmath>
#include <numbers>

namespace fitroom {

Band MakeBand(double radius, double width, double strain, double strain_across, double pitch) {
  Band band;
  const double half_girth = std::numbers::pi * radius / (1.0 + strain);
  const int columns = static_cast<int>(std::lround(half_girth / pitch));
  const double step = half_girth / columns;
  const int rows = 2 * static_cast<int>(std::lround(width / (step * std::sqrt(3.0))));
  const double row_step = step * std::sqrt(3.0) / 2.0;
  // Odd rows are shifted by half a step; a half triangle closes each at both seams.
  const auto x_of = [&](int row, int k) {
    if (row % 2 == 0) return k * step;
    return k == 0 ? 0.0 : k == columns + 1 ? half_girth : (k - 0.5) * step;
  };
  const auto count_of = [&](int row) { return row % 2 == 0 ? columns + 1 : columns + 2; };
  std::vector<int> panel_begin;
  std::vector<std::vector<int>> row_begin(2);
  for (int panel = 0; panel < 2; ++panel) {
    for (int row = 0; row <= rows; ++row) {
      row_begin[static_cast<size_t>(panel)].push_back(static_cast<int>(band.worn.size()));
      for (int k = 0; k < count_of(row); ++k) {
        const double x = x_of(row, k);
        // Front: from the wearer's right (-x) to the left, seen from outside; back: on round.
        const double angle = std::numbers::pi * (x / half_girth - 0.5 + panel);
        const double y = (row - 0.5 * rows) * row_step;
        band.worn.emplace_back(radius * std::sin(angle), 1.0 + y * (1.0 + strain_across), radius * std::cos(angle));
        const double flat = x - 0.5 * half_girth;
        band.cloth.rest_positions.emplace_back(panel == 0 ? flat : -flat, y, 0.0);
        band.cloth.panel_of_particle.push_back(panel);
        band.cloth.texture_coordinates.emplace_back(0.5, 0.5);
      }
    }
    for (int row = 0; row < rows; ++row) {
      const int low = row_begin[static_cast<size_t>(panel)][static_cast<size_t>(row)];
      const int high = row_begin[static_cast<size_t>(panel)][static_cast<size_t>(row + 1)];
      int a = 0;
      int b = 0;
      while (a + 1 < count_of(row) || b + 1 < count_of(row + 1)) {
        const bool is_low =
            a + 1 < count_of(row) && (b + 1 >= count_of(row + 1) || x_of(row, a + 1) <= x_of(row + 1, b + 1) - 1e-12);
        if (is_low) {
          band.cloth.triangles.emplace_back(low + a, low + a + 1, high + b);
          ++a;
        } else {
          band.cloth.triangles.emplace_back(low + a, high + b + 1, high + b);
          ++b;
        }
      }
    }
  }
  for (int row = 0; row <= rows; ++row) {
    const size_t r = static_cast<size_t>(row);
    band.cloth.seams.push_back({row_begin[0][r], row_begin[1][r] + count_of(row) - 1});
    band.cloth.seams.push_back({row_begin[0][r] + count_of(row) - 1, row_begin[1][r]});
  }
  return band;
}

TriangleMesh MakeCylinder(double radius) {
  constexpr int kSides = 180;
  constexpr int kRings = 60;
  TriangleMesh mesh;
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      mesh.vertices.emplace_back(radius * std::sin(angle), 0.7 + 0.6 * ring / kRings, radius * std::cos(angle));
    }
  }
  const int low = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0, 0.7, 0.0);
  mesh.vertices.emplace_back(0.0, 1.3, 0.0);
  for (int k = 0; k < kSides; ++k) {
    const int next = (k + 1) % kSides;
    for (int ring = 0; ring < kRings; ++ring) {
      const int row = ring * kSides;
      mesh.triangles.emplace_back(row + k, row + next, row + kSides + next);
      mesh.triangles.emplace_back(row + k, row + kSides + next, row + kSides + k);
    }
    mesh.triangles.emplace_back(low, next, k);
    mesh.triangles.emplace_back(low + 1, kRings * kSides + k, kRings * kSides + next);
  }
  return mesh;
}

}  // namespace fitroom
