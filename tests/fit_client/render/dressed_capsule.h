#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// A scene that can be checked by hand: a capsule (radius 0.2 m, 1.7 m high, on the floor, round the Y axis) in a tube
// of cloth (radius 0.22 m, from 0.8 m to 1.4 m). The tube's front half is panel 0, its back half panel 1, sewn at x =
// -0.22 and x = +0.22. Texture coordinates run over the photograph as seen from outside: u = 0 is the left of what a
// person sees who stands before that panel.
struct DressedCapsule {
  DisplayBody body;
  ClothMesh cloth;
  std::vector<Eigen::Vector3d> positions;
};
inline constexpr double kCapsuleRadius = 0.2;  // (unit: metre)
inline constexpr double kTubeRadius = 0.22;    // (unit: metre)
inline constexpr double kTubeBottom = 0.8;     // (unit: metre)
inline constexpr double kTubeTop = 1.4;        // (unit: metre)

DressedCapsule MakeDressedCapsule();

// Returns an image whose left half has one colour and whose right half another.
Image MakeHalvedImage(const std::vector<uint8_t>& left, const std::vector<uint8_t>& right);

}  // namespace fitroom::render
