#include "fit_client/render/image_scaling.h"

#include <algorithm>
#include <cstdint>

namespace fitroom::render {

Image HalveImage(const Image& image) {
  const int width = std::max(1, image.width / 2);
  const int height = std::max(1, image.height / 2);
  const size_t channels = static_cast<size_t>(image.channels);
  Image half{width, height, image.channels,
             std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * channels)};
  for (int y = 0; y < height; ++y) {
    const int y0 = std::min(2 * y, image.height - 1);
    const int y1 = std::min(2 * y + 1, image.height - 1);
    for (int x = 0; x < width; ++x) {
      const int x0 = std::min(2 * x, image.width - 1);
      const int x1 = std::min(2 * x + 1, image.width - 1);
      uint8_t* to = half.at(x, y);
      for (size_t c = 0; c < channels; ++c) {
        const int sum = image.at(x0, y0)[c] + image.at(x1, y0)[c] + image.at(x0, y1)[c] + image.at(x1, y1)[c];
        to[c] = static_cast<uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

}  // namespace fitroom::render
