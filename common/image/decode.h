#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/base/status.h"
#include "common/image/image.h"

namespace fitroom {

enum class ImageFormat { kJpeg, kPng, kWebp };

// Returns the usual file extension without a dot: "jpg", "png" or "webp".
std::string_view ImageFormatExtension(ImageFormat format);

// What a decoder may spend on bytes from outside. Checked on the header, before any pixel is allocated.
struct ImageLimits {
  size_t max_bytes = size_t{20} << 20;    // Of the encoded file (unit: byte).
  int64_t max_pixels = 40 * 1000 * 1000;  // Of the decoded image (unit: pixel).
  int min_side = 1;                       // Shortest allowed side (unit: pixel).
};

// What the first bytes of an image say. Width and height are those of the decoded image, EXIF orientation applied.
struct ImageHeader {
  ImageFormat format = ImageFormat::kPng;
  int width = 0;        // (unit: pixel)
  int height = 0;       // (unit: pixel)
  int channels = 0;     // Of the decoded image: 1 grey, 3 RGB, 4 RGBA.
  int orientation = 1;  // EXIF: 1 upright … 8; JPEG only.
};

// Reads the header of a JPEG, PNG or WebP without decoding pixels.
// INVALID_ARGUMENT: IMAGE_FORMAT_UNKNOWN, IMAGE_CORRUPT, IMAGE_ANIMATED, IMAGE_TOO_SMALL.
// RESOURCE_EXHAUSTED: IMAGE_FILE_TOO_LARGE, IMAGE_TOO_LARGE.
Result<ImageHeader> ReadImageHeader(std::string_view bytes, const ImageLimits& limits = {});

// Decodes a JPEG (EXIF orientation applied, CMYK converted), PNG (every depth, palette, alpha, interlaced) or still
// WebP to 8-bit sRGB with as many channels as the header says. Fails as ReadImageHeader does, and with
// DATA_LOSS IMAGE_TRUNCATED or INVALID_ARGUMENT IMAGE_CORRUPT where the pixels are damaged: half an image is never
// returned. Thread-safe.
Result<Image> DecodeImage(std::string_view bytes, const ImageLimits& limits = {});

}  // namespace fitroom
