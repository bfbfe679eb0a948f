#include "common/image/image.h"

#include "common/base/check.h"

namespace fitroom {
namespace {

// Rec. 601 luma in 16.16 fixed point, rounded; the weights add up to exactly one.
uint8_t Luma(const uint8_t* rgb) {
  return static_cast<uint8_t>((19595u * rgb[0] + 38470u * rgb[1] + 7471u * rgb[2] + 32768u) >> 16);
}

}  // namespace

Image MakeImage(int width, int height, int channels) {
  FR_CHECK(width > 0 && height > 0);
  FR_CHECK(channels == 1 || channels == 3 || channels == 4);
  Image image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  image.pixels.assign(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels), 0);
  return image;
}

bool IsValid(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return false;
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) return false;
  return image.pixels.size() ==
         static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * static_cast<size_t>(image.channels);
}

Image ConvertChannels(const Image& image, int channels) {
  FR_CHECK(IsValid(image));
  if (image.channels == channels) return image;
  Image converted = MakeImage(image.width, image.height, channels);
  const size_t pixel_count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  const uint8_t* from = image.pixels.data();
  uint8_t* to = converted.pixels.data();
  for (size_t i = 0; i < pixel_count; ++i, from += image.channels, to += channels) {
    if (channels == 1) {
      to[0] = Luma(from);
      continue;
    }
    for (int c = 0; c < 3; ++c) to[c] = from[image.channels == 1 ? 0 : c];
    if (channels == 4) to[3] = 255;
  }
  return converted;
}

}  // namespace fitroom
