#include "tests/fit_client/solver/cloth_shapes.h"

#include <gtest/gtest.h>

#include "tests/fit_client/collision/shapes.h"

namespace fitroom::testing {
namespace {

SignedDistanceField BuildField(const TriangleMesh& body) {
  SerialExecutor serial;
  Result<SignedDistanceField> field = SignedDistanceField::Build(body, {}, serial);
  EXPECT_TRUE(field.ok()) << field.status().ToString();
  return std::move(field).value();
}

void AddGrid(ClothMesh& mesh, const Eigen::Vector3d& corner, double width, double height, int columns, int rows,
             bool faces_back) {
  const int first = static_cast<int>(mesh.rest_positions.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.rest_positions.push_back(corner + Eigen::Vector3d(width * column / columns, height * row / rows, 0.0));
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = first + row * (columns + 1) + column;
      const int b = a + 1;
      const int c = a + columns + 1;
      const int d = c + 1;
      for (Eigen::Vector3i triangle : {Eigen::Vector3i(a, b, d), Eigen::Vector3i(a, d, c)}) {
        if (faces_back) std::swap(triangle[1], triangle[2]);
        mesh.triangles.push_back(triangle);
      }
    }
  }
}

}  // namespace

ClothMesh MakeSheet(double width, double height, int columns, int rows) {
  ClothMesh mesh;
  AddGrid(mesh, Eigen::Vector3d::Zero(), width, height, columns, rows, /*faces_back=*/false);
  return mesh;
}

ClothMesh MakeTube(double width, double height, int columns, int rows, double distance) {
  ClothMesh mesh;
  AddGrid(mesh, {-0.5 * width, 0.0, distance}, width, height, columns, rows, /*faces_back=*/false);
  const int back = static_cast<int>(mesh.rest_positions.size());
  AddGrid(mesh, {-0.5 * width, 0.0, -distance}, width, height, columns, rows, /*faces_back=*/true);
  for (int row = 0; row <= rows; ++row) {
    for (const int column : {0, columns}) {
      const int particle = row * (columns + 1) + column;
      mesh.seams.push_back({particle, back + particle});
    }
  }
  return mesh;
}

SignedDistanceField MakeFarBody() { return BuildField(MakeSphere({0.0, -9.0, 0.0}, 0.05, 2)); }

SignedDistanceField MakeSlope(double angle) {
  TriangleMesh plate =
      MakeBox(Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, -0.06, -0.1), Eigen::Vector3d(0.5, 0.0, 0.1)), 24);
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (Eigen::Vector3d& vertex : plate.vertices) vertex = tilt * vertex;
  return BuildField(plate);
}

}  // namespace fitroom::testing
