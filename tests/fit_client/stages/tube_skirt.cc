#include "tests/fit_client/stages/tube_skirt.h"

#include <string>

namespace fitroom::testing {

ClothMesh MakeTubeSkirt(double width, double hem_width, double length, int columns, int rows) {
  ClothMesh mesh;
  const auto at = [&](int panel, int row, int column) { return (panel * (rows + 1) + row) * (columns + 1) + column; };
  for (const int panel : {0, 1}) {
    for (int row = 0; row <= rows; ++row) {
      const double down = static_cast<double>(row) / rows;
      const double wide = (1.0 - down) * width + down * hem_width;
      for (int column = 0; column <= columns; ++column) {
        mesh.rest_positions.emplace_back(wide * (static_cast<double>(column) / columns - 0.5), -down * length, 0.0);
        mesh.panel_of_particle.push_back(panel);
        mesh.texture_coordinates.emplace_back(0.0, 0.0);
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int a = at(panel, row + 1, column);
        const int b = at(panel, row + 1, column + 1);
        const int c = at(panel, row, column);
        const int d = at(panel, row, column + 1);
        for (Eigen::Vector3i triangle : {Eigen::Vector3i(a, b, d), Eigen::Vector3i(a, d, c)}) {
          if (panel == 1) std::swap(triangle[1], triangle[2]);
          mesh.triangles.push_back(triangle);
        }
      }
    }
    const std::string side = panel == 0 ? "front/" : "back/";
    mesh.named_particles.push_back({side + "e1", at(panel, 0, columns)});
    mesh.named_particles.push_back({side + "e3", at(panel, 0, 0)});
    mesh.named_particles.push_back({side + "e2", at(panel, rows, columns)});
    mesh.named_particles.push_back({side + "e4", at(panel, rows, 0)});
  }
  for (int row = 0; row <= rows; ++row) {
    for (const int column : {0, columns}) mesh.seams.push_back({at(0, row, column), at(1, row, column)});
  }
  return mesh;
}

}  // namespace fitroom::testing
