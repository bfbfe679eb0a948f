#include "tests/fit_client/paper/common_case.h"

#include <cmath>
#include <fstream>
#include <map>
#include <utility>

#include "common/scan_file/scan_file.h"

namespace fitroom::testing {

TriangleMesh MakeEllipticCone(double upper_half_width, double lower_half_width, double depth_ratio, double low,
                              double high, int around, int along) {
  TriangleMesh cone;
  for (int row = 0; row <= along; ++row) {
    const double t = static_cast<double>(row) / along;
    const double a = lower_half_width + t * (upper_half_width - lower_half_width);
    for (int column = 0; column < around; ++column) {
      const double angle = 2.0 * M_PI * column / around;
      cone.vertices.emplace_back(a * std::sin(angle), low + t * (high - low), depth_ratio * a * std::cos(angle));
    }
  }
  const int bottom = static_cast<int>(cone.vertices.size());
  cone.vertices.emplace_back(0.0, low, 0.0);
  cone.vertices.emplace_back(0.0, high, 0.0);
  for (int column = 0; column < around; ++column) {
    const int next = (column + 1) % around;
    for (int row = 0; row < along; ++row) {
      const int a = row * around + column;
      const int b = row * around + next;
      cone.triangles.emplace_back(a, b, b + around);
      cone.triangles.emplace_back(a, b + around, a + around);
    }
    cone.triangles.emplace_back(bottom, next, column);
    cone.triangles.emplace_back(bottom + 1, along * around + column, along * around + next);
  }
  return cone;
}

ClothMesh MakeConeSkirt(double upper_half_width, double lower_half_width, double depth_ratio, double body_low,
                        double body_high, double low, double high, double ease, double distance, int columns,
                        int rows) {
  ClothMesh mesh;
  for (const int panel : {0, 1}) {
    const int first = static_cast<int>(mesh.rest_positions.size());
    for (int row = 0; row <= rows; ++row) {
      const double y = low + (high - low) * row / rows;
      const double t = (y - body_low) / (body_high - body_low);
      const double a = lower_half_width + t * (upper_half_width - lower_half_width);
      const double width = 0.5 * ease * EllipsePerimeter(a, depth_ratio * a);
      for (int column = 0; column <= columns; ++column) {
        mesh.rest_positions.emplace_back(width * (static_cast<double>(column) / columns - 0.5), y,
                                         panel == 0 ? distance : -distance);
        mesh.panel_of_particle.push_back(panel);
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int a = first + row * (columns + 1) + column;
        const int c = a + columns + 1;
        // Diagonals run towards the middle, so that left and right are alike.
        const bool is_left = 2 * column < columns;
        for (Eigen::Vector3i triangle : {is_left ? Eigen::Vector3i(a, a + 1, c + 1) : Eigen::Vector3i(a, a + 1, c),
                                         is_left ? Eigen::Vector3i(a, c + 1, c) : Eigen::Vector3i(a + 1, c + 1, c)}) {
          if (panel == 1) std::swap(triangle[1], triangle[2]);
          mesh.triangles.push_back(triangle);
        }
      }
    }
  }
  const int back = static_cast<int>(mesh.rest_positions.size()) / 2;
  for (int row = 0; row <= rows; ++row) {
    for (const int column : {0, columns}) {
      const int particle = row * (columns + 1) + column;
      mesh.seams.push_back({particle, back + particle});
    }
  }
  return mesh;
}

TriangleMesh CommonCone() { return MakeEllipticCone(0.06, 0.24, 0.7, -0.3, 0.3, 96, 60); }

ClothMesh CommonSkirt(double refinement) {
  const int columns = 2 * static_cast<int>(std::lround(6.0 * refinement));
  const int rows = static_cast<int>(std::lround(10.0 * refinement));
  return MakeConeSkirt(0.06, 0.24, 0.7, -0.3, 0.3, -0.1, 0.2, 1.02, 0.17, columns, rows);
}

double EllipsePerimeter(double a, double b) {
  const double h = (a - b) * (a - b) / ((a + b) * (a + b));
  return M_PI * (a + b) * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
}

double RmsDistance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TriangleMesh Refined(const TriangleMesh& mesh, int rounds) {
  TriangleMesh fine = mesh;
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(fine.vertices.size()));
      if (is_new) {
        const Eigen::Vector3d half =
            0.5 * (fine.vertices[static_cast<size_t>(a)] + fine.vertices[static_cast<size_t>(b)]);
        fine.vertices.push_back(half);
      }
      return place->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& triangle : fine.triangles) {
      const int ab = middle(triangle[0], triangle[1]);
      const int bc = middle(triangle[1], triangle[2]);
      const int ca = middle(triangle[2], triangle[0]);
      finer.emplace_back(triangle[0], ab, ca);
      finer.emplace_back(ab, triangle[1], bc);
      finer.emplace_back(ca, bc, triangle[2]);
      finer.emplace_back(ab, bc, ca);
    }
    fine.triangles = std::move(finer);
  }
  return fine;
}

Result<ClothMesh> LoadPeerShirt(const std::filesystem::path& folder, const std::string& pitch) {
  FR_ASSIGN_OR_RETURN(const RawScan panels, ReadScanFile(folder / ("shirt_" + pitch + ".obj")));
  ClothMesh mesh;
  mesh.rest_positions = panels.mesh.vertices;
  mesh.triangles = panels.mesh.triangles;
  std::ifstream seams(folder / ("shirt_" + pitch + "_seams.txt"));
  for (SeamPair pair; seams >> pair.a >> pair.b;) mesh.seams.push_back(pair);
  // The front panel is the one that lies in front of the body, at smaller y.
  for (const Eigen::Vector3d& place : mesh.rest_positions) {
    mesh.panel_of_particle.push_back(place.y() < mesh.rest_positions.front().y() + 0.1 ? 0 : 1);
  }
  if (mesh.seams.empty()) return InvalidArgument("NO_SEAMS", "the shirt's file of seams is empty or missing");
  return mesh;
}

}  // namespace fitroom::testing
