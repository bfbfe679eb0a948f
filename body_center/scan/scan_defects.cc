#include "body_center/scan/scan_defects.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "body_center/scan/random_source.h"

namespace fitroom::body_center {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kNoise = 0.0003;   // Deviation along the normal (unit: metre).
constexpr double kRipple = 0.0001;  // Of the scanner's motion (unit: metre).
constexpr int kDropoutCount = 10;

struct Ball {
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;  // (unit: metre)
};

void AddNoise(RandomSource& random, TriangleMesh& mesh) {
  const std::vector<Vector3d> normals = ComputeVertexNormals(mesh);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    // Scanning heads run down the body in steps of about two millimetres.
    const double ripple = kRipple * std::sin(mesh.vertices[i].y() / 0.002);
    const double noise = std::clamp(random.Normal(), -3.0, 3.0) * kNoise;
    mesh.vertices[i] += (noise + ripple) * normals[i];
  }
}

std::vector<Ball> PlaceHoles(const TriangleMesh& mesh, const BodyLandmarks& landmarks, RandomSource& random) {
  std::vector<Ball> holes;
  const auto at = [&](BodyLandmark landmark, double radius) {
    holes.push_back({landmarks[landmark].position, radius});
  };
  at(BodyLandmark::kArmpitLeft, 0.020 + 0.006 * random.Uniform());
  at(BodyLandmark::kArmpitRight, 0.020 + 0.006 * random.Uniform());
  at(BodyLandmark::kCrotch, 0.022 + 0.006 * random.Uniform());
  at(BodyLandmark::kCrown, 0.014 + 0.006 * random.Uniform());
  for (int i = 0; i < kDropoutCount; ++i) {
    const size_t vertex = static_cast<size_t>(random.Uniform() * static_cast<double>(mesh.vertices.size()));
    holes.push_back({mesh.vertices[vertex], 0.003 + 0.005 * random.Uniform()});
  }
  return holes;
}

// Says whether the triangle lies on the floor, where no head sees it.
bool IsOnSole(const TriangleMesh& mesh, const Vector3i& triangle) {
  return std::max({mesh.vertices[static_cast<size_t>(triangle[0])].y(),
                   mesh.vertices[static_cast<size_t>(triangle[1])].y(),
                   mesh.vertices[static_cast<size_t>(triangle[2])].y()}) < 0.0025;
}

bool IsInAny(const Vector3d& point, const std::vector<Ball>& balls) {
  return std::any_of(balls.begin(), balls.end(), [&point](const Ball& ball) {
    return (point - ball.centre).squaredNorm() < ball.radius * ball.radius;
  });
}

// Copies a patch of the surface to a place in the air before or behind the body, as stray reflections do.
void AddIsland(RandomSource& random, TriangleMesh& mesh) {
  const size_t seed_vertex = static_cast<size_t>(random.Uniform() * static_cast<double>(mesh.vertices.size()));
  const Ball patch{mesh.vertices[seed_vertex], 0.012 + 0.006 * random.Uniform()};
  const double direction = patch.centre.z() >= 0.0 ? 1.0 : -1.0;
  const Vector3d shift(0.02 * random.Uniform(), 0.02 * random.Uniform(), direction * (0.16 + 0.05 * random.Uniform()));
  const size_t triangle_count = mesh.triangles.size();
  std::vector<int> copy_of(mesh.vertices.size(), -1);
  for (size_t i = 0; i < triangle_count; ++i) {
    Vector3i triangle = mesh.triangles[i];
    const bool is_inside = (triangle.array() >= 0).all() && [&] {
      for (int k = 0; k < 3; ++k) {
        if (!IsInAny(mesh.vertices[static_cast<size_t>(triangle[k])], {patch})) return false;
      }
      return true;
    }();
    if (!is_inside) continue;
    for (int k = 0; k < 3; ++k) {
      int& copy = copy_of[static_cast<size_t>(triangle[k])];
      if (copy < 0) {
        copy = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(mesh.vertices[static_cast<size_t>(triangle[k])] + shift);
      }
      triangle[k] = copy;
    }
    mesh.triangles.push_back(triangle);
  }
}

void DropUnusedVertices(TriangleMesh& mesh) {
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (const Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) new_index[static_cast<size_t>(triangle[k])] = 0;
  }
  int count = 0;
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (new_index[i] < 0) continue;
    mesh.vertices[static_cast<size_t>(count)] = mesh.vertices[i];
    new_index[i] = count++;
  }
  mesh.vertices.resize(static_cast<size_t>(count));
  for (Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) triangle[k] = new_index[static_cast<size_t>(triangle[k])];
  }
}

}  // namespace

TriangleMesh AddScanDefects(const TriangleMesh& mesh, const BodyLandmarks& landmarks, uint64_t seed) {
  RandomSource random(seed);
  TriangleMesh scan = mesh;
  const std::vector<Ball> holes = PlaceHoles(mesh, landmarks, random);
  std::erase_if(scan.triangles, [&](const Vector3i& triangle) {
    const Vector3d middle =
        (mesh.vertices[static_cast<size_t>(triangle[0])] + mesh.vertices[static_cast<size_t>(triangle[1])] +
         mesh.vertices[static_cast<size_t>(triangle[2])]) /
        3.0;
    return IsOnSole(mesh, triangle) || IsInAny(middle, holes);
  });
  for (int i = 0; i < 2; ++i) AddIsland(random, scan);
  DropUnusedVertices(scan);
  AddNoise(random, scan);
  return scan;
}

}  // namespace fitroom::body_center
