#include "tests/fit_client/render/dressed_capsule.h"

#include <cmath>

namespace fitroom::render {
namespace {

constexpr double kPi = 3.14159265358979323846;

TriangleMesh MakeCapsule() {
  // Rings from the lowest point to the highest: two half spheres and what is between them.
  constexpr int kSectors = 48;
  constexpr int kRings = 40;
  TriangleMesh mesh;
  for (int ring = 0; ring <= kRings; ++ring) {
    const double angle = kPi * (static_cast<double>(ring) / kRings - 0.5);
    const double y = kCapsuleRadius * (1.0 + std::sin(angle)) + (ring > kRings / 2 ? 1.7 - 2.0 * kCapsuleRadius : 0.0);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double turn = 2.0 * kPi * sector / kSectors;
      mesh.vertices.emplace_back(kCapsuleRadius * std::cos(angle) * std::sin(turn), y,
                                 kCapsuleRadius * std::cos(angle) * std::cos(turn));
    }
  }
  for (int ring = 0; ring < kRings; ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      const int a = ring * kSectors + sector;
      const int b = ring * kSectors + (sector + 1) % kSectors;
      mesh.triangles.emplace_back(a, b, b + kSectors);
      mesh.triangles.emplace_back(a, b + kSectors, a + kSectors);
    }
  }
  return mesh;
}

}  // namespace

DressedCapsule MakeDressedCapsule() {
  DressedCapsule scene;
  scene.body = PrepareBody(MakeCapsule());
  constexpr int kColumns = 32;
  constexpr int kRows = 30;
  for (int panel = 0; panel < 2; ++panel) {
    const int first = static_cast<int>(scene.positions.size());
    for (int row = 0; row <= kRows; ++row) {
      for (int column = 0; column <= kColumns; ++column) {
        const double u = static_cast<double>(column) / kColumns;
        const double v = static_cast<double>(row) / kRows;
        // Seen from the front the image's left is at -x; seen from the back it is at +x.
        const double turn = kPi * (u - 0.5) + (panel == 0 ? 0.0 : kPi);
        scene.positions.emplace_back(kTubeRadius * std::sin(turn), kTubeTop + (kTubeBottom - kTubeTop) * v,
                                     kTubeRadius * std::cos(turn));
        scene.cloth.panel_of_particle.push_back(panel);
        scene.cloth.texture_coordinates.emplace_back(u, v);
        const int index = first + row * (kColumns + 1) + column;
        if (row == kRows || column == kColumns) continue;
        const int below = index + kColumns + 1;
        scene.cloth.triangles.emplace_back(index, below, below + 1);
        scene.cloth.triangles.emplace_back(index, below + 1, index + 1);
      }
    }
  }
  const int panel_size = (kColumns + 1) * (kRows + 1);
  for (int row = 0; row <= kRows; ++row) {
    const int left = row * (kColumns + 1);
    const int right = left + kColumns;
    scene.cloth.seams.push_back({left, panel_size + right});
    scene.cloth.seams.push_back({right, panel_size + left});
  }
  scene.cloth.rest_positions = scene.positions;
  return scene;
}

Image MakeHalvedImage(const std::vector<uint8_t>& left, const std::vector<uint8_t>& right) {
  constexpr int kSide = 64;
  Image image{kSide, kSide, 3, std::vector<uint8_t>(static_cast<size_t>(kSide) * kSide * 3)};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (size_t c = 0; c < 3; ++c) image.at(x, y)[c] = x < kSide / 2 ? left[c] : right[c];
    }
  }
  return image;
}

}  // namespace fitroom::render
