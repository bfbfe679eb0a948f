#include "fit_client/render/ground_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace fitroom::render {
namespace {

constexpr int kSide = 192;         // (unit: pixel)
constexpr double kMargin = 0.45;   // Round the body (unit: metre).
constexpr double kContact = 0.05;  // Height at which a part stops to be in contact (unit: metre).

// Blurs `values` (kSide x kSide) with a box of 2 r + 1 cells three times: close to a Gauss bell.
void Blur(std::vector<float>& values, int r) {
  std::vector<float> line(kSide);
  for (int pass = 0; pass < 6; ++pass) {
    const int step = pass % 2 == 0 ? 1 : kSide;
    const int jump = pass % 2 == 0 ? kSide : 1;
    for (int row = 0; row < kSide; ++row) {
      float* start = values.data() + static_cast<ptrdiff_t>(row) * jump;
      for (int i = 0; i < kSide; ++i) {
        float sum = 0.0F;
        for (int k = std::max(0, i - r); k <= std::min(kSide - 1, i + r); ++k)
          sum += start[static_cast<ptrdiff_t>(k) * step];
        line[static_cast<size_t>(i)] = sum / static_cast<float>(2 * r + 1);
      }
      for (int i = 0; i < kSide; ++i) start[static_cast<ptrdiff_t>(i) * step] = line[static_cast<size_t>(i)];
    }
  }
}

}  // namespace

GroundShadow ComputeGroundShadow(const DisplayBody& body) {
  const Eigen::AlignedBox3d bounds = ComputeBounds(body.mesh);
  GroundShadow shadow;
  shadow.darkness = Image{kSide, kSide, 1, std::vector<uint8_t>(static_cast<size_t>(kSide) * kSide, 0)};
  if (bounds.isEmpty()) return shadow;
  // A square, so that a cell is as wide as deep.
  const double side = std::max(bounds.sizes().x(), bounds.sizes().z()) + 2.0 * kMargin;
  shadow.height = bounds.min().y();
  shadow.min_xz = Eigen::Vector2d(bounds.center().x() - 0.5 * side, bounds.center().z() - 0.5 * side);
  shadow.size_xz = Eigen::Vector2d(side, side);

  std::vector<float> contact(static_cast<size_t>(kSide) * kSide, 0.0F);
  std::vector<float> wide = contact;
  for (const Eigen::Vector3d& v : body.mesh.vertices) {
    const int x = std::clamp(static_cast<int>((v.x() - shadow.min_xz.x()) / side * kSide), 0, kSide - 1);
    const int z = std::clamp(static_cast<int>((v.z() - shadow.min_xz.y()) / side * kSide), 0, kSide - 1);
    const size_t cell = static_cast<size_t>(z) * kSide + static_cast<size_t>(x);
    const double height = v.y() - shadow.height;
    contact[cell] = std::max(contact[cell], static_cast<float>(std::exp(-height / kContact)));
    wide[cell] = std::max(wide[cell], static_cast<float>(std::exp(-height / 0.6)));
  }
  Blur(contact, 2);
  Blur(wide, 12);
  for (size_t i = 0; i < contact.size(); ++i) {
    const float darkness =
        1.0F - (1.0F - 0.62F * std::min(1.0F, 1.4F * contact[i])) * (1.0F - 0.35F * std::min(1.0F, wide[i]));
    shadow.darkness.pixels[i] = static_cast<uint8_t>(std::lround(std::clamp(darkness, 0.0F, 1.0F) * 255.0F));
  }
  return shadow;
}

}  // namespace fitroom::render
