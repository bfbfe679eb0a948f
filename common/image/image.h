#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fitroom {

// An 8-bit image, rows top to bottom, channels interleaved (1 grey, 3 RGB, 4 RGBA, alpha not premultiplied), sRGB.
// Owns its pixels. pixels.size() == width * height * channels.
struct Image {
  int width = 0;     // (unit: pixel)
  int height = 0;    // (unit: pixel)
  int channels = 0;  // 1, 3 or 4.
  std::vector<uint8_t> pixels;

  uint8_t* at(int x, int y) {
    return pixels.data() + (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
                               static_cast<size_t>(channels);
  }
  const uint8_t* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

// Returns a black (and, with 4 channels, transparent) image.
Image MakeImage(int width, int height, int channels);

// Says whether sides, channels and the number of bytes agree.
bool IsValid(const Image& image);

// Returns the image with 1, 3 or 4 channels: grey is Rec. 601 luma, a missing alpha is opaque, a surplus one is
// dropped.
Image ConvertChannels(const Image& image, int channels);

}  // namespace fitroom
